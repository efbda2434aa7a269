#!/usr/bin/python3
"""Textures of all formats, wraps and swizzles, and pixels of depth and stencil: what tests/real/textures.c draws is
traced as it was rasterized."""
from helpers import check_alone, check_same_pictures, finish

FRAMES = ("formats", "numbers", "filtered numbers", "blocks", "channels", "swizzles", "wraps", "depth and stencil",
          "generated levels", "cube levels", "points", "averaged levels", "depth environments", "combine4", "walls",
          *("trail", ) * 5)
trace, _ = check_same_pictures("textures", FRAMES)
# frames that show what earlier ones left: these are carried along as one scene when they are not asked for
last = len(FRAMES) - 1
check_alone(trace, last - 3, last)
finish()
