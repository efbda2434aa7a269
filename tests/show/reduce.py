#!/usr/bin/python3
"""tests/show/reduce.py BUILD [--only NAME] (as `make show-reduce`): faults planted in real recordings, isolated by
`relume reduce`.

A fault is one argument of one call in the second half of the recording, changed to a number that OpenGL does not accept
there. The failing command is `relume info`, which reports an error of that call. For comparison: the number of calls
that `apitrace trim` keeps for the frame with the fault.

Then faults in pictures (tests/show/faults.py), each a changed call of corpus/still_life: its frame is compared with the
reference frames of the unchanged program (`--frame`), and the reduced recording must contain the change.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/show"))
import faults  # noqa: E402
from edit_trace import Trace  # noqa: E402
from table import Shown  # noqa: E402

SHARED = ROOT.parent / "shared/traces"
FAULTS = [("glxgears", "glShadeModel", 0), ("xss-queens", "glEnable", 0), ("xss-lament", "glEnable", 0),
          ("iv-SceneViewer", "glEnable", 0), ("rss-lattice", "glEnable", 0), ("billard-gl", "glEnable", 0),
          ("neverball", "glMatrixMode", 0), ("xss-noof", "glBegin", 0), ("billard-gl", "glBlendFunc", 1),
          ("neverball", "glTexEnvi", 1)]
PICTURES = {
    "wrong material": "glMaterialfv", "a light of another colour": "glLightfv", "an object is turned": "glRotatef"
}
WRONG, AT, MOST = 0x1234, 0.6, 50
SAID = re.compile(r": (\d+) of (\d+) calls, .*; (\d+) trials? in (\d+) s")


def run(*args, codes=(0,)):
    done = subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode not in codes:
        sys.exit(f"{' '.join(map(str, args))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def plant(source, call, argument, path):
    """Change one call of a recording; returns the number of its frame."""
    trace = Trace(source)
    found = [
        i for i, (name, args) in enumerate(trace.calls)
        if name == call and len(args) > argument and args[argument].kind == "number"
    ]
    at = found[int(AT * len(found))]
    trace.change(trace.calls[at][1][argument], WRONG)
    trace.save(path)
    return sum(name in ("glXSwapBuffers", "eglSwapBuffers") for name, _ in trace.calls[:at])


def reduce_picture(shown, relume, build, name):
    frame, edit = faults.FRAME, next(what for fault, _, _, what in faults.FAULTS if fault == name)
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        run(ROOT / "tests/xvfb.sh", relume, "record", "-o", work / "good.trace", "--ref", "color,depth", "--",
            build.resolve() / "corpus/still_life", "--frames", 2, "--size", "96x64")
        trace = Trace(work / "good.trace")
        edit(trace)
        trace.save(work / "fault.trace")
        done = run(relume, "reduce", work / "fault.trace", "--frame", frame, "--ref", work / "good.ref", "-o",
                   work / "small.trace")
        left, whole, trials, seconds = map(int, SAID.search(done).groups())
        good, kept = (run(relume, "dump", work / file).splitlines() for file in ("good.trace", "small.trace"))
        new = [
            line.split(" ", 1)[1]
            for line in kept
            if line.split(" ", 1)[1] not in {other.split(" ", 1)[1] for other in good}
        ]
        has_it = any(line.startswith(PICTURES[name]) for line in new)
        shown.row(f"{name}: {PICTURES[name]} of {whole} calls", f"{left} calls, {trials} trials, {seconds} s",
                  f"at most {MOST}, with the change", left <= MOST and has_it)


def main(build, only):
    shown, relume = Shown(build, "reduce"), (build / "relume").resolve()
    for name in PICTURES:
        if not only or only in name:
            reduce_picture(shown, relume, build, name)
    for name, call, argument in FAULTS:
        if only and only not in name:
            continue
        with tempfile.TemporaryDirectory() as folder:
            work = pathlib.Path(folder)
            frame = plant(SHARED / f"{name}.trace", call, argument, work / "fault.trace")
            when = (f"'{relume}' info --json \"$TRACE\" >info.json || exit 9; "
                    f"! sed -n '/\"gl_errors\"/,/]/p' info.json | grep -q '\"call\": \"{call}\"'")
            said = SAID.search(run(relume, "reduce", work / "fault.trace", "-o", work / "small.trace", "--when", when))
            left, whole, trials, seconds = map(int, said.groups())
            again = subprocess.run(["sh", "-c", when], cwd=work,
                                   env={"TRACE": str(work / "small.trace"), "PATH": "/usr/bin:/bin"}, check=False)
            run("apitrace", "trim", f"--frames={frame}", "-o", work / "trim.trace", work / "fault.trace")
            trimmed = json.loads(run(relume, "info", "--json", work / "trim.trace", codes=(0, 3))
                                 or '{"calls": 0}')["calls"]
            shown.row(f"{name}: {call} of {whole} calls", f"{left} calls, {trials} trials, {seconds} s",
                      f"at most {MOST}, still failing", left <= MOST and again.returncode == 1,
                      f"apitrace trim of frame {frame}: {trimmed} calls")
    return shown.finish()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only")
    options = parser.parse_args()
    sys.exit(main(options.build, options.only))
