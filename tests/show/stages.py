#!/usr/bin/python3
"""tests/show/stages.py BUILD [panels|piglit|glsl|cost|compile|glsl-all|real...] (`make show-programs`): vertices and
fragments by programs, compared with Mesa and with fixed function.

panels: tests/real/panels of programs, with a panel for each instruction, binding, option and interface, ten frames:
those that pass all gates. piglit: its tests of ARB_vertex_program, ARB_fragment_program and ATI_fragment_shader: the
last frame of each test that passes on Mesa is scored, R1 to R3. Recordings are in BUILD/show/stages, all outcomes in
BUILD/show/stages-*.tsv. glsl: the same for its shaders of GLSL 1.10 and 1.20 in the compatibility profile, one in ten;
glsl-all, only if named: all 3,287. compile: time from the text of a pair of shaders to instructions. real, only if
named (half an hour, longer the first time): the sweep's programs that use shaders, ten frames of each
(tests/show/sweep.py). cost: a frame of the same knot, lit by fixed function and by programs: processor time, medians of
alternating runs. Needs a display: run under tests/xvfb.sh.
"""
import json
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import zlib

import piglit
import programs
import sweep

GROUPS = re.compile(r"spec@(arb_(vertex|fragment)_program(_shadow)?|ati_fragment_shader)@")
LISTS = (("opengl", "gl"), ("shader", "shader"))
GLSL_VERSIONS = ("1.1", "1.2")
GLSL_EVERY = 10
PANELS = ("program", "vertex_program", "ati_shader", "shader")
WAYS = {
    "fixed": "fixed function", "vertex": "a vertex program", "fragment": "a fragment program", "glsl": "GLSL, per pixel"
}
PANEL_FRAMES = 10
FRAMES = 8
RUNS = 3
BAR_PIGLIT = 0.9
BAR_COST = 2
BAR_COLD_MS = 1000
BAR_WARM_MS = 10
BAR_REAL = 0.9
REAL_GROUPS = ("xscreensaver, GLSL", "OpenSceneGraph", "Qt 5 viewers", "games, GLSL")
REAL_NAMES = ("hyperspace",)  # from rss-glx


def must(*command, **more):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, **more)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}: exit {done.returncode}\n{done.stderr}")
    return done.stdout


def record(build, trace, *program):
    for old in trace.parent.glob(f"{trace.stem}.*"):
        old.unlink()
    must(build / "relume", "record", "--ref", "color,depth", "-o", trace, "--", *program)


def score_panels(build, base):
    rows = []
    os.environ["PANEL_FRAMES"] = str(PANEL_FRAMES)
    for name in PANELS:
        trace, frames = base / f"{name}.trace", base / name
        record(build, trace, build / "tests/real/panels" / name)
        must(build / "relume", "render", trace, "--mode", "gl", "--encoding", "display", "--force", "-o",
             frames / f"{name}.####.exr")
        done = subprocess.run([build / "relume", "diff", trace, frames, "--json", "-"], capture_output=True, text=True,
                              check=False)
        scored = json.loads(done.stdout)["frames"]
        failing = sum(frame["failing_pixels"] for frame in scored)
        good = sum(frame["outcome"] == "passed" for frame in scored)
        rows.append({
            "what": f"panels/{name}: frames that pass all gates",
            "figure": f"{good} of {len(scored)}, {failing} pixels fail", "bar": str(PANEL_FRAMES),
            "peer": "Mesa llvmpipe", "passed": good == len(scored) >= PANEL_FRAMES
        })
    return rows


def score_tests(build, folder, tests, title):
    """Score the last frames of piglit's tests."""
    ran = piglit.recorded_rows(build, tests, folder)
    rows = [row for row in ran if row["bare"].split()[0] == "pass" and row["frames"]]
    for row in rows:
        piglit.score(build, folder / re.sub(r"\W+", "_", row["name"]), row)
    piglit.write_table(build / "show" / f"stages-{folder.name}.tsv",
                       ("name", "command", "frame", "parity", "why", "fidelity", "one_colour", "left_out"), rows)
    for row in rows:
        if row["parity"] != "passes":
            print(f"{row['name']}: {row['parity']} {row['why']} {row.get('left_out', '')}"[:200])
    good = sum(row["parity"] == "passes" for row in rows)
    plain = sum(row["parity"] == "passes" and row["one_colour"] for row in rows)
    share = good / len(rows) if rows else 0
    return [{
        "what": f"piglit's tests of {title} ({len(tests)} run, {len(rows)} pass on Mesa and read pixels): last frames "
                f"that pass R1 to R3",
        "figure": f"{good} of {len(rows)} ({100 * share:.1f} %), {plain} of these of one colour",
        "bar": f"{100 * BAR_PIGLIT:.0f} %", "peer": "piglit on Mesa llvmpipe", "passed": share >= BAR_PIGLIT
    }]


def score_piglit(build, base):
    return score_tests(build, base / "piglit", piglit.find_tests((), GROUPS, LISTS),
                       "ARB programs and ATI fragment shaders")


def score_glsl(build, base, every=GLSL_EVERY):
    tests = [
        test for test in piglit.find_tests((), re.compile(""), LISTS[1:], GLSL_VERSIONS)
        if zlib.crc32(test[0].encode()) % every == 0
    ]
    return score_tests(build, base / "glsl", tests, f"GLSL 1.10 and 1.20, one of {every} by their names' CRC-32")


def score_all_glsl(build, base):
    return score_glsl(build, base, 1)


def processor_s(*command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    must(*command)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def score_cost(build, base):
    """Cost of an additional frame: all frames minus the first alone."""
    costs = {way: [] for way in WAYS}
    for way in WAYS:
        record(build, base / f"{way}.trace", build / "corpus" / "phong", "--frames", FRAMES, "--size", "640x480",
               "--animate", "camera", "--by", way)
    for number in range(RUNS + 1): # the first run compiles the kernels
        for way in WAYS:
            def frames(last):
                return processor_s(build / "relume", "render", base / f"{way}.trace", "-f", f"0-{last}", "--force",
                                   "-o", base / way / "x.####.exr")
            took = (frames(FRAMES - 1) - frames(0)) / (FRAMES - 1)
            if number:
                costs[way].append(took)
    median = {way: statistics.median(costs[way]) for way in WAYS}
    return [{
        "what": f"a frame of a lit knot by {WAYS[way]}, of fixed function's {1000 * median['fixed']:.0f} ms of "
                f"processor time",
        "figure": f"{median[way] / median['fixed']:.2f} times", "bar": f"{BAR_COST} times", "peer": "fixed function",
        "passed": median[way] <= BAR_COST * median["fixed"]
    } for way in WAYS if way != "fixed"]


def score_compile(build, base):
    """Each run is a new process, so the first pair of shaders finds a cold cache."""
    took = [[float(ms) for ms in must(build / "tests/bench/translate").split()] for _ in range(RUNS)]
    return [{
        "what": f"a pair of shaders, text to instructions, {what}", "figure": f"{median:.2f} ms", "bar": f"{bar} ms",
        "peer": None, "passed": median <= bar
    } for what, bar, median in zip(("cold", "warm"), (BAR_COLD_MS, BAR_WARM_MS), map(statistics.median, zip(*took)))]


def score_real(build, base):
    """Uses the sweep's recordings and lines."""
    chosen = [p for p in programs.sweep() if p.group in REAL_GROUPS or p.name in REAL_NAMES]
    lines = []
    for program in chosen:
        lines.append(sweep.score(build, program, build / "show" / "sweep" / program.name, PANEL_FRAMES, False))
        print(
            f"{program.name}: {lines[-1].passed} of {lines[-1].frames} frames {lines[-1].missed} {lines[-1].note}"[:
                                                                                                                   200],
            flush=True)
    good, frames = (sum(getattr(line, what) for line in lines) for what in ("passed", "frames"))
    unscored = sum(not line.frames for line in lines)
    return [{
        "what": f"frames of {len(lines)} programs with shaders that pass all gates ({unscored} programs have none)",
        "figure": f"{good} of {frames} ({100 * good / max(frames, 1):.1f} %)", "bar": f"{100 * BAR_REAL:.0f} %",
        "peer": "Mesa llvmpipe, in the program", "passed": frames > 0 and not unscored and good >= BAR_REAL * frames
    }]


PARTS = {
    "panels": score_panels, "piglit": score_piglit, "glsl": score_glsl, "cost": score_cost, "compile": score_compile
}
MORE_PARTS = {"glsl-all": score_all_glsl, "real": score_real}  # only if named: they take an hour


def main(build, *parts):
    build = pathlib.Path(build).resolve()
    if not (piglit.PIGLIT / "bin").is_dir():
        sys.exit("piglit is not installed: make build/deps.piglit")
    os.environ.setdefault("POCL_CACHE_DIR", str(build / "tests/pocl-cache"))
    base = build / "show" / "stages"
    base.mkdir(parents=True, exist_ok=True)
    rows = [row for part in parts or PARTS for row in (PARTS | MORE_PARTS)[part](build, base)]
    return piglit.show(build, "programs", rows, "show-programs")


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
