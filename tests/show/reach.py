#!/usr/bin/python3
"""tests/show/reach.py BUILD (as `make show-reach`): programs that are not of OpenGL, X and 64 bits: three of each kind.

Each is recorded for ten frames with reference frames, rendered in mode gl and scored by all gates. Then recording's cost: processor time of the
program and its threads, start included, recorded without reference frames over bare, in turn, the median of the ratios. Programs of 32 bits need
`make i386` first: where that has not been run, their lines say so, and fail.
"""
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/real"))
import wine  # noqa: E402
from display import need_display  # noqa: E402
from scoring import Line, Scorer, summarize  # noqa: E402
from table import Shown  # noqa: E402

FRAMES, MORE_FRAMES, ROUNDS = 10, 300, 5
GATES = ("V", "R1", "R2", "R3", "R4", "R5", "P")


def kinds(build):
    """(kind, name, command that --frames N may follow, gates that can be measured)"""
    for name, options in wine.PROGRAMS.items():
        yield "Wine", name, ["wine", build / f"windows/{name}.exe", *options], GATES
    for name in ("shapes", "fixed", "sprites"):
        yield "OpenGL ES 1", name, [build / f"corpus/es/{name}"], tuple(g for g in GATES if g != "R5")
    for name, options in wine.PROGRAMS.items():
        yield "32 bits", name, [build / f"i386/{name}", *options], GATES


def spent_s(command):
    """Processor time of a command that succeeds, and of its children."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def score(relume, work, command, gates):
    """Frames that pass, and which gates do not."""
    trace = work / "ten.trace"
    scorer = Scorer(relume, work, work / "log")
    if scorer.run(relume, "record", "-o", trace, "--ref", "color,depth", "--", *command, "--frames", FRAMES)[0]:
        return Line("")
    rendered, _, _ = scorer.render(trace, list(range(FRAMES)), "gl")
    return summarize(Line(""), scorer.diff(trace.with_suffix(".ref"), rendered, False), gates)


def cost(relume, work, command):
    command = [*command, "--frames", str(MORE_FRAMES)]
    recorded = [relume, "record", "-o", work / "more.trace", "--", *command]
    pairs = [(spent_s(recorded), spent_s(command)) for _ in range(ROUNDS)]
    return statistics.median(ours / bare for ours, bare in pairs), statistics.median(bare for _, bare in pairs)


def show(shown, build, kind, name, command, gates):
    if not pathlib.Path(command[1] if command[0] == "wine" else command[0]).exists():
        shown.row(f"{kind}: {name}", "not built: 'make i386' has not been run here, or cannot", f"{FRAMES} of {FRAMES} frames", False)
        return
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        line = score(build / "relume", work, command, gates)
        shown.row(f"{kind}: {name}", f"{line.passed} of {FRAMES} frames pass {', '.join(gates)}" + (f" ({line.missed})" if line.missed else ""),
                  f"{FRAMES} of {FRAMES} frames", line.passed == FRAMES)
        ratio, bare = cost(build / "relume", work, command)
        shown.row(f"{kind}: {name}: recorded over bare", f"{ratio:.2f} times the processor time ({bare:.2f} s for {MORE_FRAMES} frames)", None, None)


def main(build):
    need_display()
    build = pathlib.Path(build).resolve()
    shown = Shown(build, "reach")
    with tempfile.TemporaryDirectory() as prefix:
        os.environ.update(wine.environment(prefix))
        if shutil.which("wineboot"):
            subprocess.run(["wineboot", "-i"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        for kind, name, command, gates in kinds(build):
            show(shown, build, kind, name, command, gates)
        subprocess.run(["wineserver", "-k"], check=False)
    return shown.finish()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
