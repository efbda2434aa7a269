#!/usr/bin/python3
# limit: 400 s
"""Drawn substitutes for light are recognised by their matrices (corpus/tricks): light and plane are found to 0.1 %, and
the beauty without the trick equals that of the same scene drawn without it. OpenGL's own picture is unchanged."""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, finish, must, record, relume, render  # noqa: E402

FRAME, COLORS, GL = 2, ["R", "G", "B"], ["gl.R", "gl.G", "gl.B", "Z", "id"]
# World space is the first frame's eye space: the program's world, moved by (0, -1.5, -8).
LIGHT, DIRECTION, FLOOR, MIRROR = (2, 2.5, -7, 1), (0.4364358, 0.8728716, 0.2182179, 0), (0, 1, 0, 1.5), (0, 0, 1, 11)


def traced(kind, rules=None, name="traced"):
    """The frame's picture, under rules if any are given."""
    file = render(SCRATCH / f"{kind}.trace", SCRATCH / f"{kind}-{name}", "-f", FRAME, "--aov", "gl,Z,id",
                  *(("--look", rules) if rules else ()))[0]
    return Image(file, COLORS + GL)


def numbers(text, key):
    """All values of a key, each as a list of numbers."""
    return [[float(x) for x in found.split(",")] for found in re.findall(rf"^ +{key}: \[([^]]*)\]", text, re.M)]


def check_numbers(found, true, what):
    length = sum(x * x for x in true) ** 0.5
    off = min((sum((a - b) ** 2 for a, b in zip(f, true)) ** 0.5 for f in found), default=None)
    check(found and all(sum((a - b)**2 for a, b in zip(f, true))**0.5 < 1e-3 * length for f in found),
          f"{what}: off by {off} of {length}: {found}")


def worst(a, b, channels):
    return max(abs(x - y) for c in channels for p, q in zip(a.planes[c], b.planes[c]) for x, y in zip(p, q))


for kind in ("none", "traced-mirror", "planar", "directional", "zpass", "zfail", "mirror"):
    record(SCRATCH / f"{kind}.trace", corpus("tricks"), kind, "--frames", FRAME + 1, options=())
plain, mirror = traced("none"), traced("traced-mirror")

for kind, role, light, plane in (("planar", "planar shadow", LIGHT,
                                  FLOOR), ("directional", "planar shadow", DIRECTION,
                                           FLOOR), ("zpass", r"shadow volume \(z-pass\)", LIGHT, None),
                                 ("zfail", r"shadow volume \(z-fail\)", LIGHT, None), ("mirror", "stencil mirror", None,
                                                                                       MIRROR)):
    rules = SCRATCH / f"{kind}.look.yaml"
    must(relume("look", SCRATCH / f"{kind}.trace", "-o", rules))
    # Keep only the rules for tricks: ambient occlusion and highlights also change scenes without tricks.
    text = re.sub(r"\n(sky|gloss):\n( .*\n)*", "\n", rules.read_text())
    rules.write_text(text)
    check(len(re.findall(rf"^  - role: {role}$", text, re.M)) == 1, f"{kind}: found once: {text}")
    found = numbers(text, "position")
    check(len(found) == (light is not None), f"{kind}: lights: {found}")
    if light:
        check_numbers(found, light, f"{kind}: the light")
    if plane:
        check_numbers(numbers(text, "plane"), plane, f"{kind}: the plane")
    if kind not in ("planar", "zfail", "mirror"):
        continue
    after = traced(kind, rules, "after")
    off = worst(after, mirror if kind == "mirror" else plain, COLORS)
    check(off < 0.002, f"{kind}: the beauty equals that of the scene without the trick: off by {off}")
    if kind == "planar":
        before = traced(kind, name="before")
        check(all(before.planes[c] == after.planes[c] for c in GL), f"{kind}: OpenGL's picture is unchanged")
        check(
            worst(before, plain, COLORS) < 0.002,
            f"{kind}: a drawn shadow of OpenGL's own light is replaced without rules, too")
        rules.write_text(text.replace("replace: yes", "replace: no"))
        kept = traced(kind, rules, "kept")
        check(worst(kept, after, COLORS) > 0.02, f"{kind}: one key keeps the trick")
        rules.write_text("spare: no\n")
        check(
            worst(kept, traced(kind, rules, "both"), COLORS) > 0.02,
            f"{kind}: there is no second shadow, also without sparing")
    if kind == "mirror":
        # If no surface is the mirror, as in a frame that draws it differently, its drawn picture is kept.
        rules.write_text(text.replace("replace: yes", "replace: no"))
        kept = traced(kind, rules, "kept")
        rules.write_text(re.sub(r"in_plane: \[[^]]*\]", "in_plane: [0, 0, 1, 99]", text))
        check(
            worst(traced(kind, rules, "elsewhere"), kept, COLORS) == 0,
            f"{kind}: without the mirror its picture is kept")
        check(worst(kept, after, COLORS) > 0.02, f"{kind}: the traced mirror differs from its picture")
finish()
