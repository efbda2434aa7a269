#!/usr/bin/python3
"""Sums in the accumulation buffer: what tests/real/sums.c draws is traced as it was rasterized."""
from helpers import check_alone, check_gates, check_same_pictures, finish

FRAMES = ("sums", "more sums", "not rendered")
trace, score = check_same_pictures("sums", FRAMES)
# flat panels over all of the window: R4 and R5 look for a background and for what stands before it
check_gates(score, len(FRAMES), "sums", skip=("R4", "R5"))
check_alone(trace, 1)  # needs what the frame before left in the accumulation buffer
finish()
