#!/usr/bin/python3
"""Occlusion between objects of programs with projections of their own must equal Mesa's: tests/real/projections.c. For
every family of kernels, no surface is nearer than the recorded projection shows, nor hidden by it.
"""
from helpers import AS_SHOWN, SCRATCH, check, check_same_pictures, diff, finish, render

FRAMES = ("from 0.01 on", "from 0.48 on", "halfway", "towards the viewer", "the same, of few steps", "one depth",
          "logarithmic", "square")
trace, _ = check_same_pictures("projections", FRAMES)
for kernels in (("--device", "reference"), ("--kernels", "binary"), ("--kernels", "compressed")):
    folder = SCRATCH / kernels[1]
    render(trace, folder, *AS_SHOWN, *kernels)
    _, score = diff(trace, folder)
    for frame, what in zip(score["frames"], FRAMES, strict=True):
        check(frame["failing_pixels"] == 0, f"{what} with {kernels[1]}: {frame['failing_pixels']} pixels fail")
finish()
