#!/usr/bin/python3
# limit: 400 s
"""Lights are found in lightmaps, by multitexture and by a second pass, and in vertex colours: those of a level of corpus/rooms, which its program baked in
plain C. Walls then take these lights, and their albedo is that of their texture alone."""
import json
import pathlib
import resource
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "show"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, diff, finish, must, record, relume, render  # noqa: E402
from look import compare_lights  # noqa: E402

for lighting, role in (("multitexture", "lightmap in a second unit"), ("pass", "lightmap pass"), ("colors", "light in vertex colours")):
    trace, truth, rules = (SCRATCH / f"{lighting}.{end}" for end in ("trace", "json", "look.yaml"))
    record(trace, corpus("rooms"), "--seed", 3, "--lights", 2, "--frames", 1, "--lighting", lighting, "--truth", truth, options=())
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    must(relume("look", trace, "-o", rules))
    took = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    check(took < 10, f"{lighting}: the study took {took:.1f} s of processor time")
    text = rules.read_text()
    check(f"role: {role}" in text, f"{lighting}: the lightmap's role is told")
    found = compare_lights(json.loads(truth.read_text()), text)
    check(found["found"] == 2 and not found["missed"] and not found["invented"], f"{lighting}: {found}")
    check(found["off"] < 0.02 and found["strength_off"] < 0.1 and found["ambient_off"] < 0.1, f"{lighting}: {found}")

# Colours that are paint are not taken for light.
record(SCRATCH / "paint.trace", corpus("rooms"), "--seed", 3, "--lights", 2, "--frames", 1, "--lighting", "paint", options=())
must(relume("look", SCRATCH / "paint.trace", "-o", SCRATCH / "paint.look.yaml"))
check("vertex colours" not in (SCRATCH / "paint.look.yaml").read_text(), "paint is no light")

# The picture relit equals the program's within what lightmaps leave, and the albedo is the same however the lightmap came.
albedos = {}
for lighting in ("multitexture", "pass", "colors"):
    image = Image(render(SCRATCH / f"{lighting}.trace", SCRATCH / lighting, "--look", SCRATCH / f"{lighting}.look.yaml", "--aov", "gl,albedo",
                         "--encoding", "display")[0], ["R", "gl.R", "albedo.R", "albedo.G"])
    off = [abs(a - b) for p, q in zip(image.planes["R"], image.planes["gl.R"]) for a, b in zip(p, q)]
    check(sum(off) / len(off) < 0.03, f"{lighting}: relit as bright as lightmapped: {sum(off) / len(off)}")
    albedos[lighting] = image
textures = {}
for cut in ("none", "white"): # walls whole, and in the small triangles that carry light in their colours
    bare = SCRATCH / f"{cut}.trace"
    record(bare, corpus("rooms"), "--seed", 3, "--lights", 2, "--frames", 1, "--lighting", cut)
    drawn = render(bare, SCRATCH / cut, "--aov", "gl,Z", "--encoding", "display")
    check(diff(bare, SCRATCH / cut)[1]["frames"][0]["gates"]["R1"]["state"] == "passed", f"{cut}: textures alone are as Mesa draws them")
    textures[cut] = Image(drawn[0], ["gl.R", "gl.G"]).planes
for lighting, image in albedos.items():
    texture = textures["white" if lighting == "colors" else "none"]
    off = max(abs(a - b) for c in "RG" for p, q in zip(image.planes[f"albedo.{c}"], texture[f"gl.{c}"]) for a, b in zip(p, q))
    check(off < 0.005, f"{lighting}: the albedo is the texels that the program drew: {off}")
off = max(abs(a - b) for c in ("albedo.R", "albedo.G") for p, q in zip(albedos["multitexture"].planes[c], albedos["pass"].planes[c]) for a, b in zip(p, q))
check(off < 0.01, f"the albedo is the texture's by multitexture as by a pass: {off}")
finish()
