#!/usr/bin/python3
# limit: 300 s
"""Stored recordings, rendered and scored against approved frames: on the C twins, then on the first OpenCL device.

`make golden-update` (--update) renders the approved frames again, on the C twins; inspect them before you commit.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from helpers import SCRATCH, check, diff, finish, must, relume  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
FRAME = "1"
AOV = "gl,shadow,relight,reflect,refract,id"
TRACES = sorted(HERE.glob("*.trace"))
REFERENCE, OPENCL = ("--device", "reference"), ()


def render_frame(trace, folder, device):
    must(relume("render", trace, "-f", FRAME, "--aov", AOV, "-o", folder / f"{trace.stem}.####.exr", *device))
    return folder / f"{trace.stem}.{int(FRAME):04d}.exr"


def failed_gates(score):
    return [name for name, gate in score["frames"][0]["gates"].items() if gate["state"] == "failed"]


if "--update" in sys.argv:
    for trace in TRACES:
        print(render_frame(trace, HERE, REFERENCE))
    sys.exit()

for trace in TRACES:
    for name, device in (("the C twins", REFERENCE), ("OpenCL", OPENCL)):
        made = render_frame(trace, SCRATCH / name, device)
        for layer in ("gl", "beauty"):
            code, score = diff(HERE / made.name, made, "--channel", layer)
            check(code == 0 and score["counts"]["passed"] == 1,
                  f"{trace.stem}, {layer}, on {name}: {failed_gates(score)}")
            check(score["frames"][0]["worst_code"] <= 1, f"{trace.stem}, {layer}, on {name}: within one code of 255")
finish()
