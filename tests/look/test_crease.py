#!/usr/bin/python3
# limit: 300 s
"""Flat faces of round objects (corpus/facets): with `crease`, a faceted ball is lit like one with smooth normals, for
all ways of making it flat, on the first device and with the twins. A die beside it keeps its edges, and the ball keeps
its facets if the angle is less than that between them. OpenGL's picture, normals and depth are unchanged."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, finish, must, record, relume, render  # noqa: E402

KEPT = ("gl.R", "gl.G", "gl.B", "gl.depth", "Z", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "albedo.R", "albedo.G",
        "albedo.B", "id")
ROUND = "surfaces:\n  - crease: {}\n"


def picture(by, crease=None, *more):
    """With the twins, unless `more` says otherwise."""
    trace, name = SCRATCH / f"{by}.trace", f"{by}_{crease}_{len(more)}"
    if not trace.exists():
        record(trace, corpus("facets"), "--frames", 2, "--size", "160x120", "--by", by)
    look = ()
    if crease is not None:
        look = ("--look", SCRATCH / f"{name}.yaml")
        look[1].write_text(ROUND.format(crease))
    return Image(
        render(trace, SCRATCH / name, "-f", 1, *look, *(more or ("--device", "reference")))[0],
        {*KEPT, "R", "G", "B"}).planes


def differences(a, b):
    """Differences of the red channel, in 8-bit display codes, for the pixels of the ball (red) and all others."""
    ball, rest = [], []
    for rows in zip(a["R"], b["R"], a["albedo.R"], a["albedo.B"]):
        for x, y, red, blue in zip(*rows):
            (ball if red > 1.5 * blue else rest).append(255 * abs(max(x, 0) ** (1 / 2.2) - max(y, 0) ** (1 / 2.2)))
    return sum(ball) / len(ball), max(rest)


truth = picture("round", None, "--relight", "--device", "reference")
for by in ("faces", "clockwise", "flat"):
    bare, smooth, sharp = picture(by), picture(by, 40), picture(by, 4)
    check(all(bare[c] == smooth[c] for c in KEPT), f"{by}: OpenGL's picture and the geometry are unchanged")
    off, on, few = (differences(planes, truth)[0] for planes in (bare, smooth, sharp))
    check(on < 1 and off > 3 and on < off / 5,
          f"{by}: the ball is round: {on:.2f} of 255, and {off:.2f} without the rule")
    check(few > 3, f"{by}: at 4 degrees it keeps its facets: {few:.2f}")
    check(differences(smooth, picture(by, 0.001))[1] < 1, f"{by}: sharp edges stay sharp")
check(differences(picture("faces", 40), picture("faces", 40, "--device", "0"))[0] < 0.1, "a device and the twins agree")
check(all(math.isfinite(v) for row in picture("faces", 180)["R"] for v in row), "an angle of 180 degrees gives no NaN")

SCRATCH.joinpath("bad.yaml").write_text(ROUND.format(200))
done = relume("render", SCRATCH / "faces.trace", "-f", 1, "-o", SCRATCH / "bad.exr", "--look", SCRATCH / "bad.yaml")
check(done.returncode == 3 and "crease is 200" in done.stderr and not (SCRATCH / "bad.exr").exists(),
      f"a wrong angle gives one line: {done.stderr}")
finish()
