#!/usr/bin/python3
# limit: 400 s
"""Levels of rooms (corpus/rooms): they are sound, every kind of culling gives the same picture, and the period's
rendering tricks pass every gate."""
import json

from helpers import ROOT, SCRATCH, check, check_gates, corpus, diff, finish, must, record, render, run

ELEVEN = ROOT / "corpus/rooms/eleven.level"
TRICKS = ("--mirror", "--shadow")

done = must(run(corpus("rooms"), "--check", 10))
check("10 of 10 levels are sound" in done.stdout, done.stdout)

# Zones and polygons of the stored level, and its picture with every kind of culling.
for culling in ("none", "frustum", "portal", "bsp", "octree"):
    record(SCRATCH / f"{culling}.trace", corpus("rooms"), "--level", ELEVEN, "--frames", 2, "--animate", "camera",
           "--cull", culling, *TRICKS, "--truth", SCRATCH / "truth.json")
    code, score = diff(SCRATCH / "none.ref", SCRATCH / f"{culling}.ref")
    check(code == 0 and all(f["failing_pixels"] == 0 for f in score["frames"]),
          f"{culling}: the same pictures as without culling")
truth = json.loads((SCRATCH / "truth.json").read_text())
check(
    len(truth["zones"]) == 11 and truth["open_edges"] == 0,
    f"eleven closed zones: {len(truth['zones'])}, {truth['open_edges']} open edges")
polygons = truth["polygons"]
check(polygons["portal"] < polygons["frustum"] < polygons["bsp"] <= polygons["octree"] < polygons["none"],
      f"polygons drawn: {polygons}")

for lighting, environment in (("multitexture", "cube"), ("pass", "sphere")):
    trace = SCRATCH / f"{lighting}.trace"
    record(trace, corpus("rooms"), "--seed", 5, "--frames", 1, "--lighting", lighting, "--environment", environment,
           *TRICKS)
    render(trace, SCRATCH / lighting)
    check_gates(diff(trace, SCRATCH / lighting)[1], 1, f"{lighting}, {environment} map")

wrong = SCRATCH / "wrong.level"
wrong.write_text("subtract box 0 0 0 4 4 4 0\nadd cylinder 1 1 0.5 0 2 2 0\n")
done = run(corpus("rooms"), "--level", wrong)
check(done.returncode == 2 and f"{wrong}:2: " in done.stderr,
      f"an invalid level is reported with its line: {done.stderr}")
finish()
