#!/usr/bin/python3
"""Objects in front of an empty dark window (corpus/viewer, corpus/cornell) keep OpenGL's lights when rules are
generated for them; a light that rules make too strong fails gate N."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from helpers import SCRATCH, check, corpus, diff, finish, must, record, relume, render  # noqa: E402

for program in ("cornell", "viewer"):
    trace, rules = SCRATCH / f"{program}.trace", SCRATCH / f"{program}.look.yaml"
    record(trace, corpus(program), "--frames", 2, "--size", "200x150")
    must(relume("look", trace, "-o", rules))
    check("lights: []" in rules.read_text(), f"{program} keeps its lights: {rules.read_text()}")


def harm_of(name, text):
    strong = SCRATCH / f"{name}.look.yaml"
    strong.write_text(text)
    render(trace, SCRATCH / name, "-f", 1, "--look", strong)
    code, score = diff(trace, SCRATCH / name)
    return code, score["frames"][-1]["gates"]["N"]


code, harm = harm_of("same", "lights: []\n")
check(code == 0 and harm["state"] == "passed", f"before the change: {harm}")
code, harm = harm_of("strong", "lights:\n  - { light: 0, position: [-3, 3, 3, 1], diffuse: [3, 3, 3] }\n")
check(code == 1 and harm["state"] == "failed" and harm["figures"][2]["value"] > 1, f"a lamp that is too strong: {harm}")
finish()
