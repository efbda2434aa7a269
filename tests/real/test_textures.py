#!/usr/bin/python3
"""Textures of all formats, wraps and swizzles, and pixels of depth and stencil: what tests/real/textures.c draws is traced as it
was rasterized."""
from helpers import BUILD, SCRATCH, check, diff, finish, record, render

FRAMES = ("formats", "blocks", "swizzles", "wraps", "depth and stencil")
trace = SCRATCH / "textures.trace"
record(trace, BUILD / "tests/real/textures")
files = render(trace, SCRATCH / "frames", "--mode", "gl", "--encoding", "display")
check(len(files) == len(FRAMES), f"{len(files)} frames of {len(FRAMES)}")
_, score = diff(trace, SCRATCH / "frames")
for frame, name in zip(score["frames"], FRAMES):
    check(frame["failing_pixels"] == 0, f"{name}: {frame['failing_pixels']} pixels fail")
finish()
