#!/usr/bin/python3
# limit: 300 s
"""Frames of several looks go through packets in two or three steps (kernels/frame/layered/layered.cl), other frames
stage by stage. tests/real/layers.c must give the same files as other kernels and as the twins, byte for byte: in
shadow, with mirrors and glass by rules, in several rounds (frames 3 and 4), and with pictures that replay requests
(from frame 5 on)."""
import json

from helpers import BUILD, SCRATCH, check, finish, must, record, relume, render

RULES = {name: SCRATCH / f"{name}.yaml" for name in ("reflect", "transmit")}
for name, file in RULES.items():
    file.write_text(f"surfaces:\n  - {{ match: {{ lit: yes }}, {name}: 0.3 }}\n")
TRACE = SCRATCH / "layers.trace"
FRAMES = 9
WAYS = {"as shown": ("layered", (), ("--mode", "gl")), "shadows": ("layered_shadow", (), ()),
        "mirrors": ("layered_mirror", ("--look", RULES["reflect"]), ("--depth", 1)),
        "glass": ("layered_mirror", ("--look", RULES["transmit"]), ("--depth", 1))}
DEVICES = {"": {"packets": (), "one thread": ("--threads", 1), "binary": ("--kernels", "binary")},
           "reference": {"packets": ("--kernels", "packets"), "binary": ("--kernels", "binary")}}

record(TRACE, BUILD / "tests/real/layers", options=())
for how, (kernel, rules, options) in WAYS.items():
    for frame in 0, 4:
        stages = {
            row["what"] for row in json.loads(
                must(relume("bench", TRACE, "--repeat", 1, "--json", "-f", frame, *rules)).stdout)["spent"]
        }
        check(kernel in stages and "resolve_packet" not in stages,
              f"{how}, frame {frame}: goes through {sorted(stages)}")
    for device, ways in DEVICES.items():
        on = ("--device", device) if device else ()
        pictures = {
            way: render(TRACE, SCRATCH / f"{how}-{device}-{way}".replace(" ", "_"), *on, *more, *options, *rules)
            for way, more in ways.items()
        }
        for way in list(ways)[1:]:
            differ = [
                b.name
                for a, b in zip(pictures["packets"], pictures[way], strict=True)
                if a.read_bytes() != b.read_bytes()
            ]
            check(not differ and len(pictures[way]) == FRAMES,
                  f"{how} {device}: packets' files differ from those of {way}: {differ}")
finish()
