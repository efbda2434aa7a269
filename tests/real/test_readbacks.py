#!/usr/bin/python3
"""Pixels and texels read into buffer objects become input of later calls: tests/real/readbacks.c must equal Mesa's
pictures."""
from helpers import check, check_alone, check_same_pictures, finish, must, relume

FRAMES = ("colours", "greys", "packed types", "numbers", "depths", "storage", "textures", "vertices", "leaves pixels",
          "finds them", "finds a texture of them")
trace, _ = check_same_pictures("readbacks", FRAMES)
check_alone(trace, 9)
check_alone(trace, 10)
said = must(relume("info", trace)).stdout
check("only a renderer has them" in said and "read into a buffer object" not in said,
      f"info lists the needs of reads: {said}")
finish()
