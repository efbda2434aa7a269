#!/usr/bin/python3
"""Pixels and texels read into buffer objects are data of later calls: what tests/real/readbacks.c draws of them is as
Mesa drew it."""
from helpers import check, check_alone, check_same_pictures, finish, must, relume

FRAMES = ("colours", "greys", "packed types", "numbers", "depths", "storage", "textures", "vertices", "leaves pixels",
          "finds them", "finds a texture of them")
trace, _ = check_same_pictures("readbacks", FRAMES)
check_alone(trace, 9)
check_alone(trace, 10)
said = must(relume("info", trace)).stdout
check("only a renderer has them" in said and "read into a buffer object" not in said,
      f"info says what reads need: {said}")
finish()
