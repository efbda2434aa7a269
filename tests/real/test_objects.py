#!/usr/bin/python3
"""Vertex array objects: tests/real/objects.c traced equals its raster pictures."""
from helpers import check, check_same_pictures, finish, relume

FRAMES = ("both", "the context's own", "both again", "without colours", "both, one without colours", "one deleted")
trace, _ = check_same_pictures("objects", FRAMES)
done = relume("info", trace)
check(done.returncode == 0 and "VertexArray" not in done.stdout.partition("not supported")[2],
      f"nothing of them is left out: {done.stdout}")
finish()
