#!/usr/bin/python3
"""Textures of all formats, wraps and swizzles, and pixels of depth and stencil: what tests/real/textures.c draws is traced as it
was rasterized."""
from helpers import BUILD, SCRATCH, check, diff, finish, record, render

FRAMES = ("formats", "blocks", "swizzles", "wraps", "depth and stencil", "generated levels", "cube levels", "points",
          "depth environments", *("trail",) * 5)
trace = SCRATCH / "textures.trace"
record(trace, BUILD / "tests/real/textures")
files = render(trace, SCRATCH / "frames", "--mode", "gl", "--encoding", "display")
check(len(files) == len(FRAMES), f"{len(files)} frames of {len(FRAMES)}")
_, score = diff(trace, SCRATCH / "frames")
for frame, name in zip(score["frames"], FRAMES):
    check(frame["failing_pixels"] == 0, f"{name}: {frame['failing_pixels']} pixels fail")
# frames that show what earlier ones left: these are carried along as one scene when they are not asked for
last = len(FRAMES) - 1
render(trace, SCRATCH / "alone", "--mode", "gl", "--encoding", "display", "-f", f"{last - 3},{last}")
for frame in (last - 3, last):
    name = f"textures.{frame:04}.exr"
    check((SCRATCH / "alone" / name).read_bytes() == (SCRATCH / "frames" / name).read_bytes(),
          f"frame {frame} is the same whether earlier ones were asked for or not")
finish()
