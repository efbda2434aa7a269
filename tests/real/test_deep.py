#!/usr/bin/python3
"""Pixels under many blended fragments: tests/real/deep.c traced must equal its raster picture, with every family of
kernels."""
from helpers import AS_SHOWN, SCRATCH, check, check_same_pictures, diff, finish, render

FRAMES = ("slices, a draw each", "the same, nearest first", "slices in one draw, of no power of two",
          "the same, clamped, nearest first", "nearest texels", "more triangles than a tile lists")
trace, _ = check_same_pictures("deep", FRAMES)
folder = SCRATCH / "binary"
render(trace, folder, *AS_SHOWN, "--kernels", "binary")
_, score = diff(trace, folder)
for frame, what in zip(score["frames"], FRAMES):
    check(frame["failing_pixels"] == 0, f"{what}, by other kernels: {frame['failing_pixels']} pixels fail")
finish()
