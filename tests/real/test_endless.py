#!/usr/bin/python3
"""A program whose loops exceed the limit is stopped, and never silently: the frame names the draws, the run reports
them and ends as with missing draws, and `relume diff` counts the correct pixels of each program (tests/real/endless.c).
"""
from exr import Image
from helpers import AS_SHOWN, BUILD, SCRATCH, check, diff, finish, must, record, relume

trace, frames = SCRATCH / "endless.trace", SCRATCH / "endless"
record(trace, BUILD / "tests/real/endless")
for device in ("reference", "cpu"):
    done = relume("render", trace, "-o", frames / "x.####.exr", "--device", device, "--force", *AS_SHOWN)
    check(done.returncode == 6, f"{device}: exit code {done.returncode}: {done.stderr}")
    check("ended: programs of 2 draws, after 262144 instructions in loops" in done.stderr,
          f"{device}: the run reports: {done.stderr}")
    attributes = [Image(frames / f"x.{i:04}.exr").attributes for i in range(2)]
    check("relume:ended" not in attributes[0], f"{device}: no program of frame 0 is stopped: {attributes[0]}")
    check(attributes[1].get("relume:ended") == b"3-4",
          f"{device}: frame 1 names its draws: {attributes[1].get('relume:ended')}")
done = relume("render", trace, "-o", SCRATCH / "alone.####.exr", "-f", "0", *AS_SHOWN)
check(done.returncode == 0, f"frame 0 alone: exit code {done.returncode}: {done.stderr}")
_, score = diff(trace, frames)
scored = [[(p["name"], p["pixels"], p["failing"]) for p in f["programs"]] for f in score["frames"]]
check([len(t) for t in scored] == [1, 3] and all(p[1] == 64 for t in scored for p in t),
      f"pixels of each program: {scored}")
check([p[2] for p in scored[0]] == [0], f"frame 0's program is right: {scored[0]}")
check([p[2] for p in scored[1]] == [0, 64, 64], f"the last two programs of frame 1 are wrong: {scored[1]}")
said = relume("diff", trace, frames).stdout
first, last = scored[1][0][0], scored[1][2][0]
check(f"{first}: 100.000 % of 64 px" in said and f"{last}: 0.000 % of 64 px" in said, f"the table shows it: {said}")
finish()
