#!/usr/bin/python3
"""Draw targets other than a plain window: tests/real/targets.c traced equals its raster pictures."""
from helpers import check_alone, check_gates, check_same_pictures, finish

FRAMES = ("stored alpha", "render to texture", "depth texture", "copies", "levels", "layers", "several colours",
          "floats", "scaled", "few bits", "not rendered")
trace, score = check_same_pictures("targets", FRAMES)
# flat panels cover the window: R4 and R5 need a background and objects in front of it
check_gates(score, len(FRAMES), "targets", skip=("R4", "R5"))
check_alone(trace, 2)  # needs what the frame before left in a texture
finish()
