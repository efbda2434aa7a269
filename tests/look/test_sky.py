#!/usr/bin/python3
# limit: 300 s
"""Ambient occlusion for a program without any (corpus/courtyard): corners and the ground near objects become darker,
open ground does not, OpenGL's own picture is unchanged, gate N passes, and the picture is the same on all devices."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, check_gates, corpus, diff, finish, must, record, relume, render  # noqa: E402

trace, rules = SCRATCH / "courtyard.trace", SCRATCH / "courtyard.look.yaml"
record(trace, corpus("courtyard"), "--frames", 2, "--animate", "camera", "--size", "400x300")
must(relume("look", trace, "-o", rules))
text = rules.read_text()
check("role: sky light" in text and "space: world" in text, f"a sky light is found, and the up direction: {text}")

SHOWN = {f"{layer}{c}" for layer in ("", "gl.", "shadow.") for c in "RGB"}
bare, lit = SCRATCH / "bare", SCRATCH / "lit"
render(trace, bare, "-f", 1)
render(trace, lit, "--look", "auto")
before, after = (Image(folder / "courtyard.0001.exr", SHOWN).planes for folder in (bare, lit))
check(all(before[f"gl.{c}"] == after[f"gl.{c}"] for c in "RGB"), "OpenGL's picture is unchanged")

def mean(planes, channel, x0, y0, x1, y1):
    return sum(sum(row[x0:x1]) for row in planes[channel][y0:y1]) / ((x1 - x0) * (y1 - y0))

open_ground, between_crates = mean(after, "shadow.G", 250, 200, 270, 215), mean(after, "shadow.G", 78, 150, 84, 190)
check(open_ground > 0.9, f"open ground keeps {open_ground:.2f} of its light")
check(between_crates < 0.75, f"between crates it keeps {between_crates:.2f} of its light")
code, score = diff(trace, lit)
check_gates(score, 2, "courtyard")
check(score["frames"][-1]["gates"]["N"]["state"] == "passed", f"{score['frames'][-1]['gates']['N']}")

# The same picture from every family of kernels and from the twins, except for ties between neighbours.
for name, options in (("reference", ("--device", "reference")), ("binary", ("--kernels", "binary")),
                      ("compressed", ("--kernels", "compressed"))):
    render(trace, SCRATCH / name, "-f", 1, "--look", rules, *options)
    other = Image(SCRATCH / name / "courtyard.0001.exr", SHOWN).planes
    far = sum(abs(a - b) > 0.02 for c in "RGB" for x, y in zip(after[c], other[c]) for a, b in zip(x, y))
    check(far <= 30, f"{name}: {far} numbers differ by more than 0.02")

# Roles of draws, from six frames together: each role once, and none for the world's draws.
longer = SCRATCH / "longer.trace"
record(longer, corpus("courtyard"), "--frames", 6, "--animate", "camera", "--size", "400x300")
must(relume("look", longer, "-o", rules))
text = rules.read_text()
for role in ("sky", "view model", "particle", "HUD"):
    check(text.count(f"- role: {role}\n") == 1, f"one rule for the {role}: {text}")
render(longer, SCRATCH / "longer", "-f", 4, "--look", rules)
known = Image(SCRATCH / "longer" / "longer.0004.exr", SHOWN).planes
check(mean(known, "shadow.G", 100, 5, 300, 40) == 1, "the sky keeps its light")
check(mean(known, "shadow.R", 14, 277, 130, 286) == 1, "the HUD keeps its light")

# A sky that OpenGL lights is found as well. It receives no shadows, and keeps OpenGL's colours.
lamp = SCRATCH / "lamp.trace"
record(lamp, corpus("courtyard"), "lit", "--frames", 6, "--animate", "camera", "--size", "400x300")
must(relume("look", lamp, "-o", rules))
text = rules.read_text()
check(text.count("- role: sky\n") == 1, f"one rule for a lit sky: {text}")
for name, options in (("shaded", ()), ("spared", ("--look", rules)), ("twins", ("--look", rules, "--device",
                                                                                "reference"))):
    render(lamp, SCRATCH / name, "-f", 4, *options)
shaded, spared, twins = (Image(SCRATCH / name / "lamp.0004.exr", SHOWN).planes
                         for name in ("shaded", "spared", "twins"))
check(mean(shaded, "shadow.G", 0, 0, 400, 60) < 0.97, "without rules walls cast shadows on the sky")
for name, planes in (("packets", spared), ("twins", twins)):
    check(all(min(map(min, planes[f"shadow.{c}"][:60])) == 1 for c in "RGB"), f"{name}: none do under rules")
    check(all(planes[c][:60] == planes[f"gl.{c}"][:60] for c in "RGB"), f"{name}: the lit sky is as OpenGL painted it")
check(mean(spared, "shadow.G", 340, 118, 400, 148) < 0.9, "a wall is shaded")

# Rules: no occlusion for wood, a key out of range.
edited = SCRATCH / "edited.yaml"
edited.write_text("surfaces:\n  - dome: no\n" + text[text.index("sky:"):])
render(trace, SCRATCH / "none", "-f", 1, "--look", edited)
none = Image(SCRATCH / "none" / "courtyard.0001.exr", SHOWN).planes
check(all(none[c] == before[c] for c in "RGB"), "with dome: no everywhere, the beauty equals that without rules")
for bad in ("sky: { up: [0, 1, 0] }\n", "sky: { reach: 0 }\n", "sky: { reach: 1, up: [0, 0, 0] }\n",
            "sky: { reach: 1, space: moon }\n"):
    edited.write_text(bad)
    done = relume("render", trace, "-f", 1, "-o", SCRATCH / "x.####.exr", "--look", edited)
    check(done.returncode == 3 and len(done.stderr.strip().splitlines()) == 1,
          f"{bad!r}: {done.returncode} {done.stderr}")
finish()
