#!/usr/bin/python3
"""Windows with several samples per pixel: tests/real/samples.c traced equals its raster pictures after resolving."""
from helpers import check_alone, check_gates, check_same_pictures, finish

FRAMES = ("shared edges", "surfaces through each other", "a floor and strips that leave the view", "lines",
          "lines at tiles", "points", "textures", "alpha to coverage", "sample coverage", "blending",
          "multisampling disabled", "stencil and alpha tests", "bitmaps and pixel rectangles", "scissors",
          "clip planes", "outlines", "the window as a texture", "a framebuffer object",
          "one that is left and drawn to again", "a window", "a window that is not cleared", "once more")
trace, score = check_same_pictures("samples", FRAMES)
check_gates(score, len(FRAMES), "samples", skip=("R1",))
check_alone(trace, 20, 21)
finish()
