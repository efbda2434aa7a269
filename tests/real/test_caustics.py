#!/usr/bin/python3
# limit: 300 s
"""The caustics channels of a real program: the position of light focused by glass, independence of other channels, and
refused combinations."""
from exr import Image
from helpers import SCRATCH, check, corpus, finish, must, record, relume

trace = SCRATCH / "spheres.trace"
record(trace, corpus("spheres"), "--frames", "2", "--size", "64x48")


def render(name, *options, device=("--device", "reference")):
    must(relume("render", trace, "-f", "1", "-o", SCRATCH / name, *device, "--photons", "65536", *options, timeout=280))
    return Image(SCRATCH / name)


def brightest(image):
    red = image.planes["caustics.R"]
    return max((value, x, y) for y, row in enumerate(red) for x, value in enumerate(row))


all_channels = render("all.exr", "--aov", "caustics")
check({"R", "gl.R", "shadow.R", "caustics.R", "caustics.G", "caustics.B"} <= set(all_channels.names),
      f"with all other channels: {all_channels.names}")
value, x, y = brightest(all_channels)
floor, above = all_channels.planes["albedo.R"][y][x], [v for row in all_channels.planes["caustics.R"][:6] for v in row]
check(value > floor > 0,
      f"the ball focuses: {value:.2f} at {x}, {y}, where a light alone gives {floor:.2f} at most")
check(max(above) == 0, "the sky receives none")
few = render("few.exr", "--aov", "gl,caustics")
check("shadow.R" not in few.names and few.planes["caustics.G"] == all_channels.planes["caustics.G"],
      f"the same channels alone: {few.names}")
render("again.exr", "--aov", "caustics")
check((SCRATCH / "again.exr").read_bytes() == (SCRATCH / "all.exr").read_bytes(), "the same bytes in another run")
pairs = [(a, b)
         for rows in zip(all_channels.planes["caustics.G"],
                         render("cl.exr", "--aov", "caustics", device=()).planes["caustics.G"])
         for a, b in zip(*rows)]
off, total = sum(abs(a - b) for a, b in pairs), sum(a for a, _ in pairs)
check(off < 0.005 * total,
      f"an OpenCL device agrees with the reference, except for photons at edges: off by {off:.4f} of {total:.2f}")
for options in (("--aov", "caustics", "--mode", "gl"), ("--aov", "caustics", "--mode", "ao"), ("--photons", "1000")):
    check(
        relume("render", trace, "-f", "1", "-o", SCRATCH / "x.exr", *options).returncode == 2,
        f"{' '.join(options)} is refused")
finish()
