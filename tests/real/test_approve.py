#!/usr/bin/python3
# limit: 600 s
"""relume approve: provenance, output, and how relume diff scores approved frames."""
import os
import re
import shutil

from helpers import RELUME, SCRATCH, check, corpus, diff, finish, must, record, relume, render, run

trace, out, base = SCRATCH / "c.trace", SCRATCH / "out", SCRATCH / "base"
record(trace, corpus("cornell"), "--frames", "3", "--animate", "camera")
render(trace, out)


def approve(*args):
    return must(relume("approve", *args)).stdout


def outcomes(code, *args):
    got, score = diff(*args)
    check(got == code, f"exit code {got}, expected {code}: {args}")
    return [f["outcome"] for f in score["frames"]], score["frames"]


found, frames = outcomes(4, trace, out, "--baseline", base)
check(found == ["new"] * 3, f"no approved frame yet: {found}")
done = relume("diff", trace, out, "--baseline", base)
said = [line for line in done.stderr.splitlines() if str(base) in line]
check(
    done.returncode == 4 and len(said) == 1 and "no such folder" in said[0]
    and f"relume approve TRACED {base}" in said[0], f"a baseline that is not there: {done.stderr}")
shutil.copy(out / "c.0002.exr", SCRATCH / "view.exr")
got, score = diff(trace, SCRATCH / "view.exr")
check([(f["frame"], f["outcome"]) for f in score["frames"]] == [(2, "passed")],
      f"frame number from the file, not its name: {score['frames']}")
text = approve(out, base, "-n")
check(not base.exists() and "frame 1: new" in text and "nothing was written" in text, f"a dry run: {text}")
env = dict(os.environ, SOURCE_DATE_EPOCH="1000000000")
text = must(run(RELUME, "approve", out, base, "--by", "somebody", "--reason", "they are right", env=env)).stdout
check("3 new, 0 changed" in text, f"first approval: {text}")
sheet, = base.glob("*/baseline.yaml")
lines = sheet.read_text().splitlines()
for line in ('approved_by: "somebody"', 'approved_at: "2001-09-09T01:46:40Z"', 'reason: "they are right"'):
    check(line in lines, f"provenance: {line}")
check(re.search(r'^trace: "[0-9a-f]{32}"$', sheet.read_text(), re.M), "the trace's hash")
check(len([line for line in lines if line.startswith("- {frame: ")]) == 3, "one line a frame")
check(len(list(base.glob("*/frame.*.exr"))) == 3, "frames are stored")

found, frames = outcomes(0, trace, out, "--baseline", base)
check(found == ["passed"] * 3, f"the same frames: {found}")
check(all("approved hash" in f["gates"]["B"]["note"] for f in frames), "the fast path")
found, frames = outcomes(0, "--baseline", base, out)
check(found == ["passed"] * 3 and frames[0]["gates"]["R1"]["state"] == "not measured", "without a reference")
found, _ = outcomes(0, "--baseline", base, "--report", SCRATCH / "page", out)
check(found == ["passed"] * 3 and (SCRATCH / "page/index.html").exists(), f"a page without references: {found}")

# Other pixels from the same device are a failure; approving them reports the change.
shutil.copy(out / "c.0001.exr", SCRATCH / "kept.exr")
render(trace, SCRATCH / "gl", "--mode", "gl", "-f", "1")
shutil.copy(SCRATCH / "gl" / "c.0001.exr", out / "c.0001.exr")
found, frames = outcomes(1, trace, out, "--baseline", base)
check(found == ["passed", "failed", "passed"], f"one frame has changed: {found}")
check("same device" in frames[1]["gates"]["B"]["note"], f"{frames[1]['gates']['B']}")
text = approve(out, base, "-n")
check(re.search(r"frame 1: changed: \d+ of \d+ pixels", text) and "2 as approved before" in text, f"an update: {text}")
shutil.copy(SCRATCH / "kept.exr", out / "c.0001.exr")

# The C twins count as another device: frames are compared numerically.
render(trace, SCRATCH / "twins", "--device", "reference")
found, frames = outcomes(0, trace, SCRATCH / "twins", "--baseline", base)
check(found == ["passed"] * 3, f"another device: {found}")
approve(SCRATCH / "twins", base, "--hashes")
check(len(list(base.glob("*/baseline.yaml"))) == 2, "a variant for each device")
found, frames = outcomes(0, trace, SCRATCH / "twins", "--baseline", base)
check(all("approved hash" in f["gates"]["B"]["note"] for f in frames), "its own hashes now")

(out / "c.0002.exr").unlink()
found, _ = outcomes(0, "--baseline", base, out)
check(found == ["passed", "passed"], f"only existing frames are scored: {found}")
found, _ = outcomes(1, "--baseline", base, "--all", out)
check(found == ["passed", "passed", "missing"], f"an approved frame without a traced one: {found}")

# All or nothing: here the last frame cannot be approved.
half, mixed = SCRATCH / "half", SCRATCH / "mixed"
mixed.mkdir()
shutil.copy(out / "c.0000.exr", mixed / "a.0000.exr")
record(SCRATCH / "o.trace", corpus("two_triangles"), "--frames", "2")
render(SCRATCH / "o.trace", SCRATCH / "other")
shutil.copy(SCRATCH / "other" / "o.0001.exr", mixed / "o.0001.exr")
done = relume("approve", mixed, half)
check(done.returncode == 2 and "another device or trace" in done.stderr and not half.exists() and not done.stdout,
      f"two series: {done.stdout}{done.stderr}")
before = {path: path.read_bytes() for path in base.rglob("*") if path.is_file()}
render(trace, SCRATCH / "gl01", "--mode", "gl", "-f", "0,1")
(SCRATCH / "gl01" / "c.0002.exr").write_bytes(b"\x76\x2f\x31\x01 no frame")
done = relume("approve", SCRATCH / "gl01", base)
check(done.returncode == 3 and before == {path: path.read_bytes() for path in base.rglob("*") if path.is_file()},
      f"a damaged frame: {done.stdout}{done.stderr}")

# Pictures are approved in their own format.
must(relume("render", trace, "-o", SCRATCH / "png" / "c.####.png"))
approve(SCRATCH / "png", SCRATCH / "base_png")
stored = sorted(path.name for path in (SCRATCH / "base_png").glob("*/frame.*"))
check(stored == [f"frame.{i:04}.png" for i in range(3)], f"PNG frames are stored as PNG files: {stored}")
check(all(path.read_bytes()[:4] == b"\x89PNG" for path in (SCRATCH / "base_png").glob("*/frame.*")),
      "they begin like PNG files")
found, _ = outcomes(0, "--baseline", SCRATCH / "base_png", SCRATCH / "png")
check(found == ["passed"] * 3, f"PNG frames are compared: {found}")
shutil.copy(SCRATCH / "png" / "c.0000.png", SCRATCH / "png" / "c.0001.png")
found, frames = outcomes(1, "--baseline", SCRATCH / "base_png", "--report", SCRATCH / "page_png", SCRATCH / "png")
check(found[1] == "failed" and '"approved": "data:image/png' in (SCRATCH / "page_png/index.html").read_text(),
      f"another PNG fails, and the page shows both: {found}")

sheet.write_text(sheet.read_text().replace("version: 1", "version: one"))
done = relume("diff", trace, out, "--baseline", base)
check(done.returncode == 3 and "line 2" in done.stderr, f"a damaged file: {done.stderr}")
check(relume("approve", trace, base).returncode != 0, "a trace is not a set of traced frames")
check(relume("approve", out).returncode == 2, "two names are required")
finish()
