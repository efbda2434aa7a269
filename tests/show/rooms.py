#!/usr/bin/python3
"""tests/show/rooms.py BUILD (as `make show-rooms`): levels of corpus/rooms: how many of 100 are sound, what each culling draws of the
level that is kept, and how many of 20 levels pass all gates on 5 frames, with all the tricks that the program knows."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LEVELS, FRAMES = 20, 5
CULLINGS, LIGHTINGS, ENVIRONMENTS = ("none", "frustum", "portal", "bsp", "octree"), ("multitexture", "pass", "opengl"), ("cube", "sphere")


def run(*args):
    return subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)


def record(build, trace, *options):
    done = run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", trace, "--ref", "color,depth", "--", build / "corpus/rooms", *options)
    if done.returncode:
        sys.exit(done.stderr)


def passing_frames(build, seed, work):
    """How many frames of a level pass all gates; which tricks it draws depends on its number."""
    trace, frames = work / f"{seed}.trace", work / f"{seed}"
    record(build, trace, "--seed", seed, "--frames", FRAMES, "--animate", "camera", "--cull", CULLINGS[seed % 5], "--lighting", LIGHTINGS[seed % 3],
           "--environment", ENVIRONMENTS[seed % 2], *(("--mirror",) if seed % 4 < 3 else ()), *(("--shadow",) if seed % 4 else ()))
    run(build / "relume", "render", trace, "-o", frames / "f.####.exr")
    score = json.loads(run(build / "relume", "diff", trace, frames, "--json", "-").stdout)
    return score["counts"]["passed"]


def main(build):
    rows, bad = [], 0

    def row(what, figure, bar, passed, peer=None):
        nonlocal bad
        bad += passed is False
        rows.append({"what": what, "figure": figure, "bar": bar, "peer": peer, "passed": passed})
        print(f"{what}: {figure}" + (f" (bar: {bar})" if bar else ""), flush=True)

    done = run(build / "corpus/rooms", "--check", 100).stdout
    sound = int(re.search(r"(\d+) of 100 levels are sound", done)[1])
    row("levels with every zone closed, no T-junction, each of 10,000 points in its leaf", f"{sound} of 100", "100 of 100", sound == 100)
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        record(build, work / "eleven.trace", "--level", ROOT / "corpus/rooms/eleven.level", "--frames", 1, "--truth", work / "truth.json")
        truth = json.loads((work / "truth.json").read_text())
        row("zones of corpus/rooms/eleven.level", len(truth["zones"]), 11, len(truth["zones"]) == 11, "the source's level: 11")
        drawn = truth["polygons"]
        row("polygons drawn: " + ", ".join(drawn), ", ".join(map(str, drawn.values())), None, None, "the source: 508 without, 200 with portals")
        passed = [passing_frames(build, seed, work) for seed in range(LEVELS)]
        row("frames of 20 levels that pass all gates", f"{sum(passed)} of {LEVELS * FRAMES}", f"{LEVELS * FRAMES} of {LEVELS * FRAMES}",
            sum(passed) == LEVELS * FRAMES)
    (build / "show").mkdir(parents=True, exist_ok=True)
    (build / "show/rooms.json").write_text(json.dumps({"name": "rooms", "command": "make show-rooms", "rows": rows}, indent=1))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
