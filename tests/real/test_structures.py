#!/usr/bin/python3
# limit: 400 s
"""The same pictures from every acceleration structure, mirror and shadows included; and the builders' costs beside Embree's."""
import json
import subprocess

from exr import Image
from helpers import BUILD, SCRATCH, check, corpus, finish, must, record, relume, render

CHANNELS = {"R", "G", "B", "gl.R", "gl.G", "gl.B", "shadow.R", "reflect.R", "Z", "id", "N.X", "P.Y"}


def same(a, b, what):
    """Every pixel: which tree it was is not to be seen."""
    check(set(a.planes) == set(b.planes) == CHANNELS, f"{what}: channels {sorted(b.planes)}")
    differ = {(x, y) for name, rows in a.planes.items() for y in range(a.height) if rows[y] != b.planes[name][y]
              for x in range(a.width) if rows[y][x] != b.planes[name][y][x]}
    check(not differ, f"{what}: {len(differ)} pixels differ, as {sorted(differ)[:3]}")


trace = SCRATCH / "structures.trace"
record(trace, corpus("cornell"), "--frames", "1", "--mesh", "--mirror", options=())
plain = Image(render(trace, SCRATCH / "bvh")[0], CHANNELS)
lit = sum(value > 0 for row in plain.planes["reflect.R"] for value in row)
check(lit > 1000, f"the mirror shows something in {lit} pixels")
for kind in ("sbvh", "kd", "lbvh"):
    same(plain, Image(render(trace, SCRATCH / kind, "--no-cache", "--accel", kind)[0], CHANNELS), kind)
bad = relume("render", trace, "-o", SCRATCH / "no.#.exr", "--accel", "octree")
check(bad.returncode == 2, f"--accel octree ends with {bad.returncode}")

# The short form of make show-build: costs are the same on every machine, times are not.
path = SCRATCH / "build.json"
must(subprocess.run([BUILD / "tests/bench/build", "--repeat", "1", "--json", path], capture_output=True, text=True, check=False))
rows = json.loads(path.read_text())["rows"]
costs = [row for row in rows if row["what"].endswith("SAH cost")]
check(len(costs) == 4, f"{len(costs)} costs of builders")
for row in costs:
    check(row["passed"], f"{row['what']}: {row['figure']}, bar {row['bar']}")
finish()
