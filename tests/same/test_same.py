#!/usr/bin/python3
# limit: 600 s
"""The same scene, drawn in another way, must give the same picture: relations (relations.c) on a lit room with a
mirror, and some on a street with a sky. Known differences are not tested here; `make show-same` counts them."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from helpers import BUILD, ROOT, SCRATCH, check, corpus, finish, record  # noqa: E402
from pairs import ROUNDS, Variants, compare  # noqa: E402

DIFFER = {"farther", "lights"}  # shadows from nothing; mirrors show only the first pass
SOME = {"trimmed", "immediate", "lists", "elements", "split", "undone", "wound"}
BEHIND = {"sky"}  # in the hall, a lamp is behind the viewer, and a sky before a depth clear is in front of it

golden = ROOT / "tests/golden/cornell.trace"
street = SCRATCH / "street.trace"
record(street, corpus("street"), "--frames", 2, "--size", "200x150", options=())
hall = SCRATCH / "hall.trace"
record(hall, corpus("hall"), "--frames", 2, "--size", "200x150", options=())
for trace, some in ((golden, None), (street, SOME), (hall, BEHIND)):
    variants = Variants(BUILD, trace, 1, SCRATCH / trace.stem)
    verdicts = {name: variants.pair(name) for name, (base, _, _) in variants.relations.items()
                if base and (name in some if some else name not in DIFFER)}
    for name, verdict in verdicts.items():
        check(verdict.same is not False, f"{trace.stem}, {name}: {verdict}")
    applied = sum(verdict.same is True for verdict in verdicts.values())
    check(applied >= (len(some) if some else 30), f"{trace.stem}: {applied} relations apply")

# The comparison must notice another frame and a single pixel, but must tolerate shifted edges where allowed.
variants = Variants(BUILD, golden, 1, SCRATCH / "controls")
image, other = variants.picture("-"), variants.render(golden, 0, "other")
verdict = compare(image, other, ROUNDS)
check(verdict.same is False and verdict.share > 0.001 and verdict.draw, f"two frames differ: {verdict}")
other = variants.picture("trimmed")
check(compare(image, other, 0).same is True, "a picture equals itself")
for name, picture in (("R", "traced"), ("gl.R", "gl")):
    kept, other.planes[name] = other.planes[name], other.planes[name].copy()
    other.planes[name][300, 400] += 0.01
    verdict = compare(image, other, 0)
    check(verdict.same is False and verdict.where == (400, 300) and verdict.picture == picture, f"one pixel: {verdict}")
    other.planes[name] = kept
for name, plane in other.planes.items():
    other.planes[name] = plane.copy()
    other.planes[name][:, 1:] = plane[:, :-1]
check(compare(image, other, 0).same is False, "moved by a pixel, the picture differs")
check(compare(image, other, ROUNDS).same is True, "moved by a pixel, it is equal if edges may shift")

variants = Variants(BUILD, ROOT / "tests/golden/two_triangles.trace", 1, SCRATCH / "flat")
verdict = variants.pair("lamps")
check(verdict.same is None and str(verdict) == "no light has a place",
      f"without light there is no lamp, with the reason: {verdict}")
finish()
