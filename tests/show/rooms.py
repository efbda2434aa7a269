#!/usr/bin/python3
"""tests/show/rooms.py BUILD (as `make show-rooms`): levels of corpus/rooms: how many of 100 are sound, how much each
kind of culling draws of the stored level, and how many of 20 levels, with all the program's tricks, pass all gates on 5
frames. Also how many of 1,000 closed meshes, broken at random, scene/repair closes again. ONLY=levels or ONLY=repair
selects one part."""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LEVELS, FRAMES, MESHES = 20, 5, 1000
CULLINGS, LIGHTINGS, ENVIRONMENTS = ("none", "frustum", "portal", "bsp", "octree"), ("multitexture", "pass",
                                                                                     "opengl"), ("cube", "sphere")


def run(*args):
    return subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)


def record(build, trace, *options):
    done = run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", trace, "--ref", "color,depth", "--",
               build / "corpus/rooms", *options)
    if done.returncode:
        sys.exit(done.stderr)


def passing_frames(build, seed, work):
    """Number of a level's frames that pass all gates; its tricks depend on its number."""
    trace, frames = work / f"{seed}.trace", work / f"{seed}"
    record(build, trace, "--seed", seed, "--frames", FRAMES, "--animate", "camera", "--cull", CULLINGS[seed % 5],
           "--lighting", LIGHTINGS[seed % 3], "--environment", ENVIRONMENTS[seed % 2],
           *(("--mirror", ) if seed % 4 < 3 else ()), *(("--shadow", ) if seed % 4 else ()))
    run(build / "relume", "render", trace, "-o", frames / "f.####.exr")
    score = json.loads(run(build / "relume", "diff", trace, frames, "--json", "-").stdout)
    return score["counts"]["passed"]


def score_levels(build, row):
    done = run(build / "corpus/rooms", "--check", 100).stdout
    sound = int(re.search(r"(\d+) of 100 levels are sound", done)[1])
    row("levels with every zone closed, no T-junction, each of 10,000 points in its leaf", f"{sound} of 100",
        "100 of 100", sound == 100)
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        record(build, work / "eleven.trace", "--level", ROOT / "corpus/rooms/eleven.level", "--frames", 1, "--truth",
               work / "truth.json")
        truth = json.loads((work / "truth.json").read_text())
        row("zones of corpus/rooms/eleven.level", len(truth["zones"]), 11,
            len(truth["zones"]) == 11, "the source's level: 11")
        drawn = truth["polygons"]
        row("polygons drawn: " + ", ".join(drawn), ", ".join(map(str, drawn.values())), None, None,
            "the source: 508 without, 200 with portals")
        passed = [passing_frames(build, seed, work) for seed in range(LEVELS)]
        row("frames of 20 levels that pass all gates", f"{sum(passed)} of {LEVELS * FRAMES}",
            f"{LEVELS * FRAMES} of {LEVELS * FRAMES}",
            sum(passed) == LEVELS * FRAMES)


def score_repair(build, row):
    """The test writes one line for each mesh that is not closed again."""
    done = run(build / "tests/unit/test_repair", MESHES)
    closed, exact, worst = re.search(
        r"(\d+) of \d+ meshes closed, (\d+) with their volume within 1e-05; the worst volume is off by (\S+);",
        done.stdout).groups()
    print(done.stderr, end="")
    row("meshes broken at random that are closed again", f"{closed} of {MESHES}", f"{MESHES} of {MESHES}",
        int(closed) == MESHES)
    row("meshes closed with their volume within 1e-5", f"{exact} of {MESHES}, largest error {worst}",
        f"{MESHES} of {MESHES}",
        int(exact) == MESHES)


PARTS = {"levels": score_levels, "repair": score_repair}


def main(build, only):
    rows, bad = [], 0

    def row(what, figure, bar, passed, peer=None):
        nonlocal bad
        bad += passed is False
        rows.append({"what": what, "figure": figure, "bar": bar, "peer": peer, "passed": passed})
        print(f"{what}: {figure}" + (f" (bar: {bar})" if bar else ""), flush=True)

    for name, score in PARTS.items():
        if not only or name in only:
            score(build, row)
    (build / "show").mkdir(parents=True, exist_ok=True)
    (build / "show/rooms.json").write_text(
        json.dumps({"name": "rooms", "command": "make show-rooms", "rows": rows}, indent=1))
    return 1 if bad else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=PARTS)
    options = parser.parse_args()
    sys.exit(main(options.build, options.only))
