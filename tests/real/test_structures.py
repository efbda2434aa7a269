#!/usr/bin/python3
# limit: 400 s
"""Every acceleration structure gives the same files, to the byte, including mirrors, glass and shadows; and the
builders' costs compared with Embree's."""
import json
import subprocess

from exr import Image
from helpers import BUILD, SCRATCH, check, corpus, finish, must, record, relume, render

for name, program in (("cornell", ("--mesh", "--mirror")), ("spheres", ())):
    trace = SCRATCH / f"{name}.trace"
    record(trace, corpus(name), "--frames", "1", *program, options=())
    plain = render(trace, SCRATCH / f"{name}.bvh", "--no-cache")[0]
    lit = sum(value > 0 for row in Image(plain, {"reflect.R"}).planes["reflect.R"] for value in row)
    check(lit > 1000, f"{name}: mirrors show something in {lit} pixels")
    for kind in ("sbvh", "kd", "lbvh"):
        other = render(trace, SCRATCH / f"{name}.{kind}", "--no-cache", "--accel", kind)[0]
        check(other.read_bytes() == plain.read_bytes(), f"{name}: the file differs with {kind}")
bad = relume("render", trace, "-o", SCRATCH / "no.#.exr", "--accel", "octree")
check(bad.returncode == 2, f"--accel octree ends with {bad.returncode}")

# The columns that depend only on the trees are the same on every machine.
trees = {
    tree["accel"]: tree for tree in json.loads(
        must(relume("bench", "--accel", "all", "--repeat", "1", "--json", timeout=300)).stdout)["trees"]
}
check(list(trees) == ["bvh", "sbvh", "kd", "lbvh"], f"bench --accel all measures {list(trees)}")
check(all(tree[figure] > 0 for tree in trees.values() for figure in tree if figure != "accel"), f"figures: {trees}")
check(trees["sbvh"]["sah_cost"] <= trees["bvh"]["sah_cost"] < trees["lbvh"]["sah_cost"], f"costs: {trees}")
check(
    trees["bvh"]["items_per_triangle"] == trees["lbvh"]["items_per_triangle"] == 1 < trees["kd"]["items_per_triangle"] <
    5, f"items: {trees}")
for arguments, code in ((("--accel", "octree"), 2), (("--accel", "kd", trace), 2)):
    bad = relume("bench", *arguments)
    check(bad.returncode == code and bad.stderr.count("\n") == 1, f"bench {arguments}: {bad.returncode} {bad.stderr!r}")

# The short form of make show-build: costs are the same on every machine, times are not.
path = SCRATCH / "build.json"
must(
    subprocess.run([BUILD / "tests/bench/build", "--repeat", "1", "--json", path], capture_output=True, text=True,
                   check=False))
rows = json.loads(path.read_text())["rows"]
costs = [row for row in rows if row["what"].endswith("SAH cost")]
check(len(costs) == 4, f"{len(costs)} costs of builders")
for row in costs:
    check(row["passed"], f"{row['what']}: {row['figure']}, bar {row['bar']}")
finish()
