#!/usr/bin/python3
"""The accumulation buffer: tests/real/sums.c traced equals its raster pictures."""
from helpers import check_alone, check_gates, check_same_pictures, finish

FRAMES = ("sums", "more sums", "not rendered")
trace, score = check_same_pictures("sums", FRAMES)
# flat panels cover the window: R4 and R5 need a background and objects in front of it
check_gates(score, len(FRAMES), "sums", skip=("R4", "R5"))
check_alone(trace, 1)  # needs what the frame before left in the accumulation buffer
finish()
