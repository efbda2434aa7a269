#!/usr/bin/python3
"""tests/show/sweep.py BUILD [--only PART]... [--frames N] [--minutes M] [--again] [--record] (as `make show-sweep`):
the sweep, one line per program.

Each program is recorded once, with reference frames read back in the program; recordings stay in BUILD/show/sweep/NAME
and are reused until --record asks for new ones. Ten frames of each are rendered in `gl` mode and scored against the
program's own picture. BUILD/show/sweep.tsv holds a line for each program. Programs that the present relume has already
scored are skipped, so a run that was stopped or ran out of its minutes continues from there. Failures are listed again
at the end. The bar: 110 of xscreensaver's fixed-function hacks pass all gates on all frames.
"""
import argparse
import dataclasses
import hashlib
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

HACKS_BAR = 110
GATES = ("V", "R1", "R1b", "R2", "R3", "R4", "R5", "P")
COLUMNS = [field.name for field in dataclasses.fields(scoring.Line)] + ["good", "scored_by"]


def read_table(path):
    """The lines of an earlier run, by name."""
    if not path.exists():
        return {}
    rows = [line.split("\t") for line in path.read_text().splitlines()]
    return {row[0]: dict(zip(rows[0], row)) for row in rows[1:]}


def write_table(path, lines):
    text = ["\t".join(COLUMNS)]
    for line in lines.values():
        text.append("\t".join(re.sub(r"\s+", " ", str(line.get(column, ""))) for column in COLUMNS))
    path.with_suffix(".new").write_text("\n".join(text) + "\n")
    path.with_suffix(".new").replace(path)


def score(build, program, folder, n_frames, record_again):
    line = scoring.Line(program.name, program.group)
    done = recording.record(build / "relume", program, folder, record_again)
    if done.trace is None:
        line.note = f"no recording (exit code {done.code}): {done.said[:120]}"
        return line
    work = folder / "scored"
    work.mkdir(exist_ok=True)
    (work / "log").write_text("")
    return scoring.score_recording(scoring.Scorer(build / "relume", work, work / "log"), line, done, n_frames, "gl",
                                   GATES)


def tell(line):
    mark = "passes" if line["good"] == "True" else "FAILS "
    parts = [
        f"{mark} {line['name']}: {line['passed']} of {line['frames']} frames, fidelity {float(line['fidelity']):.3f} %"
    ]
    for key, before in (("missed", ""), ("unhandled", "unhandled: "), ("note", "")):
        if line[key]:
            parts.append(before + line[key])
    if line["replay"] not in ("same", ""):
        parts.append(f"glretrace: {line['replay']}")
    if line["dump"] not in ("whole", ""):
        parts.append(f"apitrace dump: {line['dump']}")
    return "; ".join(parts)


def count(lines, what, passes):
    return f"{sum(map(passes, lines))} of {len(lines)} {what}"


def rows_of(lines):
    """The figures for `make show`."""
    rows = []
    for group in programs.GROUPS:
        of_group = [line for line in lines if line["group"] == group]
        if not of_group:
            continue
        good = sum(line["good"] == "True" for line in of_group)
        bar = HACKS_BAR if group == programs.GROUPS[0] else None
        rows.append({
            "what": f"{group}: programs whose scored frames pass all gates", "figure": f"{good} of {len(of_group)}",
            "bar": str(bar) if bar else None, "peer": "Mesa llvmpipe, in the program",
            "passed": good >= bar if bar else None
        })
    rows.append({
        "what": "traces that apitrace dump reads to the end",
        "figure": count(lines, "", lambda x: x["dump"] == "whole"), "bar": None, "peer": "apitrace", "passed": None
    })
    rows.append({
        "what": "traces whose last frame glretrace draws as the program did",
        "figure": count(lines, "", lambda x: x["replay"] == "same"), "bar": None, "peer": "glretrace", "passed": None
    })
    return rows


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", action="append", default=[], help="part of a program's name")
    parser.add_argument("--frames", type=int, default=scoring.N_FRAMES)
    parser.add_argument("--minutes", type=float, default=120, help="start no new program after this time")
    parser.add_argument("--again", action="store_true", help="score again, even with the same relume")
    parser.add_argument("--record", action="store_true", help="record again")
    options = parser.parse_args()
    need_display()
    os.nice(15)
    build = options.build.resolve()
    base = build / "show" / "sweep"
    base.mkdir(parents=True, exist_ok=True)
    table = build / "show" / "sweep.tsv"
    this_relume = f"{hashlib.sha256((build / 'relume').read_bytes()).hexdigest()[:12]} {options.frames}"
    lines = read_table(table)
    chosen = [p for p in programs.sweep() if not options.only or any(part in p.name for part in options.only)]
    end = time.monotonic() + 60 * options.minutes
    for number, program in enumerate(chosen, 1):
        if time.monotonic() > end:
            break
        known = lines.get(program.name)
        if known and known["scored_by"] == this_relume and not (options.again or options.record):
            continue
        begin = time.monotonic()
        line = score(build, program, base / program.name, options.frames, options.record)
        lines[program.name] = {**{k: str(v) for k, v in dataclasses.asdict(line).items()}, "good": str(line.good),
                               "scored_by": this_relume}
        write_table(table, lines)
        print(f"{number}/{len(chosen)} {tell(lines[program.name])} ({time.monotonic() - begin:.0f} s)", flush=True)
    present = [lines[p.name] for p in chosen if p.name in lines and lines[p.name]["scored_by"] == this_relume]
    rows = rows_of(present)
    if not options.only:
        (build / "show" / "sweep.json"
         ).write_text(json.dumps({"name": "sweep", "command": "make show-sweep", "rows": rows}, indent=1) + "\n")
    for row in rows:
        print(f"{row['what']}: {row['figure']}" + (f" (bar {row['bar']})" if row["bar"] else ""))
    for line in present:
        if line["good"] != "True":
            print(tell(line) + (f"; {line['blame']}" if line["blame"] else ""))
    if len(present) < len(chosen):
        print(f"{len(chosen) - len(present)} programs were not reached: run it again to continue")
    print(f"a line each: {table}")
    return 1 if any(row["passed"] is False for row in rows) or len(present) < len(chosen) else 0


if __name__ == "__main__":
    sys.exit(main())
