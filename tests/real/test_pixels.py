#!/usr/bin/python3
"""Pixels drawn as pixels, and pixels that feed back: what tests/real/pixels.c draws is traced as it was rasterized."""
from helpers import BUILD, SCRATCH, check, check_gates, diff, finish, record, relume, render

FRAMES = ("text", "lit text", "rectangles", "values", "copies", "smooth", "uncleared", "uncleared again", "text again")
trace = SCRATCH / "pixels.trace"
record(trace, BUILD / "tests/real/pixels")
files = render(trace, SCRATCH / "frames", "--mode", "gl", "--encoding", "display")
check(len(files) == len(FRAMES), f"{len(files)} frames of {len(FRAMES)}")
_, score = diff(trace, SCRATCH / "frames")
for frame, name in zip(score["frames"], FRAMES):
    check(frame["failing_pixels"] == 0, f"{name}: {frame['failing_pixels']} pixels fail")
# R4 looks for a background, which frames without a clear have none of
check_gates(score, len(FRAMES), "pixels", skip=("R1", "R2", "R4", "R5"))
# the last but one alone needs the pixels of those before it
render(trace, SCRATCH / "alone", "--mode", "gl", "--encoding", "display", "-f", "7")
check((SCRATCH / "alone/pixels.0007.exr").read_bytes() == (SCRATCH / "frames/pixels.0007.exr").read_bytes(),
      "a frame that needs earlier ones is the same whether they were asked for or not")
finish()
