#!/usr/bin/python3
"""noof draws over a copy of its own previous frame, with smooth lines: each frame needs the pixels of all earlier ones.

Frames are requested with gaps, so that skipped frames must be rendered for them.
"""
import pathlib

from helpers import SCRATCH, check, check_gates, diff, finish, record, relume, render, skip

PROGRAM = pathlib.Path("/usr/libexec/xscreensaver/noof")
if not PROGRAM.exists():
    skip("noof is not installed (xscreensaver-gl-extra)")
trace = SCRATCH / "noof.trace"
record(trace, "sh", "-c", f"timeout 4 {PROGRAM} --root; true")
frames = "0,2,7"
render(trace, SCRATCH / "frames", "-f", frames)
code, score = diff(trace, SCRATCH / "frames", "-f", frames)
check(code == 0, f"exit code {code}")
scored = [f for f in score["frames"] if f["frame"] in (0, 2, 7)]
check_gates({"frames": scored}, 3, "noof", skip=("R4", "R5"))
check("glCopyTexSubImage2D" in relume("info", trace).stdout, "info says that pixels are needed")
finish()
