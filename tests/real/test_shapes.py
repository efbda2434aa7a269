#!/usr/bin/python3
"""Shapes whose pixels depend on the last bits of Mesa's arithmetic: tests/real/shapes.c traced equals its raster
pictures.

Also the quads of tests/trace/loops.c, which are not planar, so that the way they are split shows.
"""
from helpers import BUILD, SCRATCH, check_gates, check_same_pictures, diff, finish, record, render

FRAMES = ("lines", "lines over themselves", "smooth lines over themselves", "smooth lines without a length",
          "coplanar surfaces", "materials that change between Begin and End", "points and a distant light",
          "evaluated surfaces", "quads that are not whole", "attenuated sprites off the axis")
_, score = check_same_pictures("shapes", FRAMES)
check_gates(score, len(FRAMES), "shapes", skip=("R1",))
trace = SCRATCH / "loops.trace"
record(trace, BUILD / "tests/trace/loops")
render(trace, SCRATCH / "quads", "--mode", "gl")
check_gates(diff(trace, SCRATCH / "quads")[1], 6, "quads that are not plane", skip=("R1b", "E1", "E2"))
finish()
