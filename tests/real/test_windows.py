#!/usr/bin/python3
"""Two windows in one recording: each frame and its reference belong to one window, even if two threads swap at once
(tests/real/windows.c). The messages after recording and from `info` report needs: several windows, programs, the size
of references.
"""
from helpers import AS_SHOWN, BUILD, SCRATCH, check, diff, finish, must, record, relume, render

FRAMES = 10
PROGRAM = BUILD / "tests/real/windows"

trace = SCRATCH / "windows.trace"
said = record(trace, PROGRAM).stderr
files = render(trace, SCRATCH / "frames", *AS_SHOWN)
check(len(files) == FRAMES, f"{len(files)} frames of {FRAMES}")
_, score = diff(trace, SCRATCH / "frames")
failing = [f["failing_pixels"] for f in score["frames"]]
check(failing == [0] * FRAMES, f"failing pixels: {failing}")
sizes = [(f["width"], f["height"]) for f in score["frames"]]
check(sizes == [(48, 48), (80, 80)] * 5, f"sizes: {sizes}")
check("its frames come from several windows" in said, f"record says: {said}")
check("shaders" not in said, f"record says: {said}")
size = trace.with_suffix(".ref").stat().st_size
check(f"bytes, {size} bytes of reference frames, 0 calls not recorded" in said, f"references of {size} bytes: {said}")
info = must(relume("info", trace)).stdout
check("windows     several" in info, f"info says: {info}")

FRAMES = 80
trace = SCRATCH / "threads.trace"
record(trace, PROGRAM, "threads")
render(trace, SCRATCH / "threads", *AS_SHOWN)
_, score = diff(trace, SCRATCH / "threads")
failing = [f["failing_pixels"] for f in score["frames"]]
check(failing == [0] * FRAMES, f"two threads: failing pixels: {failing}")
sizes = sorted((f["width"], f["height"]) for f in score["frames"])
check(sizes == [(48, 48)] * 40 + [(80, 80)] * 40, f"two threads: sizes: {sizes}")

trace = SCRATCH / "shaders.trace"
said = record(trace, PROGRAM, "shaders", options=()).stderr
check("the program uses shaders" in said, f"record says: {said}")
check("reference" not in said, f"record without references says: {said}")

info = must(relume("info", trace)).stdout
check("programs that draws used" in info and "  program object " in info, f"info names programs: {info}")

# Missing features are reported before the first frame and by the exit code; frames that fail alike share a row.
to = SCRATCH / "shaders.####.exr"
done = relume("render", trace, "-o", to, "-f", "0-3", *AS_SHOWN)
lines = done.stderr.splitlines()
check(done.returncode == 6, f"missing draws: exit code {done.returncode}")
check("missing, frames 0 to 9: glUseProgram: a shader samples texture units from 8 on" in lines[0],
      f"missing draws are announced: {done.stderr}")
check("draws are missing" in lines[-1], f"missing draws: {done.stderr}")
done = relume("render", trace, "-o", to, "-f", "0-3", "--allow-incomplete", *AS_SHOWN)
check(done.returncode == 0, f"--allow-incomplete: exit code {done.returncode}")
done = relume("diff", SCRATCH / "windows.trace", SCRATCH / "frames", "-f", "0-14", "--table")
check("  10-14 missing" in done.stdout and done.stdout.count("missing") == 2,
      f"five missing frames share one row: {done.stdout}")
finish()
