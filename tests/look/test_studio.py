#!/usr/bin/python3
# limit: 300 s
"""Things before an empty dark window: the viewer's own light gets a lamp beside it (corpus/viewer), a lamp falls off
(corpus/cornell). A world with walls around the viewer (corpus/arena) and one with a bright sky (corpus/blocks) keep
their lights."""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, diff, finish, must, record, relume, render  # noqa: E402

SHOWN = {f"{layer}{c}" for layer in ("", "gl.") for c in "RGB"}


def study(program, *options):
    trace, rules = SCRATCH / f"{program}.trace", SCRATCH / f"{program}.look.yaml"
    record(trace, corpus(program), "--frames", 2, "--size", "200x150", *options)
    must(relume("look", trace, "-o", rules))
    return trace, rules.read_text()


def brightness(planes, x0, y0, x1, y1):
    return sum(sum(row[x0:x1]) for row in planes["G"][y0:y1]) / ((x1 - x0) * (y1 - y0))


trace, text = study("viewer")
check(
    re.search("role: light of the viewer(?:(?!role).|\n)*shadows: no", text)
    and text.count("role: lamp of a studio") == 1, f"a head light and a lamp beside it: {text}")
pictures = {
    name: Image(render(trace, SCRATCH / name, "-f", 1, *look)[0], SHOWN).planes
    for name, look in (("bare", ()), ("lit", ("--look", "auto")))
}
bare, lit = pictures["bare"], pictures["lit"]
check(all(bare[f"gl.{c}"] == lit[f"gl.{c}"] for c in "RGB"), "OpenGL's picture stays")
left, right = (brightness(lit, x, y, x + 55, y + 55) / brightness(bare, x, y, x + 55, y + 55)
               for x, y in ((45, 20), (100, 75)))
check(left > 1.05 * right, f"the lamp is at the upper left: {left:.2f}, {right:.2f} of the light before")
check(0.7 < brightness(lit, 40, 20, 160, 130) / brightness(bare, 40, 20, 160, 130) < 1.4,
      "the picture is about as bright as it was")
check(diff(trace, SCRATCH / "lit")[1]["frames"][-1]["gates"]["N"]["state"] == "passed", "gate N")

# A lamp that is too strong burns the colour out of the model: gate N says so.
strong = SCRATCH / "strong.look.yaml"
strong.write_text(re.sub(r"(role: lamp of a studio[^#]*?diffuse: )\[.*?\]", r"\1[2, 2, 2]", text))
render(trace, SCRATCH / "strong", "-f", 1, "--look", strong)
code, score = diff(trace, SCRATCH / "strong")
harm = score["frames"][-1]["gates"]["N"]
check(code == 1 and harm["state"] == "failed" and harm["figures"][2]["value"] > 1, f"a lamp that is too strong: {harm}")

trace, text = study("cornell")
found = re.search(r"role: lamp of a studio\n.*\n.*\n    light: 0\n    attenuation: \[0.5, 0, ([0-9.e-]+)\]", text)
check(found and 0.01 < float(found[1]) < 10, f"a lamp falls off: {text}")
for program in ("arena", "blocks"):
    check("studio" not in study(program)[1], f"{program} has no lamps of a studio")
finish()
