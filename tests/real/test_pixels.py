#!/usr/bin/python3
"""Pixel operations: tests/real/pixels.c traced equals its raster pictures."""
from helpers import check_alone, check_gates, check_same_pictures, finish

FRAMES = ("text", "lit text", "rectangles", "values", "copies", "smooth", "uncleared", "uncleared again", "text again")
trace, score = check_same_pictures("pixels", FRAMES)
# R4 needs a background, which frames without a clear lack
check_gates(score, len(FRAMES), "pixels", skip=("R1", "R2", "R4", "R5"))
# only the last but one needs the pixels of earlier frames
check_alone(trace, 7)
finish()
