#!/usr/bin/python3
"""Frames in bulk: chunks, existing frames, the same bytes regardless of parallelism, signals, time limits.

limit: 200 s
"""
import json
import os
import re
import signal
import subprocess

from helpers import RELUME, SCRATCH, check, corpus, finish, must, record, relume

trace = SCRATCH / "two.trace"
record(trace, corpus("two_triangles"), "--frames", "8", options=())
out = SCRATCH / "out"


def render(*options, to=out, code=0):
    done = relume("render", trace, "-o", to / "x.{frame}.exr", *options)
    check(done.returncode == code, f"render {options}: exit code {done.returncode}, expected {code}: {done.stderr}")
    return done


def files(folder=out):
    return {p.name: p.read_bytes() for p in sorted(folder.iterdir())}


# Chunks: every frame is in exactly one.
chunks = [render("--chunk", f"{i}/3", "--dry-run").stdout.splitlines() for i in (1, 2, 3)]
check([len(c) for c in chunks] == [2, 3, 3] and [line.split(":")[0] for c in chunks for line in c] ==
      [f"frame {i}" for i in range(8)], f"three chunks of eight frames: {chunks}")
check(not out.exists(), "a dry run writes nothing")
render("--chunk", "9/20")  # an empty chunk: nothing to do is not a failure
render("--chunk", "4/3", code=2)
render("-f", "8", code=2)

# One or three frames in parallel, in order or in chunks: the same bytes.
render("-j", "1")
whole = files()
check(sorted(whole) == [f"x.{i}.exr" for i in range(8)], f"exactly the frames are there: {sorted(whole)}")
for i in (1, 2):
    render("-j", "3", "--chunk", f"{i}/2", to=SCRATCH / "parallel")
check(files(SCRATCH / "parallel") == whole, "three at once and in two chunks: the same bytes")

# Two devices share the frames and write the same bytes. PoCL lists its device as often as it is named.
both = dict(os.environ, POCL_DEVICES="pthread pthread")
long = SCRATCH / "long.trace"
record(long, corpus("two_triangles"), "--frames", "60", options=())
must(relume("render", long, "-o", SCRATCH / "alone" / "x.{frame}.exr"))
shared = must(relume("render", long, "-o", SCRATCH / "shared" / "x.{frame}.exr", "--device", "all", "-j", "1",
                     env=both))
shares = [int(n) for n in re.findall(r"^  device \d+: (\d+) frames?", shared.stderr, re.MULTILINE)]
check(
    len(shares) == 2 and min(shares) > 0 and sum(shares) == 60,
    f"two devices share sixty frames: {shared.stderr[-400:]}")
check(files(SCRATCH / "shared") == files(SCRATCH / "alone"), "two devices write the bytes of one")

# Complete frames are kept; those that are torn, zeroed, missing or made with other settings are rendered.
done = render("--skip-existing")
check(done.stderr.count("there already") == 9, f"all frames exist: {done.stderr}")  # in eight lines and the summary
(out / "x.1.exr").write_bytes(whole["x.1.exr"][:-100])
hole = bytearray(whole["x.2.exr"])
hole[len(hole) // 2:len(hole) // 2 + 512] = bytes(512)
(out / "x.2.exr").write_bytes(hole)
(out / "x.3.exr").write_bytes(b"")
(out / "x.4.exr").write_bytes(whole["x.5.exr"])
(out / "x.6.exr").unlink()
lines = [json.loads(line) for line in render("--skip-existing", "--progress", "json").stdout.splitlines()]
made = {line["frame"] for line in lines if line.get("state") == "done"}
check(made == {1, 2, 3, 4, 6}, f"torn, zeroed, empty, misplaced and missing frames are rendered: {made}")
check(lines[0] == {"event": "begin", "verb": "rendered", "total": 8} and lines[-1]["event"] == "end" and
      lines[-1]["skipped"] == 3, f"progress as JSON: {lines}")
check(files() == whole, "the rendered frames have the same bytes again")
check("it has other settings" in render("--skip-existing", "--dry-run", "--depth", "2").stdout,
      "other settings are noticed")
check("leave" not in render("--skip-existing", "--force", "--dry-run").stdout, "--force renders all")

# Signals: the right exit code, no partial file, and a second run continues.
for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
    folder = SCRATCH / f"signal{code}"
    command = [RELUME, "render", str(trace), "-o", str(folder / "x.{frame}.exr"), "-j", "1"]
    child = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    child.stderr.readline()  # wait for the first frame
    child.send_signal(number)
    said = child.communicate(timeout=60)[1]
    left = files(folder)
    check(child.returncode == code, f"{number.name}: exit code {child.returncode}: {said}")
    check(1 <= len(left) < 8 and all(whole[name] == data for name, data in left.items()),
          f"{number.name}: some frames exist and are complete: {sorted(left)}")
    must(relume(*command[1:], "--skip-existing"))
    check(files(folder) == whole, f"{number.name}: a second run continues")

# A frame that takes too long is abandoned and reported.
late = render("--timeout-per-frame", "0.0001", "-f", "0-2", to=SCRATCH / "late", code=5)
check("frames 0-2: given up after 0.0001 s" in late.stderr, f"three frames are abandoned: {late.stderr}")
check(not (SCRATCH / "late").exists() or not files(SCRATCH / "late"), "abandoned frames leave no file")
finish()
