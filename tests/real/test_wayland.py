#!/usr/bin/python3
"""A program with a Wayland window, under headless Weston (corpus/wayland): every frame passes every gate."""
from helpers import AS_SHOWN, RELUME, ROOT, SCRATCH, check_gates, corpus, diff, finish, must, render, run

FRAMES = 10

trace = SCRATCH / "blades.trace"
must(
    run(ROOT / "tests/wayland.sh", RELUME, "record", "-o", trace, "--ref", "color,depth", "--",
        corpus("wayland/blades"), "--frames", FRAMES))
render(trace, SCRATCH / "frames", *AS_SHOWN)
_, score = diff(trace, SCRATCH / "frames")
check_gates(score, FRAMES, "blades")
finish()
