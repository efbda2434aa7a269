#!/usr/bin/python3
"""tests/show/parity.py BUILD [--only PART]... [--record] (as `make show-parity`): does `gl` equal OpenGL's raster
picture?

- The open list of real programs and the scenes of corpus/, recorded live with reference frames read back in the
  program: ten frames each, all gates. Also whether `apitrace dump` reads each trace to its end, and whether glretrace
  draws its last frame exactly as the program did.
- Three of these programs are also recorded by `apitrace trace`: the same number of frames must pass as in our own
  recording, both against references made by glretrace.
- The recordings of ../shared/traces if present, with references made by glretrace (never its first frame, which is
  known to be wrong): three must pass R1 to R4, the others are for information. Live recordings stay in
  BUILD/show/parity and are reused until --record asks for new ones.
"""
import argparse
import dataclasses
import json
import os
import pathlib
import re
import sys
import time

import programs
import recording
import scoring
from display import need_display

TRACES = recording.ROOT.parent / "shared" / "traces"
RASTER_GATES = ("R1", "R1b", "R2", "R3", "R4")
RASTER_MUST = ("R2", "R3", "R4")
LIVE_MUST = ("V", "R2", "R3", "R4", "R5", "E1", "E2", "P")
DEMANDED_TRACES = {"glxgears", "iv-SceneViewer", "xss-lament"}
BY_APITRACE = ("glxgears", "queens", "lattice")


def corpus(build):
    """The first scenes of corpus/, as programs."""
    for name, command in (("two_triangles", ("two_triangles", "--animate",
                                             "camera")), ("cornell", ("cornell", "--animate", "camera")),
                          ("cornell, moving light", ("cornell", "--animate", "light", "--vbo"))):
        yield programs.Program(name, "", (str(build / "corpus" / command[0]), *command[1:]))


def folder_of(base, name):
    return base / re.sub(r"\W+", "_", name)


def scorer_in(build, folder, name):
    work = folder / name
    work.mkdir(parents=True, exist_ok=True)
    (work / "log").write_text("")
    return scoring.Scorer(build / "relume", work, work / "log")


def row(what, line, demanded, peer):
    figure = f"{line.passed} of {line.frames} frames pass, fidelity {line.fidelity:.3f} %"
    for key, before in (("missed", ""), ("blame", "most in "), ("unhandled", "unhandled: "), ("note", "")):
        if getattr(line, key):
            figure += f"; {before}{getattr(line, key)}"
    if line.dump and line.dump != "whole":
        figure += f"; apitrace dump: {line.dump}"
    if line.replay:
        figure += f"; glretrace: {line.replay}"
    return {"what": what, "figure": figure, "bar": "all frames pass" if demanded else None, "peer": peer,
            "passed": line.good if demanded else None, "line": dataclasses.asdict(line)}


def show_live(build, folder, program, record_again):
    line = scoring.Line(program.name)
    done = recording.record(build / "relume", program, folder, record_again)
    if done.trace is None:
        line.note = f"no recording (exit code {done.code}): {done.said[:120]}"
    else:
        must = LIVE_MUST if done.depth else tuple(g for g in LIVE_MUST if g not in ("R4", "R5"))
        scoring.score_recording(scorer_in(build, folder, "scored"), line, done, scoring.N_FRAMES, "whitted",
                                scoring.GATES, must, report=True)
    return row(f"{program.name}, live", line, True, "Mesa llvmpipe, in the program")


def score_by_glretrace(build, folder, name, trace, frames):
    """Render frames of a trace and score them against glretrace's pictures."""
    scorer, line = scorer_in(build, folder, name), scoring.Line(name)
    info = scorer.info(trace)
    frames = [f for f in frames if info and f < info["frames"]]
    if not frames:
        line.note = "the trace has not enough frames"
        return line
    line.unhandled = scoring.list_unhandled(info)
    chosen = ",".join(map(str, frames))
    scorer.run(scorer.relume, "raster", trace, "-f", chosen, "-o", scorer.work / "raster" / "x.####.png")
    rendered, line.frame_s, line.note = scorer.render(trace, frames, "whitted")
    scored = scorer.json(scorer.relume, "diff", scorer.work / "raster", scorer.work / "frames", "-f",
                         ",".join(map(str, rendered)) or chosen, "--json", "-", "--report", scorer.work / "report")
    return scoring.summarize(line, scored, RASTER_GATES, RASTER_MUST) if scored else line


def show_trace(build, folder, trace, last_frame):
    first = max(1, last_frame - scoring.N_FRAMES + 1)
    line = score_by_glretrace(build, folder, "scored", trace, range(first, first + scoring.N_FRAMES))
    return row(f"{trace.stem} of the shared traces, frames {first}-{first + scoring.N_FRAMES - 1}", line, trace.stem
               in DEMANDED_TRACES, "Mesa llvmpipe, by glretrace")


def show_by_apitrace(build, folder, program):
    """The traces of one program by both recorders, scored alike."""
    ours = recording.record(build / "relume", program, folder)
    theirs = recording.record_by_apitrace(program, folder)
    result = {
        "what": f"{program.name}: our trace and that of apitrace trace score the same", "bar": "the same number, all",
        "peer": "apitrace trace"
    }
    if ours.trace is None or theirs is None:
        return {**result, "figure": "not recorded, see the logs", "passed": False}
    frames = range(9, 9 + 4 * scoring.N_FRAMES, 4)
    lines = [
        score_by_glretrace(build, folder, name, trace, frames)
        for name, trace in (("ours", ours.trace), ("theirs", theirs))
    ]
    figure = " / ".join(
        f"{line.passed} of {line.frames}, fidelity {line.fidelity:.3f} %{', ' + line.missed if line.missed else ''}"
        f"{', ' + line.note if line.note else ''}" for line in lines)
    return {**result, "figure": f"ours / theirs: {figure}",
            "passed": lines[0].good and lines[1].good and lines[0].passed == lines[1].passed}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", action="append", default=[], help="part of a line's name")
    parser.add_argument("--record", action="store_true", help="record again")
    options = parser.parse_args()
    need_display()
    os.nice(15)
    build = options.build.resolve()
    base = build / "show" / "parity"
    rows = []

    def show(name, function, *args):
        if options.only and not any(part in name for part in options.only):
            return
        begin = time.monotonic()
        rows.append(function(build, folder_of(base, name), *args))
        mark = {True: "holds", False: "FAILS", None: "-    "}[rows[-1]["passed"]]
        print(f"{mark}  {rows[-1]['what']}: {rows[-1]['figure']} ({time.monotonic() - begin:.0f} s)", flush=True)

    for program in (*programs.OPEN, *corpus(build)):
        show(program.name, show_live, program, options.record)
    for program in programs.OPEN:
        if program.name in BY_APITRACE:
            show(f"{program.name} by apitrace", show_by_apitrace, program)
    if (TRACES / "frames.tsv").exists():
        for line in (TRACES / "frames.tsv").read_text().splitlines():
            if not line.startswith("#"):
                name, last_frame = line.split("\t")[:2]
                show(f"shared {name}", show_trace, TRACES / f"{name}.trace", int(last_frame))
    if not options.only:
        (build / "show" / "parity.json"
         ).write_text(json.dumps({"name": "parity", "command": "make show-parity", "rows": rows}, indent=1) + "\n")
    print(f"details: {base}")
    return 1 if any(row["passed"] is False for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
