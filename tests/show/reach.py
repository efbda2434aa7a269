#!/usr/bin/python3
"""tests/show/reach.py BUILD (as `make show-reach`): programs beyond OpenGL, X and 64 bits: three of each kind, and one
32-bit Windows program.

Each is recorded for ten frames with reference frames, rendered in mode gl and scored by all gates. Then the cost of
recording: processor time of the program and its threads, start included, recorded without reference frames over bare;
runs alternate, and the figure is the median of the ratios. 32-bit programs need `make i386 windows` first; without it
their lines say so, and fail. Finally, the cost of many blended fragments per pixel, compared with llvmpipe.
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
DEEP_BAR, DEEP_FRAMES = 10, 5
GATES = ("V", "R1", "R2", "R3", "R4", "R5", "P")


def kinds(build):
    """(kind, name, command that accepts --frames N, gates that can be measured)"""
    for name, options in wine.PROGRAMS.items():
        yield "Wine", name, ["wine", build / f"windows/{name}.exe", *options], GATES
    yield "Wine, 32 bits", "tricks", [wine.loader(build), build / "windows32/tricks.exe",
                                      *wine.PROGRAMS["tricks"]], GATES
    for name in ("shapes", "fixed", "sprites"):
        yield "OpenGL ES 1", name, [build / f"corpus/es/{name}"], tuple(g for g in GATES if g != "R5")
    for name, options in wine.PROGRAMS.items():
        yield "32 bits", name, [build / f"i386/{name}", *options], GATES


def spent_s(command):
    """Processor time of a command and its children; the command must succeed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def score(relume, work, command, gates):
    """Number of frames that pass, and the gates that fail."""
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
    if not pathlib.Path(command[1] if kind.startswith("Wine") else command[0]).exists():
        shown.row(f"{kind}: {name}", "not built: 'make i386 windows' has not been run here, or cannot",
                  f"{FRAMES} of {FRAMES} frames", False)
        return
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        line = score(build / "relume", work, command, gates)
        shown.row(
            f"{kind}: {name}",
            f"{line.passed} of {FRAMES} frames pass {', '.join(gates)}" + (f" ({line.missed})" if line.missed else ""),
            f"{FRAMES} of {FRAMES} frames", line.passed == FRAMES)
        ratio, bare = cost(build / "relume", work, command)
        shown.row(f"{kind}: {name}: recorded over bare",
                  f"{ratio:.2f} times the processor time ({bare:.2f} s for {MORE_FRAMES} frames)", None, None)


def show_deep(shown, build):
    """256 slices over 512 x 512 pixels, traced with the program's own blending: median of the ratios of processor time
    per frame, in alternating runs."""
    relume, program = build / "relume", build / "tests/real/deep"
    with tempfile.TemporaryDirectory() as folder:
        trace, out = pathlib.Path(folder, "deep.trace"), pathlib.Path(folder, "x.####.exr")
        subprocess.run([relume, "record", "-o", trace, "--", program,
                        str(DEEP_FRAMES)], check=True, stderr=subprocess.DEVNULL)

        def ours(last):
            return spent_s([relume, "render", trace, "--mode", "gl", "-f", f"0-{last}", "-o", out])

        ours(0)  # compiles the kernels
        ratios = []
        for _ in range(3):
            frame_s = (ours(DEEP_FRAMES - 1) - ours(0)) / (DEEP_FRAMES - 1)
            bare_s = (spent_s([program, str(4 * DEEP_FRAMES)]) - spent_s([program, str(DEEP_FRAMES)])) / (3 *
                                                                                                          DEEP_FRAMES)
            ratios.append((frame_s / bare_s, frame_s, bare_s))
        ratio, frame_s, bare_s = sorted(ratios)[1]
        shown.row("256 blended slices of a volume, 512 x 512",
                  f"{ratio:.1f} times llvmpipe's processor time ({frame_s:.2f} s and {bare_s:.2f} s per frame)",
                  f"at most {DEEP_BAR} times", ratio <= DEEP_BAR)


def main(build):
    need_display()
    build = pathlib.Path(build).resolve()
    shown = Shown(build, "reach")
    with tempfile.TemporaryDirectory() as prefix:
        os.environ.update(wine.environment(build, prefix))
        if shutil.which("wineboot"):
            subprocess.run([wine.loader(build), "wineboot", "-i"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                           check=True)
        for kind, name, command, gates in kinds(build):
            show(shown, build, kind, name, command, gates)
        show_deep(shown, build)
        subprocess.run(["wineserver", "-k"], check=False)
    return shown.finish()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
