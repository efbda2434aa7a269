#!/usr/bin/python3
"""Textures of all formats, wraps and swizzles, and depth and stencil pixels: tests/real/textures.c traced equals its
raster pictures."""
from helpers import check_alone, check_same_pictures, finish

FRAMES = ("formats", "numbers", "filtered numbers", "blocks", "channels", "swizzles", "wraps", "depth and stencil",
          "generated levels", "cube levels", "points", "averaged levels", "depth environments", "combine4", "walls",
          *("trail", ) * 5)
trace, _ = check_same_pictures("textures", FRAMES)
# these show earlier frames, which are included as one scene if they are not requested
last = len(FRAMES) - 1
check_alone(trace, last - 3, last)
finish()
