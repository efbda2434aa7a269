#!/usr/bin/python3
"""tests/show/parity.py BUILD [PART-OF-A-NAME...] (as `make show-parity`): does `gl` equal what OpenGL rasterized?

Records glxgears and the corpus' first scenes live, with reference frames read back in the program, and takes the traces
of ../shared/traces where they are there, ten frames each, with reference frames made by glretrace (never its first
frame, which is known to be wrong). Bars: all gates on all frames of what is recorded live; R1 to R4 on glxgears, SceneViewer
and lament; the other traces are scored for information.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TRACES = ROOT.parent / "shared" / "traces"
N_FRAMES = 10
LIVE = {
    "glxgears": ["glxgears"],
    "two_triangles": ["two_triangles", "--animate", "camera"],
    "cornell": ["cornell", "--animate", "camera"],
    "cornell, moving light": ["cornell", "--animate", "light", "--vbo"],
}
RASTER_GATES = ("R1", "R1b", "R2", "R3", "R4")
LIVE_GATES = ("V", "R1", "R1b", "R2", "R3", "R4", "R5", "E1", "E2", "P")
DEMANDED = {"glxgears", "iv-SceneViewer", "xss-lament"}


def run(*command, log):
    with open(log, "a") as out:
        out.write(f"$ {' '.join(map(str, command))}\n")
        out.flush()
        return subprocess.run(list(map(str, command)), cwd=ROOT, stdin=subprocess.DEVNULL, stdout=out,
                              stderr=subprocess.STDOUT, timeout=1800).returncode


def score(relume, trace, reference, work, frames, log):
    """Render and score against a reference; return what diff --json printed, or None."""
    chosen = ["-f", frames] if frames else []
    if run(relume, "render", trace, "-o", work / "frames" / "x.####.exr", *chosen, log=log) != 0:
        return None
    done = subprocess.run([relume, "diff", reference, work / "frames", "--json", "-", "--report", work / "report", *chosen],
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    with open(log, "a") as out:
        out.write(done.stdout + done.stderr)
    try:
        return json.loads(done.stdout)
    except ValueError:
        return None


def missed_gates(frame, gates):
    """The gates that a frame does not pass, each with what became of it: "R3 failed", "R4 not measured".

    R1 and R1b share the interior pixels, plain and blended: a frame may have one kind only, but not neither.
    """
    state = {g: frame["gates"][g]["state"] for g in gates}
    if "passed" in (state["R1"], state["R1b"]):
        state = {g: s for g, s in state.items() if g not in ("R1", "R1b") or s != "not measured"}
    return [f"{g} {s}" for g, s in state.items() if s != "passed"]


def summarize(what, scored, n_wanted, gates, demanded, peer):
    if scored is None:
        return {"what": what, "figure": "not scored, see the log", "bar": f"{n_wanted} pass" if demanded else None,
                "peer": peer, "passed": False if demanded else None}
    good, missed = 0, {}
    for frame in scored["frames"]:
        bad = missed_gates(frame, gates)
        good += not bad
        for gate in bad:
            missed[gate] = missed.get(gate, 0) + 1
    figure = f"{good} of {len(scored['frames'])} pass"
    if scored["frames"]:
        figure += f", fidelity {100 * min(f['fidelity'] for f in scored['frames']):.3f} % at least"
    if missed:
        figure += "; " + ", ".join(f"{gate} on {n}" for gate, n in sorted(missed.items()))
    return {"what": what, "figure": figure, "bar": f"{n_wanted} pass" if demanded else None, "peer": peer,
            "passed": good == n_wanted == len(scored["frames"]) if demanded else None}


def show_live(build, work, name, program):
    log = work / "log"
    command = [build / "corpus" / program[0], *program[1:]] if (build / "corpus" / program[0]).exists() else program
    trace = work / "live.trace"
    run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", trace, "--ref", "color,depth", "--quit-after",
        N_FRAMES, "--", *command, log=log)
    return summarize(name, score(build / "relume", trace, trace, work, None, log), N_FRAMES, LIVE_GATES,
                     True,
                     "Mesa llvmpipe, in the program")


def show_trace(build, work, trace, last_frame):
    log = work / "log"
    first_frame = max(1, last_frame - N_FRAMES + 1)
    frames = f"{first_frame}-{first_frame + N_FRAMES - 1}"
    run(ROOT / "tests/xvfb.sh", build / "relume", "raster", trace, "-f", frames, "-o", work / "raster" / "x.####.png",
        log=log)
    demanded = trace.stem in DEMANDED
    return summarize(f"{trace.stem}, frames {frames}", score(build / "relume", trace, work / "raster", work, frames, log), N_FRAMES,
                     RASTER_GATES, demanded, "Mesa llvmpipe, by glretrace")


def main(build, *parts):
    build = pathlib.Path(build).resolve()
    base = build / "show" / "parity"
    shutil.rmtree(base, ignore_errors=True)
    rows = []

    def show(name, function, *args):
        if parts and not any(part in name for part in parts):
            return
        work = base / re.sub(r"\W+", "_", name)
        work.mkdir(parents=True)
        begin = time.monotonic()
        rows.append(function(build, work, *args))
        row = rows[-1]
        mark = {True: "holds", False: "FAILS", None: "-    "}[row["passed"]]
        print(f"{mark}  {row['what']}: {row['figure']} ({time.monotonic() - begin:.0f} s)", flush=True)

    for name, program in LIVE.items():
        show(f"{name}, live", show_live, f"{name}, live", program)
    if (TRACES / "frames.tsv").exists():
        for line in (TRACES / "frames.tsv").read_text().splitlines():
            if not line.startswith("#"):
                name, last_frame = line.split("\t")[:2]
                show(name, show_trace, TRACES / f"{name}.trace", int(last_frame))
    result = {"name": "parity", "command": "make show-parity", "rows": rows}
    (build / "show" / "parity.json").write_text(json.dumps(result, indent=1) + "\n")
    print(f"details: {base}")
    return 1 if any(row["passed"] is False for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
