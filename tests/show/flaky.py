#!/usr/bin/python3
"""tests/show/flaky.py BUILD (as `make show-flaky`): `relume diff REF RUN...` must distinguish five kinds of noise from
five real regressions.

Frames of a program of corpus/ are recorded live; each run is a copy of them. Some frames are noisy, differently in each
run; some are wrong in the same way in every run; some are both, and some neither.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "tests/show"), str(ROOT / "tests/fuzz")]
from exr_numpy import write_png  # noqa: E402
from page import colors  # noqa: E402

RUNS, SEED = 5, 1


# Noise: the picture of frame `frame` in run `run`. None: the run lacks the frame.

def grain(rng, frames, frame, run):
    picture = frames[frame].astype(int)
    hit = rng.random(picture.shape[:2]) < 0.03
    picture[hit] += rng.integers(-40, 41, (hit.sum(), 3))
    return picture


def clock(rng, frames, frame, run):
    picture = frames[frame].astype(int)
    for digit in range(8):
        picture[10:26, 12 + 14 * digit:24 + 14 * digit] = numpy.kron(rng.integers(0, 2, (4, 3)), numpy.ones(
            (4, 4)))[:, :, None] * 255
    return picture


def late(rng, frames, frame, run):
    return frames[frame + (run in (1, 3))].astype(int)


def dropped(rng, frames, frame, run):
    return None if run == 2 else frames[frame].astype(int)


def shaking(rng, frames, frame, run):
    return numpy.roll(frames[frame].astype(int), [(0, 1), (1, 0), (0, -1), (-1, 0), (1, 1)][run], (0, 1))


# Regressions: the same in every run.

def box(picture):
    h, w = picture.shape[:2]
    return slice(h // 2, h // 2 + h // 6), slice(w // 3, w // 3 + w // 6)


def recolored(picture):
    picture[box(picture)] = picture[box(picture)] // 2 + (60, 0, 0)


def gone(picture):
    picture[box(picture)] = (64, 79, 99)


def moved(picture):
    picture[:] = numpy.roll(picture, 3, 1)


def darker(picture):
    picture[:] = picture * 15 // 16 - 2


def checkered(picture):
    part = picture[box(picture)]
    part[(numpy.indices(part.shape[:2]) // 4).sum(0) % 2 == 0] += 30


NOISE, WRONG = [grain, clock, late, dropped, shaking], [recolored, gone, moved, darker, checkered]
BOTH = [(grain, recolored), (clock, darker), (grain, checkered), (late, gone), (dropped, moved)]
CASES = [(None, None)] * 2 + [(n, None) for n in NOISE] + [(None, w) for w in WRONG] + BOTH


def run(*args, codes=(0,)):
    done = subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode not in codes:
        sys.exit(f"{' '.join(map(str, args))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def name(case):
    return " and ".join(f.__name__ for f in case if f) or "nothing"


def plant(work, frames, rng):
    for at, (noise, wrong) in enumerate(CASES):
        seen = clock(rng, frames, at, -1).clip(0, 255).astype("u1") if noise is clock else frames[at]  # its own time
        write_png(work / "ref" / f"f.{at:04}.png", seen)
        for n in range(RUNS):
            picture = noise(rng, frames, at, n) if noise else frames[at].astype(int)
            if picture is None:
                continue
            if wrong:
                wrong(picture)
            write_png(work / f"run{n}" / f"f.{at:04}.png", picture.clip(0, 255).astype("u1"))


def main(build):
    relume, rows = (build / "relume").resolve(), []
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        run(ROOT / "tests/xvfb.sh", relume, "record", "-o", work / "s.trace", "--ref", "color", "--",
            build / "corpus/still_life", "--frames",
            len(CASES) + 1, "--animate", "camera", "--size", "320x240")
        frames = [picture for _, picture in colors(work / "s.ref")]
        for sub in ("ref", *(f"run{n}" for n in range(RUNS))):
            (work / sub).mkdir()
        plant(work, frames, numpy.random.default_rng(SEED))
        said = run(relume, "diff", work / "ref", *(work / f"run{n}" for n in range(RUNS)), codes=(0, 1))
    verdicts = {int(frame): verdict for frame, verdict in re.findall(r"^ +(\d+) (flaky|regression)", said, re.M)}
    lines = {
        int(line.split()[0]): " ".join(line.split())
        for line in said.splitlines()
        if re.match(r" +\d+ (flaky|reg)", line)
    }
    quarantined = " ".join(re.findall(r'frames: "([^"]*)"', said))
    for at, (noise, wrong) in enumerate(CASES):
        wanted = "regression" if wrong else "flaky" if noise else "steady"
        found = verdicts.get(at, "steady")
        rows.append({
            "what": f"frame {at}: {name((noise, wrong))}", "figure": lines.get(at, found), "bar": wanted, "peer": None,
            "passed": found == wanted
        })
    listed = {
        n for part in re.findall(r"\d+-?\d*", quarantined) for n in range(int(part.split("-")[0]),
                                                                          int(part.split("-")[-1]) + 1)
    }
    wanted = {at for at, (noise, wrong) in enumerate(CASES) if noise and not wrong and noise is not dropped}
    rows.append({
        "what": "quarantine proposed for frames", "figure": sorted(listed), "bar": sorted(wanted), "peer": None,
        "passed": listed == wanted
    })
    (build / "show").mkdir(exist_ok=True)
    (build / "show/flaky.json").write_text(
        json.dumps({"name": "flaky", "command": "make show-flaky", "rows": rows}, indent=1))
    for row in rows:
        print("holds" if row["passed"] else "FAILS", row["what"], row["figure"], sep="  ")
    print(f"{sum(not row['passed'] for row in rows)} mistakes")
    return any(not row["passed"] for row in rows)


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
