#!/usr/bin/python3
# limit: 400 s
"""A dark floor without texture grain that receives a shadow reflects the object on it (corpus/tricks grid), about its
own plane, because its draw has no normals. A floor with grain (gravel) does not. OpenGL's own picture is unchanged."""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, finish, must, record, relume, render  # noqa: E402

GL, MIRRORED = ["gl.R", "gl.G", "gl.B", "Z", "id"], ["reflect.R", "reflect.G", "reflect.B"]
SHARE = 0.25  # reflectance of the floor
# The cube is 1.2 wide and hangs 0.9 above the floor; its reflection is equally far below.
BELOW = 0.9


def study(kind):
    record(SCRATCH / f"{kind}.trace", corpus("tricks"), kind, "--frames", 3, options=())
    rules = SCRATCH / f"{kind}.look.yaml"
    must(relume("look", SCRATCH / f"{kind}.trace", "-o", rules))
    return rules


def traced(kind, name, *options):
    return Image(
        render(SCRATCH / f"{kind}.trace", SCRATCH / f"{kind}-{name}", "-f", 0, "--aov", "gl,reflect,Z,id", *options)[0],
        GL + MIRRORED)


rules = study("grid")
text = rules.read_text()
check(len(re.findall(r"^  - role: polished floor$", text, re.M)) == 1, f"the grid is found: {text}")
check("role: polished floor" not in study("gravel").read_text(), "gravel is not reflective")

before, after = traced("grid", "before"), traced("grid", "after", "--look", rules)
check(all(before.planes[c] == after.planes[c] for c in GL), "OpenGL's picture is unchanged")
check(not any(x for c in MIRRORED for row in before.planes[c] for x in row), "nothing reflects without rules")
# Frame 0 looks horizontally along -z from (0, 1.5, 8): in the middle column, the cube's lowest front edge is at height
# 0.9, its reflection at -0.9.
height, width = len(after.planes["Z"]), len(after.planes["Z"][0])
focal = height / 2 / 0.41421356  # for 45 degrees


def pixel(x, y, z):
    """The row and column in frame 0 that show a place of the world."""
    return round(height / 2 - focal * (y - 1.5) / (8 - z)), round(width / 2 + focal * x / (8 - z))


row, column = pixel(0.5, -BELOW - 0.3, 0.6)
seen = [after.planes[c][row][column] for c in MIRRORED]
check(seen[0] > 2 * max(seen[1], seen[2], 0.002),
      f"the floor shows the red cube upside down: {seen} at {row}, {column}")
row, column = pixel(-3, -BELOW - 0.3, 0.6)
check(max(after.planes[c][row][column] for c in MIRRORED) < 0.5 * seen[0], "no reflection beside the cube")
finish()
