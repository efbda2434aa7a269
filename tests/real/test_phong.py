#!/usr/bin/python3
"""A lit knot by fixed function, by a vertex program, a fragment program and GLSL (corpus/phong.c): all gates pass, and
the beauty is the same: positions and normals of surfaces, shadows of the knot on the floor and on itself. A program
with its own matrices gives the same shadows.
"""
from exr import Image
from helpers import check, check_gates, corpus, diff, finish, frames_of, record, render, SCRATCH

FRAMES = 2
SAME = ("Z", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z")  # to the bit
NEAR = ("R", "G", "B", "shadow.R")
NEAR_BY = 0.02  # maximum number of pixels; at shadow edges, rays may take either side
ODD_PIXELS = {"vertex": 100, "fragment": 1200, "glsl": 1200,
              "own": 200}  # odd pixels among 43,200; highlights depend on the way


def picture(way):
    trace = SCRATCH / f"{way}.trace"
    record(trace, corpus("phong"), "--frames", FRAMES, "--size", "240x180", "--animate", "camera", "--by", way)
    files = render(trace, frames_of(trace))
    check_gates(diff(trace, frames_of(trace))[1], FRAMES, f"by {way}")
    return Image(files[1], (*SAME, *NEAR))


fixed = picture("fixed")
shadowed = sum(value < 0.5 for row in fixed.planes["shadow.R"] for value in row)
check(shadowed > 1000, f"{shadowed} pixels are in shadow")
for way, most in ODD_PIXELS.items():
    ours = picture(way)
    for name in SAME if way != "own" else ():  # its eye space is derived from the picture
        check(ours.planes[name] == fixed.planes[name], f"by {way}: {name} equals fixed function's")
    for name in NEAR:
        odd = sum(
            abs(a - b) > NEAR_BY
            for one, other in zip(ours.planes[name], fixed.planes[name])
            for a, b in zip(one, other))
        check(odd <= most, f"by {way}: {name} differs in {odd} pixels")
finish()
