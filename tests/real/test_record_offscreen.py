#!/usr/bin/python3
"""Programs without a window: EGL with a pbuffer, without a surface, on a device; and OSMesa. Their recordings are
complete and show their pictures."""
import re
import subprocess

from helpers import BUILD, SCRATCH, check, check_gates, diff, finish, record, render, skip

PROGRAM = BUILD / "tests/trace/offscreen"
FRAMES, COLORS = 3, ((255, 0, 0), (0, 255, 0), (0, 0, 255))


def dump(trace):
    folder = SCRATCH / f"{trace.stem}.dump"
    folder.mkdir()
    done = subprocess.run(["apitrace", "dump", "--color=never", "--blobs", trace], cwd=folder, capture_output=True,
                          text=True, check=False)
    check(done.returncode == 0 and not done.stderr, f"{trace.name}: apitrace reads it: {done.stderr}")
    return folder, done.stdout


tried = 0
for how, ends in (("pbuffer", "swap"), ("surfaceless", "finish"), ("device", "finish"), ("osmesa", "swap")):
    if subprocess.run([PROGRAM, how], stderr=subprocess.DEVNULL, check=False).returncode == 77:
        continue
    tried += 1
    trace = SCRATCH / f"{how}.trace"
    record(trace, PROGRAM, how, options=("--ref", "color,depth", "--frame-end", ends))
    folder, calls = dump(trace)
    check(
        len(re.findall(r"^\d+ (?:eglSwapBuffers|glFrameTerminatorGREMEDY)\(", calls, re.M)) == FRAMES,
        f"{how}: {FRAMES} frames")
    check(len(re.findall("relume:time ", calls)) == FRAMES, f"{how}: a time for each frame")
    read = [tuple((folder / name).read_bytes()[:3]) for name in re.findall(r'glReadPixels\(.*blob\("(.*)"\)', calls)]
    check(tuple(read) == COLORS, f"{how}: the program's own pixels, {read}")
    if how in ("pbuffer", "osmesa"):  # the others have no default framebuffer
        check(
            len(render(trace, SCRATCH / how, "--mode", "gl", "--encoding", "display")) == FRAMES,
            f"{how}: {FRAMES} frames rendered")
        check_gates(diff(trace, SCRATCH / how)[1], FRAMES, how)
if not tried:
    skip("neither EGL nor OSMesa is available")
finish()
