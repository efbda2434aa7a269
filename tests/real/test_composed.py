#!/usr/bin/python3
"""A view drawn into a framebuffer object and shown in a part of the window is traced like one drawn there directly:
tests/real/composed.c, whose frames all look the same."""
import os
import re

import numpy

import exr
from helpers import BUILD, RELUME, SCRATCH, check, check_gates, diff, finish, must, record, relume, render, run

ALONE = 33  # the first frame rendered alone; the recording does not say how far back replay must go
FRAMES = ("drawn there", "by quads", "shown again", "by a blit", "drawn on after")
# the window's depth differs from the objects' depth, which the gates verify
PLANES = ("R", "G", "B", "gl.R", "gl.G", "gl.B", "Z", "P.X", "P.Y", "P.Z", "N.Y", "shadow.R", "layers")

trace = SCRATCH / "composed.trace"
record(trace, BUILD / "tests/real/composed")


def planes_of(file):
    image = exr.Image(file)
    return {name: numpy.asarray(image.planes[name]) for name in PLANES}


files = render(trace, SCRATCH / "composed")
first, *others = [planes_of(file) for file in files]
check(numpy.count_nonzero(first["shadow.R"] < 0.5) > 300, "the boxes cast shadows")
for name, planes in zip(FRAMES[1:], others):
    differ = {plane: int(numpy.count_nonzero(planes[plane] != first[plane])) for plane in PLANES}
    check(not any(differ.values()), f"{name}: pixels that differ from views drawn in the window: {differ}")
must(relume("render", trace, "-f", "2", "-o", SCRATCH / "alone.exr"))
alone = planes_of(SCRATCH / "alone.exr")
check(all((alone[name] == first[name]).all() for name in PLANES),
      "a frame rendered alone shows the drawing of earlier ones")
check_gates(diff(trace, SCRATCH / "composed")[1], len(FRAMES), "composed")

os.environ["XDG_CACHE_HOME"] = str(SCRATCH / "cache")
PIXELS = SCRATCH / "cache/relume/pixels"
# from a checkpoint with pixels, which does not contain the draws that made them
long = SCRATCH / "long.trace"
record(long, BUILD / "tests/real/composed", ALONE + 3)
for number in range(ALONE, ALONE + 3):
    said = must(relume("render", long, "-f", number, "-o", SCRATCH / "later.exr")).stderr
    later = planes_of(SCRATCH / "later.exr")
    kept = {int(path.stem.rpartition("-")[2]) for path in PIXELS.glob("*.index")}
    begins = {int(first) for first in re.findall(r"playing them from frame (\d+)", said)}
    check(number == ALONE or begins & kept, f"frame {number} starts from cached pixels: {begins}, {kept}")
    differ = {plane: int(numpy.count_nonzero(later[plane] != first[plane])) for plane in PLANES}
    check(not any(differ.values()), f"frame {number} of {ALONE + 3}, alone: pixels that differ: {differ}")

scenes = [must(relume("scene", trace, "-f", number)).stdout for number in "01"]
listed = [text.count(", lit") for text in scenes]
check(listed == [2, 2] or listed == [4, 4], f"scene lists the lit draws of both views: {listed}")

# makes Qt compile its shaders each time: cached binaries could not be translated
kept = {"": "1", "QT_DISABLE_SHADER_DISK_CACHE=0": "0"}
for setting, value in kept.items():
    said = run("env", *setting.split(), RELUME, "record", "-o", SCRATCH / "none.trace", "--", "env").stdout
    check(f"QT_DISABLE_SHADER_DISK_CACHE={value}" in said.splitlines(), f"Qt's cache of shaders: {value}")
finish()
