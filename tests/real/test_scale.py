#!/usr/bin/python3
# limit: 300 s
"""`render --scale X` and `--size WxH` show what the program would have drawn in a window of that size: programs
recorded small and large (tests/real/sizes.c, corpus/) are compared."""
import numpy

import exr
from helpers import BUILD, SCRATCH, check, corpus, finish, record, relume, render

SAME = 0.01  # percentage of pixels that may differ by more than a code, because a larger window rounds at other places
PLANES = [f"{layer}{c}" for layer in ("", "gl.") for c in "RGB"]


def pictures(name, program, *options):
    trace = SCRATCH / f"{name}.trace"
    if not trace.exists():
        record(trace, *program)
    folder = SCRATCH / f"{name}{'.'.join(options)}"
    return [exr.Image(file, PLANES).planes for file in render(trace, folder, *options)]


def off(one, other, layer):
    a, b = (numpy.stack([numpy.asarray(planes[layer + c]) for c in "RGB"], axis=-1) for planes in (one, other))
    return 100 * float(numpy.mean(abs(a - b).max(axis=-1) > 1 / 255)) if a.shape == b.shape else 100


def compare(name, scaled, recorded):
    check(len(scaled) == len(recorded), f"{name}: {len(scaled)} frames for {len(recorded)}")
    for number, (one, other) in enumerate(zip(scaled, recorded)):
        for layer in ("gl.", ""):
            differ = off(one, other, layer)
            check(differ <= SAME, f"{name}, frame {number}, {layer or 'beauty'}: {differ:.3f} % of the pixels differ")


for name, *more in (("spheres", ), ("still_life", ), ("tricks", "planar")):
    small, large = ((corpus(name), *more, "--frames", 2, "--size", size) for size in ("160x120", "480x360"))
    compare(f"{name} by 3", pictures(f"{name}-small", small, "--scale", "3"), pictures(f"{name}-large", large))
    compare(f"{name} by 1/3", pictures(f"{name}-large", large, "--scale", "0.33333334"),
            pictures(f"{name}-small", small))
sizes = BUILD / "tests/real/sizes"
compare("sizes by 4", pictures("sizes1", (sizes, 1), "--scale", "4"), pictures("sizes4", (sizes, 4)))
compare("sizes by 1/2", pictures("sizes4", (sizes, 4), "--scale", "0.5"), pictures("sizes2", (sizes, 2)))

# A window of another shape shows more at both sides, or above and below; its middle equals the recorded picture.
for name, size, rows, columns in (("spheres-small", "480x120", slice(None), slice(160, 320)),
                                  ("spheres-small", "160x240", slice(60, 180), slice(None)),
                                  ("sizes1", "192x72", slice(None), slice(48, 144))):
    shown = pictures(name, (), "--size", size)
    middle = [{plane: numpy.asarray(values)[rows, columns] for plane, values in planes.items()} for planes in shown]
    compare(f"{name} in {size}", middle, pictures(name, ()))
    outer = numpy.asarray(shown[0]["gl.G"])
    check(outer.shape[::-1] == tuple(map(int, size.split("x"))), f"{name} in {size}: {outer.shape}")
    beside = numpy.count_nonzero(outer != outer[0, 0]) - numpy.count_nonzero(middle[0]["gl.G"] != outer[0, 0])
    check(beside > 20 or name == "sizes1", f"{name} in {size}: more is visible beside the middle: {beside} pixels")
odd = exr.Image(render(SCRATCH / "sizes1.trace", SCRATCH / "odd", "--scale", "1.37", "-f", 0)[0], PLANES)
check((odd.width, odd.height) == (132, 99), f"96x72 by 1.37 is {odd.width}x{odd.height}")

plain, one = (render(SCRATCH / "sizes1.trace", SCRATCH / name, "-f", 0, *options)[0].read_bytes()
              for name, options in (("plain", ()), ("one", ("--scale", "1"))))
check(plain == one, "scale 1 gives the same file as no scale")
for what, options in (("too large", ("--scale", "64", "--mode", "gl")),
                      ("motion", ("--scale", "2", "--aov", "gl,motion")),
                      ("no number", ("--scale", "big")), ("no size", ("--size", "640")),
                      ("both", ("--size", "640x480", "--scale", "2")), ("a size too large", ("--size", "99999x10"))):
    trace = SCRATCH / ("spheres-large.trace" if what == "too large" else "sizes1.trace")
    done = relume("render", trace, "-f", 0, "-o", SCRATCH / "no.exr", *options)
    ours = [line for line in done.stderr.splitlines() if line.startswith("relume: ")]
    check(done.returncode == (5 if what == "too large" else 2) and len(ours) == 1 and
          any(word in ours[0] for word in ("scale", "size", "pixel")),
          f"{what}: {done.stderr}")
    check(not (SCRATCH / "no.exr").exists(), f"{what}: nothing is written")
finish()
