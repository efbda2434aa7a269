#!/usr/bin/python3
# limit: 400 s
"""Lights are recovered from lightmaps, by multitexture and by a second pass, and from vertex colours: those of a level
of corpus/rooms, baked by its program in plain C. Walls are then lit by these lights, and their albedo is that of their
texture alone."""
import json
import pathlib
import resource
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "show"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, diff, finish, must, record, relume, render  # noqa: E402
from look import compare_lights  # noqa: E402

for lighting, role in (("multitexture", "lightmap in a second unit"), ("pass", "lightmap pass"),
                       ("colors", "light in vertex colours")):
    trace, truth, rules = (SCRATCH / f"{lighting}.{end}" for end in ("trace", "json", "look.yaml"))
    record(trace, corpus("rooms"), "--seed", 3, "--lights", 2, "--frames", 1, "--lighting", lighting, "--truth", truth,
           options=())
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    must(relume("look", trace, "-o", rules))
    took = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    check(took < 10, f"{lighting}: the study took {took:.1f} s of processor time")
    text = rules.read_text()
    check(f"role: {role}" in text, f"{lighting}: the lightmap's role is reported")
    found = compare_lights(json.loads(truth.read_text()), text)
    check(found["found"] == 2 and not found["missed"] and not found["invented"], f"{lighting}: {found}")
    check(found["off"] < 0.02 and found["strength_off"] < 0.1 and found["ambient_off"] < 0.1, f"{lighting}: {found}")

# Painted colours are not mistaken for light.
record(SCRATCH / "paint.trace", corpus("rooms"), "--seed", 3, "--lights", 2, "--frames", 1, "--lighting", "paint",
       options=())
must(relume("look", SCRATCH / "paint.trace", "-o", SCRATCH / "paint.look.yaml"))
check("vertex colours" not in (SCRATCH / "paint.look.yaml").read_text(), "paint is not taken for light")


def walls_alone(cut, *level, frame=0):
    """A level's picture with only its textures. cut: "none" for whole walls, "white" for the small triangles whose
    colours carry light."""
    bare, folder = (SCRATCH / f"{cut}{frame}{end}" for end in (".trace", ""))
    record(bare, corpus("rooms"), *level, "--lighting", cut)
    drawn = render(bare, folder, "-f", frame, "--aov", "gl,Z", "--encoding", "display")
    scored = [f for f in diff(bare, folder)[1]["frames"] if f["frame"] == frame]
    check(scored[0]["gates"]["R1"]["state"] == "passed", f"{cut}, {level}: textures alone are as Mesa draws them")
    return Image(drawn[0], ["gl.R", "gl.G"]).planes


def relit(name, frame=0):
    return Image(
        render(SCRATCH / f"{name}.trace", SCRATCH / name, "-f", frame, "--look", SCRATCH / f"{name}.look.yaml", "--aov",
               "gl,albedo", "--encoding", "display")[0], ["R", "gl.R", "albedo.R", "albedo.G"])


def check_albedo(name, image, texture):
    off = max(
        abs(a - b) for c in "RG" for p, q in zip(image.planes[f"albedo.{c}"], texture[f"gl.{c}"]) for a, b in zip(p, q))
    check(off < 0.005, f"{name}: the albedo equals the drawn texels: {off}")


# The relit picture equals the program's within the lightmaps' precision, and the albedo does not depend on how the
# lightmap was applied.
albedos = {lighting: relit(lighting) for lighting in ("multitexture", "pass", "colors")}
textures = {cut: walls_alone(cut, "--seed", 3, "--frames", 1) for cut in ("none", "white")}
for lighting, image in albedos.items():
    off = [abs(a - b) for p, q in zip(image.planes["R"], image.planes["gl.R"]) for a, b in zip(p, q)]
    check(sum(off) / len(off) < 0.03, f"{lighting}: relit as bright as lightmapped: {sum(off) / len(off)}")
    check_albedo(lighting, image, textures["white" if lighting == "colors" else "none"])
off = max(
    abs(a - b)
    for c in ("albedo.R", "albedo.G")
    for p, q in zip(albedos["multitexture"].planes[c], albedos["pass"].planes[c])
    for a, b in zip(p, q))
check(off < 0.01, f"the albedo is the same with multitexture and a second pass: {off}")

# A wall without direct light has one colour, the ambient light, which is not its own colour.
level = ("--seed", 6, "--frames", 2, "--animate", "camera") # the second frame shows such walls
record(SCRATCH / "shade.trace", corpus("rooms"), *level, "--lights", 1, "--lighting", "colors", options=())
must(relume("look", SCRATCH / "shade.trace", "-o", SCRATCH / "shade.look.yaml"))
check_albedo("shade", relit("shade", 1), walls_alone("white", *level, frame=1))
finish()
