#!/usr/bin/python3
"""Shapes whose pixels hang on the last bits of Mesa's arithmetic: what tests/real/shapes.c draws is traced as it was rasterized.

So are the quads of tests/trace/loops.c, which are not plane: the way they are cut shows.
"""
from helpers import BUILD, SCRATCH, check, check_gates, diff, finish, record, render

FRAMES = ("lines", "lines over themselves", "coplanar surfaces", "materials that change between Begin and End", "points and a distant light",
          "evaluated surfaces")
trace = SCRATCH / "shapes.trace"
record(trace, BUILD / "tests/real/shapes")
files = render(trace, SCRATCH / "frames", "--mode", "gl", "--encoding", "display")
check(len(files) == len(FRAMES), f"{len(files)} frames of {len(FRAMES)}")
_, score = diff(trace, SCRATCH / "frames")
for frame, name in zip(score["frames"], FRAMES):
    check(frame["failing_pixels"] == 0, f"{name}: {frame['failing_pixels']} pixels fail")
check_gates(score, len(FRAMES), "shapes", skip=("R1",))
trace = SCRATCH / "loops.trace"
record(trace, BUILD / "tests/trace/loops")
render(trace, SCRATCH / "quads", "--mode", "gl")
check_gates(diff(trace, SCRATCH / "quads")[1], 6, "quads that are not plane", skip=("R1b", "E1", "E2"))
finish()
