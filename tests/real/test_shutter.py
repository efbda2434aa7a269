#!/usr/bin/python3
"""`relume render --shutter`: a rotating disc and a moving square against closed forms; objects that must stay sharp;
cuts.

limit: 300 s
"""
import numpy

import exr
from helpers import BUILD, SCRATCH, check, finish, record, relume, render

WIDTH, HEIGHT = 192, 128
FRAMES, TURN, STEP = 6, 30, 24  # degrees and pixels per frame
MIDDLE, RADIUS = (60, 72), 45  # inside the disc's edge
DISC, SQUARE = (slice(8, 104), slice(12, 108)), (slice(112, 120), slice(0, WIDTH))
BARS = (slice(20, 90), slice(128, 172))
FINE = 8  # subpixels per side

trace = SCRATCH / "turning.trace"
record(trace, BUILD / "tests/real/turning")


def red(file):
    return numpy.asarray(exr.Image(file, ("R", )).planes["R"]).reshape(HEIGHT, WIDTH)


def expected(first, last):
    """The mean picture from one moment to another, in frames, with white as 1: disc and square."""
    steps = (numpy.arange(WIDTH * FINE) + 0.5) / FINE, HEIGHT - (numpy.arange(HEIGHT * FINE) + 0.5) / FINE
    x, y = numpy.meshgrid(*steps)
    lit = numpy.zeros_like(x)
    times = first + (numpy.arange(200) + 0.5) / 200 * (last - first)
    angle, far = numpy.arctan2(y - MIDDLE[1], x - MIDDLE[0]), numpy.hypot(x - MIDDLE[0], y - MIDDLE[1])
    for time in numpy.clip(times, 0, FRAMES - 1):
        turned = (angle - numpy.radians(TURN) * time) % (2 * numpy.pi)
        lit += (far < RADIUS) & (turned < numpy.pi)
        lit += (numpy.abs(x - 24 - STEP * time) < 3) & (numpy.abs(y - 12) < 3)
    return (lit / len(times)).reshape(HEIGHT, FINE, WIDTH, FINE).mean(axis=(1, 3))


def error(picture, first, last):
    """Root mean square error in the disc and around the square."""
    y, x = numpy.mgrid[:HEIGHT, :WIDTH]
    counts = numpy.hypot(x + 0.5 - MIDDLE[0], HEIGHT - y - 0.5 - MIDDLE[1]) < RADIUS - 1
    counts[SQUARE] = True
    return float(numpy.sqrt(numpy.mean((picture - expected(first, last))[counts] ** 2)))


def shutter(name, *options):
    """In display codes, as samples are averaged."""
    return render(trace, SCRATCH / name, "--encoding", "display", *options)


def planes_of(file):
    names = ("gl.R", "Z", "id", "motion.X", "motion.Y", "motion.A")
    image = exr.Image(file, names)
    return {name: numpy.asarray(image.planes[name]).reshape(HEIGHT, WIDTH) for name in names}


errors = []
for samples in (4, 16, 64):
    blurred = shutter(f"s{samples}", "-f", 2, "--shutter", 0.5, "--samples", samples)[0]
    errors.append(error(red(blurred), 1.75, 2.25))
check(errors[2] < 0.01, f"disc and square at 64 samples: {errors[2]:.4f} off the closed form")
check(errors[1] < errors[0] / 2 and errors[2] < errors[1] / 2, "noise falls with more samples: " +
      ", ".join(f"{value:.4f}" for value in errors))
for mode in ("path", "gl"):
    picture = red(shutter(mode, "-f", 2, "--shutter", 0.5, "--samples", 32, "--mode", mode)[0])
    check(error(picture, 1.75, 2.25) < 0.015, f"mode {mode} at 32 samples: {error(picture, 1.75, 2.25):.4f} off")
ends = shutter("ends", "-f", "0,5", "--shutter", 1, "--samples", 64)
for file, (first, last) in zip(ends, ((-0.5, 0.5), (4.5, 5.5))):
    check(error(red(file), first, last) < 0.01,
          f"nothing moves before the first frame and after the last: from {first}")
RATES = ("--recorded-fps", 10, "--fps", 3)
slow = shutter("slow", *RATES, "--shutter", 0.6, "--samples", 64)
check(error(red(slow[1]), 10 / 3 - 1, 10 / 3 + 1) < 0.01, "at another rate, the shutter is open for two frames")
check(exr.attribute(slow[1], "relume:shutter") == b"0.6", "files record the shutter")

MOTION = ("--aov", "gl,Z,id,P,motion")
sharp = planes_of(shutter("sharp", "-f", 2, *MOTION)[0])
open_ = shutter("open", "-f", 2, "--shutter", 0.5, "--samples", 4, *MOTION)[0]
planes = planes_of(open_)
check(all((planes[name] == sharp[name]).all() for name in planes), "gl, Z, id and motion are those of the moment")
inside = (slice(114, 118), slice(70, 74))  # the square
check(numpy.abs(planes["motion.X"][inside] - STEP).max() < 1e-3, "the square's motion is its step")
check((red(open_)[BARS] == red(blurred)[BARS]).all() and set(numpy.unique(red(open_)[BARS])) == {0, 1},
      "bars that appear and disappear stay sharp")
faster = planes_of(shutter("faster", "--recorded-fps", 10, "--fps", 20, *MOTION)[4])
check(numpy.abs(faster["motion.X"][inside] - STEP / 2).max() < 1e-3, "at twice the rate, its motion is half")
check(numpy.unique(faster["motion.A"][DISC]).tolist() == [0, 1], "the disc is matched")

cut = SCRATCH / "cut.trace"
record(cut, BUILD / "tests/real/moments", 15)
NARROW = ("--shutter", 1, "--samples", 8, "--aov", "gl")
before, behind = render(cut, SCRATCH / "cut", *NARROW, "-f", "7-8")
alone = render(cut, SCRATCH / "alone", *NARROW, "-f", "7")
check(before.read_bytes() == alone[0].read_bytes(), "a picture is the same in any run")
until = render(cut, SCRATCH / "until", *NARROW, "--fps", 15, "--recorded-fps", 15, "-f", "0-7")
since = render(cut, SCRATCH / "since", *NARROW, "--fps", 15, "--recorded-fps", 15, "-f", "8-9")


def same(a, b):
    planes = (exr.Image(a, "RGB").planes, exr.Image(b, "RGB").planes)
    return all((numpy.asarray(planes[0][name]) == planes[1][name]).all() for name in "RGB")


check(same(before, until[7]) and same(behind, since[0]), "no picture mixes both sides of a cut")

for options, words in ((("--shutter", 0.5), "--samples says how many"),
                       (("--shutter", 2, "--samples", 4), "--shutter")):
    done = relume("render", trace, *options, "-o", SCRATCH / "x.####.exr")
    check(done.returncode == 2 and words in done.stderr, f"{' '.join(map(str, options))}: {done.stderr.strip()}")
finish()
