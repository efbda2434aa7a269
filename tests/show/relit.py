#!/usr/bin/python3
"""tests/show/relit.py BUILD [NAME...] (as `make show-relit`): programs of the corpus as raster frame, beauty without
rules, and beauty under the rules of `relume look`, side by side in BUILD/show/relit/NAME.png, for inspection. Gate N
must pass: no frame is darker than its shadows explain. Channels of OpenGL's own picture must be the same in both
beauties. A relit frame may cost at most twice a whitted one, for these and all real programs (by name: cost). A study
of 1,000 frames may cost at most as much as rendering 20 (study.py; by name: study). Then come the same pictures of real
programs, with the verdicts of people who inspected them (sheet.py), and of levels with portal culling (unseen.py; by
name: unseen)."""
import itertools
import json
import pathlib
import resource
import subprocess
import sys
import tempfile

import programs
import sheet as real
import study
import unseen
from display import need_display

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAMS = {
    **{f"tricks-{kind}": ("tricks", kind) for kind in ("planar", "directional", "zpass", "zfail", "mirror")}, **{
        f"rooms-{lighting}": ("rooms", "--seed", 5, "--lighting", lighting, "--mirror", "--shadow", "--environment", "cube") for lighting in ("multitexture", "pass", "opengl")
    }, "spheres": ("spheres", ), "still_life": ("still_life", ), "closed_hall": ("closed_hall", ), "arena": ("arena", ),
    "courtyard": ("courtyard", "--animate", "camera")
}
FRAME = 1
FEW, RECORDED, MANY = 2, 8, 50 # frame counts
QUICK_S = 0.5 # for RECORDED frames; below this, start-up time varies by too large a share
COST = 2 # maximum ratio to a frame without rules


def run(*args):
    done = subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1, 4):
        sys.exit(f"{' '.join(map(str, args))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def sheet(frames, out):
    """Raster, beauty and relit side by side, in display colours."""
    columns = []
    for name, file, channels in (("gl", frames[0], "gl.R,gl.G,gl.B"), ("beauty", frames[0], "R,G,B"),
                                 ("relit", frames[1], "R,G,B")):
        picture = out.with_name(f"{out.stem}.{name}.png")
        run("oiiotool", file, "--ch", channels, "--colorconvert", "linear", "sRGB", "-o", picture)
        columns.append(picture)
    run("oiiotool", *columns, "--mosaic:pad=4", "3x1", "-o", out)
    for picture in columns:
        picture.unlink()


def gate(build, trace, folder):
    scored = json.loads(run(build / "relume", "diff", trace, folder, "--json", "-"))["frames"]
    frame = next(f for f in scored if f["frame"] == FRAME)
    return frame["gates"]["N"]["state"], frame["gates"]["R1"]["state"]


def seconds(build, trace, folder, first, last, *look):
    """Processor time of frames `first` to `last`, with rules studied beforehand."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run(build / "relume", "render", trace, "-f", f"{first}-{last}", "-o", folder / "cost.####.exr", *look)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def cost(build, trace, folder, first=0):
    """Ratio of a relit frame's processor time to that of a frame without rules, both after subtracting start-up, with
    two workers. The least of three alternating runs each. For fast frames more of them are rendered, if the recording
    has them."""
    rules = folder / "cost.look.yaml"
    run(build / "relume", "look", trace, "-o", rules)
    end = json.loads(run(build / "relume", "info", trace, "--json"))["frames"]
    is_quick = seconds(build, trace, folder, first, first + RECORDED - 1) < QUICK_S
    n = max(RECORDED, min(MANY, end - first)) if is_quick else RECORDED
    ways, times = ((), ("--look", rules)), {}
    for _ in range(3):
        for way, frames in itertools.product(range(2), (FEW, n)):
            times.setdefault((way, frames),
                             []).append(seconds(build, trace, folder, first, first + frames - 1, *ways[way]))
    more = [min(times[way, n]) - min(times[way, FEW]) for way in range(2)]
    return more[1] / max(more[0], 1e-3)


def cost_row(name, times):
    return {
        "what": f"{name}: processor time of a relit frame over a whitted one", "figure": round(times, 2), "bar": COST,
        "peer": None, "passed": times <= COST
    }


def cost_rows(build, only):
    """Rows of real programs."""
    for program in real.all_programs():
        if only and not {program.name, "cost"} & set(only):
            continue
        trace, frame, _ = real.find(build, program)
        if trace is None:
            print(f"{program.name}: {frame}", flush=True)
            continue
        with tempfile.TemporaryDirectory() as folder:
            times = cost(build, trace, pathlib.Path(folder), frame)
        print(f"{program.name}: {times:.2f} times the cost (bar: {COST})", flush=True)
        yield cost_row(program.name, times)


def judge(build, only):
    """Rows of real programs."""
    rows, verdicts = [], {}
    for program in real.all_programs():
        if only and program.name not in only:
            continue
        with tempfile.TemporaryDirectory() as folder:
            row, verdicts[program.name] = real.row(build, program, pathlib.Path(folder))
        rows.append(row)
    if not only:
        better = sum(verdicts[program.name] == "better" for program in programs.OPEN)
        rows.append({
            "what": "programs of the open set that are better relit", "figure": f"{better} of {len(programs.OPEN)}",
            "bar": real.BETTER, "peer": None, "passed": better >= real.BETTER
        })
        print(f"better relit: {better} of {len(programs.OPEN)} (bar: {real.BETTER})", flush=True)
    return rows


def main(build, only):
    need_display()
    rows, bad, out = [], 0, build / "show/relit"
    out.mkdir(parents=True, exist_ok=True)
    for name, program in PROGRAMS.items():
        if only and name not in only:
            continue
        with tempfile.TemporaryDirectory() as folder:
            work, frames = pathlib.Path(folder), []
            trace = work / "x.trace"
            run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", trace, "--ref", "color,depth", "--",
                build / "corpus" / program[0], *program[1:], "--frames", RECORDED)
            for kind, look in (("beauty", ()), ("relit", ("--look", "auto"))):
                run(build / "relume", "render", trace, "-f", FRAME, "-o", work / kind / "x.####.exr", *look)
                frames.append(work / kind / f"x.{FRAME:04d}.exr")
            sheet(frames, out / f"{name}.png")
            harm, raster = gate(build, trace, work / "relit")
            times = cost(build, trace, work)
        passed = harm == "passed" and raster == "passed"
        bad += not passed
        rows.append({
            "what": f"{name}: gates N, R1 of the relit frame", "figure": f"{harm}, {raster}", "bar": "passed",
            "peer": None, "passed": passed
        })
        rows.append(cost_row(name, times))
        bad += times > COST
        print(
            f"{name}: gate N {harm}, gate R1 {raster}; {times:.2f} times the cost (bar: {COST}); look at "
            f"{out}/{name}.png",
            flush=True)
    for row in cost_rows(build, only):
        rows.append(row)
        bad += not row["passed"]
    for name, part in (("study", study), ("unseen", unseen)):
        if only and name not in only:
            continue
        with tempfile.TemporaryDirectory() as folder:
            for row in part.rows(build, pathlib.Path(folder)):
                rows.append(row)
                bad += not row["passed"]
    for row in judge(build, only):
        rows.append(row)
        bad += not row["passed"]
    (build / "show/relit.json").write_text(
        json.dumps({"name": "relit", "command": "make show-relit", "rows": rows}, indent=1))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]))
