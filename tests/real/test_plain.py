#!/usr/bin/python3
# limit: 300 s
"""Plain frames go through packets in one step (kernels/frame/plain.h), those of several looks in two or three: all leave the files of other
kernels, byte by byte; with rules that have rays to lights start on flat faces, and in light from all around, too."""
import json

from helpers import SCRATCH, check, corpus, finish, must, record, relume, render

FLAT = SCRATCH / "flat.yaml"
FLAT.write_text("spare: no\n")

DOME = SCRATCH / "dome.yaml"
DOME.write_text("sky: { reach: 4, up: [0, 1, 0], light: [1, 0.9, 0.8], ground: [0.3, 0.3, 0.5], lit: 0.5 }\n")

PROGRAMS = {  # and the kernel that their frames go through
    "box": ("plain", ["cornell", "--size", "317x203", "--animate", "light"]),
    "arena": ("plain", ["arena"]),
    "blocks": ("plain", ["blocks"]),
    "vertex": ("plain", ["phong", "--size", "201x150", "--by", "vertex"]),
    "fragment": ("plain", ["phong", "--size", "201x150", "--by", "fragment"]),
    "glsl": ("plain", ["phong", "--size", "201x150", "--by", "glsl"]),
    "spheres": ("layered", ["spheres", "--size", "320x240"]),
    "still_life": ("layered", ["still_life", "--size", "320x240"]),
}

IN_DOME = ("box", "arena", "blocks")

for name, (kernel, (program, *options)) in PROGRAMS.items():
    trace = SCRATCH / f"{name}.trace"
    record(trace, corpus(program), "--frames", 1, *options, options=())
    ways = {"default": (kernel, ()), "flat": (kernel, ("--look", FLAT))}
    if name in IN_DOME:
        ways["dome"] = ("plain_dome", ("--look", DOME))
    for stage, rules in (way for how, way in ways.items() if how != "flat"):
        stages = {row["what"] for row in json.loads(must(relume("bench", trace, "--repeat", 1, "--json", *rules)).stdout)["spent"]}
        check(stage in stages and "resolve_packet" not in stages, f"{name} {rules}: goes through {sorted(stages)}")
    default = None
    for how, (_, rules) in ways.items():
        pictures = [render(trace, SCRATCH / f"{name}-{how}-{kernels}", "--kernels", kernels, *rules)[0].read_bytes()
                    for kernels in ("packets", "binary")]
        check(pictures[0] == pictures[1], f"{name}, {how}: packets leave another file than binary")
        check(pictures[0] != default, f"{name}: rules change nothing")
        default = pictures[0]
finish()
