#!/usr/bin/python3
"""Display pictures: PNG compared with oiiotool's conversion of the OpenEXR file by the same curve; the same bytes
regardless of parallelism."""
import numpy

from codes import codes
from helpers import SCRATCH, check, corpus, diff, finish, must, record, relume

trace = SCRATCH / "still.trace"
out = SCRATCH / "out"
record(trace, corpus("still_life"), "--frames", "4", options=("--ref", "color"))


def render(folder, *options, ending="png", code=0):
    done = relume("render", trace, "-o", out / folder / f"s.####.{ending}", *options)
    check(done.returncode == code, f"render {options}: exit code {done.returncode}, expected {code}: {done.stderr}")
    return done.stderr


def curve(exposure, white):
    """The curve of tracer/image/display.h in oiiotool's steps: values below the knee, and a part of those above."""
    knee, m = 0.6, (white - 0.6) / 0.4
    return ("--mulc", 2.0 ** exposure, "--label", "light",
            "light", "--subc", knee, "--divc", white - knee, "--clamp:min=0:max=1", "--label", "t",
            "t", "--mulc", (1 - knee) * m, "t", "--mulc", m - 1, "--addc", 1, "--div",
            "light", f"--clamp:min=0:max={knee}", "--add", "--colorconvert", "linear", "sRGB")


def files(folder):
    return {p.name: p.read_bytes() for p in sorted((out / folder).iterdir())}


# Within one code of oiiotool's, at any exposure and white point; JPEG within its compression error.
render("exr", "-f", "0", ending="exr")
brightest = codes(out / "exr/s.0000.exr").max() / 255
for exposure, white in ((0, 1), (1.5, 1), (2, 4), (-1, 16)):
    said = render(f"curve{exposure}_{white}", "-f", "0", "--exposure", exposure, "--white", white)
    ours, theirs = numpy.rint(codes(out / f"curve{exposure}_{white}/s.0000.png")), codes(
        out / "exr/s.0000.exr", *curve(exposure, white))
    apart = numpy.abs(ours - numpy.rint(theirs))
    check(apart.max() <= 1, f"exposure {exposure}, white {white}: at most {apart.max()} codes from oiiotool's")
    check(numpy.abs((ours - theirs).mean()) < 0.03, f"dither does not shift the mean: {(ours - theirs).mean()}")
    clips = brightest * 2.0 ** exposure > white
    check((f"exposure {exposure:+g} stops, white at {white:g}; " in said) == clips,
          f"the log counts pixels above white ({clips}): {said}")
plain = codes(out / "curve0_1/s.0000.png")
check(numpy.abs(plain - codes(out / "curve1.5_1/s.0000.png")).max() > 40, "exposure changes the picture")
render("jpeg", "-f", "0", ending="jpg")
check(numpy.abs(codes(out / "jpeg/s.0000.jpg") - plain).mean() < 2, "a JPEG of the same picture")

# Mode gl rounds like GL: it equals the program's picture to the code.
render("gl", "--mode", "gl")
status, score = diff(trace, out / "gl")
check(status == 0 and len(score["frames"]) == 4 and all(f["failing_pixels"] == 0 for f in score["frames"]),
      "mode gl passes")
must(relume("raster", trace, "-f", "1", "-o", SCRATCH / "raster.####.png"))
apart = codes(out / "gl/s.0001.png") != codes(SCRATCH / "raster.0001.png")
check(apart.mean() < 0.001, f"mode gl: {100 * apart.mean()} % of the codes differ from the raster frame")

# The same bytes in one run and in chunks; a second run keeps complete files and replaces torn ones.
render("whole")
for i in (1, 2, 3):
    render("chunks", "--chunk", f"{i}/3", "-j", "3")
check(len(files("whole")) == 4 and files("whole") == files("chunks"), "chunks: the same bytes")
for folder, ending in (("whole", "png"), ("jpeg", "jpg")):
    name = f"s.0000.{ending}"
    whole = files(folder)[name]
    check("there already" in render(folder, "-f", "0", "--skip-existing", ending=ending), f"{name} exists")
    (out / folder / name).write_bytes(whole[:-100])
    render(folder, "-f", "0", "--skip-existing", ending=ending)
    check(files(folder)[name] == whole, f"{name} was torn and is rendered again")
    check("there already" not in render(folder, "-f", "0", "--skip-existing", "--exposure", "1", ending=ending),
          "another exposure")

# Invalid combinations.
for options, word in ((("--aov", "gl"), "--aov"), (("--exposure", "bright"), "-30 to 30"), (("--white", "0.5"),
                                                                                            "1 to 10000")):
    check(word in render("wrong", *options, code=2), f"{options} is refused")
check("--exposure" in render("wrong", "--exposure", "1", ending="exr", code=2), "OpenEXR has no exposure")
for ending in ("tif", "exr.bak", "webp"):
    said = render("wrong", ending=ending, code=2)
    check(all(kind in said for kind in (".exr", ".png", ".jpg")), f".{ending}: the known endings are listed: {said}")
check(not (out / "wrong").exists(), "nothing is written")
finish()
