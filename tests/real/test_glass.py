#!/usr/bin/python3
# limit: 400 s
"""Whitted's spheres and a glass box in the Cornell box: every gate on every frame, and glass shows the objects behind
it."""
from exr import Image
from helpers import SCRATCH, check, check_gates, corpus, diff, finish, record, render

CHANNELS = {"R", "B", "gl.R", "refract.R", "refract.B", "reflect.R", "shadow.R"}


def rendered(name, program, *options):
    trace = SCRATCH / f"{name}.trace"
    record(trace, corpus(program), "--frames", "2", *options)
    files = render(trace, SCRATCH / name)
    code, score = diff(trace, SCRATCH / name)
    check(code == 0, f"{name}: relume diff exits with {code}")
    check_gates(score, 2, name)
    return Image(files[1], CHANNELS)


def bent(image):
    return [(x, y) for y in range(image.height) for x in range(image.width) if image.at("refract.R", x, y) != 0]


image = rendered("spheres", "spheres")
spots = bent(image)
check(len(spots) > 15000, f"spheres: {len(spots)} pixels of glass")
# A glass ball shows the scene behind it upside down: red and yellow tiles above, blue sky below its middle.
middle = sum(y for _, y in spots) / len(spots)
above = [(x, y) for x, y in spots if y < middle - 20]
below = [(x, y) for x, y in spots if middle + 5 < y < middle + 30]
red = sum(image.at("R", x, y) > image.at("B", x, y) for x, y in above)
blue = sum(image.at("R", x, y) < image.at("B", x, y) for x, y in below)
check(red > 0.5 * len(above), f"spheres: {red} of {len(above)} pixels in the upper half show the floor")
check(blue > 0.9 * len(below), f"spheres: {blue} of {len(below)} pixels below the middle show the sky")
half = sum(0.1 < image.at("shadow.R", x, y) < 0.9 for y in range(420, 580) for x in range(image.width))
dark = sum(image.at("shadow.R", x, y) < 0.06 for y in range(350, 430) for x in range(image.width))
check(half > 5000, f"spheres: the glass casts a light shadow: {half} pixels")
check(dark > 2000, f"spheres: the mirror casts a dark one: {dark} pixels")

image = rendered("box", "cornell", "--glass")
check(len(bent(image)) > 10000, f"box: {len(bent(image))} pixels of glass")
finish()
