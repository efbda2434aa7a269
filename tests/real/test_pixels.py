#!/usr/bin/python3
"""Pixels drawn as pixels, and pixels that feed back: what tests/real/pixels.c draws is traced as it was rasterized."""
from helpers import check_alone, check_gates, check_same_pictures, finish

FRAMES = ("text", "lit text", "rectangles", "values", "copies", "smooth", "uncleared", "uncleared again", "text again")
trace, score = check_same_pictures("pixels", FRAMES)
# R4 looks for a background, which frames without a clear have none of
check_gates(score, len(FRAMES), "pixels", skip=("R1", "R2", "R4", "R5"))
# the last but one alone needs the pixels of those before it
check_alone(trace, 7)
finish()
