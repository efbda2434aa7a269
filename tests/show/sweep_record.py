#!/usr/bin/python3
"""tests/show/sweep_record.py BUILD [--only PART]... (as `make show-sweep-record`): the recorder alone, on every program
of the sweep.

Each program is recorded again with reference frames read back in the program. `apitrace dump` must read the trace to
its end, and glretrace must draw the last frame exactly as the program did. glretrace gets a visual like the program's
(verbs/recording/visual.c); if its window is larger (because a viewport reached beyond the program's), only the
program's part is compared. Programs that do not start here are listed and not counted.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import programs
import recording
import scoring
from display import need_display

sys.path.insert(0, str(recording.ROOT / "tests" / "real"))
from replayed import reference_frames, with_visual  # noqa: E402

PICTURE = re.compile(rb"P6\n(?:#[^\n]*\n)*(\d+) (\d+)\n255\n")


def look_up(trace):
    """The calls that end frames, and the format of a pixel."""
    dump = subprocess.run(
        ["apitrace", "dump", "--color=never", "--grep=SwapBuffers|FrameTerminator|StringMarker", trace],
        capture_output=True, text=True, errors="replace", check=False).stdout
    bits = re.findall(r"relume:bits ([\d ]+)",
                      dump)  # from the last context: some programs first create one only for queries
    calls = re.findall(r"^(\d+) (?:\w+SwapBuffers\w*|glFrameTerminator\w*)\(", dump, re.M)
    return calls, bits[-1] if bits else ""


def check_replay(trace, build):
    """Does glretrace's picture of the last frame with a reference equal the program's own?"""
    calls, bits = look_up(trace)
    shown = {n: picture for n, picture in reference_frames(trace.with_suffix(".ref")).items() if n < len(calls)}
    if not shown:
        return "no frame to compare"
    last = max(shown)
    run = subprocess.run(["glretrace", "--headless", "-S", calls[last], "-s", "-", trace], env=with_visual(bits, build),
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=scoring.LIMIT_S, check=False)
    head = PICTURE.search(run.stdout)
    if not head:
        return f"glretrace gives no picture (exit code {run.returncode})"
    (wide, high), (width, height, want) = map(int, head.groups()), shown[last]
    if wide < width or high < height:
        return f"glretrace's picture is {wide} x {high}, the program's {width} x {height}"
    got = b"".join(run.stdout[head.end() + (y * wide) * 3:head.end() + (y * wide + width) * 3]
                   for y in range(high - height, high))
    differ = sum(got[i:i + 3] != want[i:i + 3] for i in range(0, len(want), 3))
    return f"differs in {differ} of {width * height} pixels of frame {last}" if differ else "same"


def check(build, program, folder):
    """(apitrace dump's verdict, that on glretrace's picture), or (None, the reason for having no recording)."""
    done = recording.record(build / "relume", program, folder, True)
    if done.trace is None or not done.references:
        return None, f"no recording (exit code {done.code}): {done.said[:120]}"
    scorer = scoring.Scorer(build / "relume", folder, folder / "log")
    return scorer.check_dump(done.trace), check_replay(done.trace, build)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", action="append", default=[], help="part of a program's name")
    parser.add_argument("--keep", type=pathlib.Path, help="keep the recordings in this folder")
    options = parser.parse_args()
    need_display()
    os.nice(10)
    build = options.build.resolve()
    lines = []
    with tempfile.TemporaryDirectory() as scratch:
        base = (options.keep or pathlib.Path(scratch)).resolve()
        for program in programs.sweep():
            if options.only and not any(part in program.name for part in options.only):
                continue
            dump, replay = check(build, program, base / program.name)
            lines.append({"name": program.name, "dump": dump, "replay": replay})
            good = (dump, replay) == ("whole", "same")
            print(f"{'holds' if good else 'no   ' if dump is None else 'FAILS'} {program.name}: {dump or ''} {replay}",
                  flush=True)
            if not options.keep:
                shutil.rmtree(base / program.name, ignore_errors=True)
    recorded = [line for line in lines if line["dump"] is not None]
    rows = []
    for what, key, value, peer in (("traces that apitrace dump reads to the end", "dump", "whole", "apitrace"),
                                   ("traces whose last frame glretrace draws as the program did", "replay", "same",
                                    "glretrace")):
        good = sum(line[key] == value for line in recorded)
        rows.append({
            "what": what, "figure": f"{good} of {len(recorded)}", "bar": "all", "peer": peer,
            "passed": good == len(recorded)
        })
        print(f"{what}: {good} of {len(recorded)} (bar: all)")
    if not options.only:
        (build / "show").mkdir(exist_ok=True)
        (build / "show/sweep_record.json").write_text(
            json.dumps({"name": "sweep_record", "command": "make show-sweep-record", "rows": rows, "programs": lines},
                       indent=1) + "\n")
    return 0 if recorded and all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
