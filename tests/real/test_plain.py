#!/usr/bin/python3
# limit: 400 s
"""Plain frames go through packets in one step (kernels/frame/plain/plain.h), those of several looks in two or three;
kernels with one pixel per work item handle plain frames without programs. Without rays (mode gl) the camera's part is
in the same step. All write the same files, byte for byte; also with rules that start shadow rays on flat faces, and
with ambient light from all sides, where programs take other paths and the C twins must agree."""
import json

import exr
from helpers import SCRATCH, check, corpus, finish, must, record, relume, render

FLAT = SCRATCH / "flat.yaml"
FLAT.write_text("spare: no\n")

DOME = SCRATCH / "dome.yaml"
DOME.write_text("sky: { reach: 4, up: [0, 1, 0], light: [1, 0.9, 0.8], ground: [0.3, 0.3, 0.5], lit: 0.5 }\n")

PROGRAMS = {  # and the kernel for their frames
    "box": ("plain", ["cornell", "--size", "317x203", "--animate", "light"]),
    "arena": ("plain", ["arena"]),
    "blocks": ("plain", ["blocks"]),
    "vertex": ("plain", ["phong", "--size", "201x150", "--by", "vertex"]),
    "fragment": ("plain", ["phong", "--size", "201x150", "--by", "fragment"]),
    "glsl": ("plain", ["phong", "--size", "201x150", "--by", "glsl"]),
    "spheres": ("layered", ["spheres", "--size", "320x240"]),
    "still_life": ("layered", ["still_life", "--size", "320x240"]),
    "courtyard": ("layered", ["courtyard", "--size", "320x240"]),  # clears its depth buffer again
}

IN_DOME = {
    "box": "plain_dome", "arena": "plain_dome", "blocks": "plain_dome", "vertex": "dome_light_packet",
    "fragment": "dome_light_packet"
}
WHOLE = ("box", "arena", "blocks", "vertex", "spheres")  # without rays, one step from the camera to planes
ONE_BY_ONE = ("box", "arena", "blocks")  # supported by kernels with one pixel per work item


def stages(trace, *options):
    return {
        row["what"]
        for row in json.loads(must(relume("bench", trace, "--repeat", 1, "--json", *options)).stdout)["spent"]
    }


for name, (kernel, (program, *options)) in PROGRAMS.items():
    trace = SCRATCH / f"{name}.trace"
    record(trace, corpus(program), "--frames", 1, *options, options=())
    ways = {"default": (kernel, ()), "flat": (kernel, ("--look", FLAT))}
    if name in IN_DOME:
        ways["dome"] = (IN_DOME[name], ("--look", DOME))
    for stage, rules in (way for how, way in ways.items() if how != "flat"):
        through = stages(trace, *rules)
        check(stage in through and ("resolve_packet" in through) == (stage == "dome_light_packet"),
              f"{name} {rules}: goes through {sorted(through)}")
    through = stages(trace, "--mode", "gl")
    check(("plain_whole" in through) == (name in WHOLE) != ("camera_packet" in through),
          f"{name} in mode gl: goes through {sorted(through)}")
    pictures = [render(trace, SCRATCH / f"{name}-gl-{'-'.join(way)}", *way, "--mode", "gl")[0].read_bytes()
                for way in (("--kernels", "packets"), ("--kernels", "binary"))]
    check(pictures[0] == pictures[1], f"{name}, mode gl: packets' file differs from binary's")
    if name in WHOLE:
        pictures = [
            render(trace, SCRATCH / f"{name}-gl-twins-{kernels}", "--device", "reference", "--kernels", kernels,
                   "--mode", "gl")[0].read_bytes() for kernels in ("packets", "binary")
        ]
        check(pictures[0] == pictures[1],
              f"{name}, mode gl: the twins of packets and of binary write different files")
    through = stages(trace, "--kernels", "binary")
    one = ("plain_color", "plain_ask", "plain_show", "plain_color_dimmed",
           "plain_show_dimmed") if name in ONE_BY_ONE else ("shade", "resolve", "compose")
    check(all(stage in through for stage in one), f"{name}, one pixel a work item: goes through {sorted(through)}")
    default = None
    for how, (_, rules) in ways.items():
        pictures = [render(trace, SCRATCH / f"{name}-{how}-{kernels}", "--kernels", kernels, *rules)[0].read_bytes()
                    for kernels in ("packets", "binary")]
        check(pictures[0] == pictures[1], f"{name}, {how}: packets' file differs from binary's")
        check(pictures[0] != default, f"{name}: rules change nothing")
        default = pictures[0]
        if how == "dome":
            render(trace, SCRATCH / f"{name}-twins", "--device", "reference", *rules)
            twins, packets = (exr.Image(next((SCRATCH / folder).iterdir())).planes
                              for folder in (f"{name}-twins", f"{name}-dome-packets"))
            odd = sum(abs(a - b) > 1e-3 for c in "RGB" for rows in zip(twins[c], packets[c]) for a, b in zip(*rows))
            check(odd < 20, f"{name}: {odd} numbers of the C twins differ")
    if name in ONE_BY_ONE:
        pictures = [
            render(trace, SCRATCH / f"{name}-twins-{kernels}", "--device", "reference", "--kernels",
                   kernels)[0].read_bytes() for kernels in ("packets", "binary")
        ]
        check(pictures[0] == pictures[1], f"{name}: the twins of packets and of binary write different files")
finish()
