#!/usr/bin/python3
"""tests/show/same.py BUILD [--only NAME...] (as `make show-same`): does the same scene, told otherwise, give the same picture?

All relations of tests/same/relations.c over a frame of each recording: those of tests/golden, programs of corpus/ and of
tests/real/panels recorded here, and, where they are, the recordings of ../shared/traces and the programs of ../shared/faults that are
right as they are. A pair that differs is named with the draw that differs first; one to which a relation does not apply has a reason.
NAME is part of a recording's or of a relation's name. Needs a display.
"""
import collections
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/same"))
from pairs import Told, run  # noqa: E402
from table import Shown  # noqa: E402

SMALL = ("--frames", "3", "--size", "400x300")
PROGRAMS = {  # name: the program below BUILD and its options, the frame to look at
    "arena": ("corpus/arena", *SMALL), "blocks": ("corpus/blocks", *SMALL), "board, quad": ("corpus/board_fbo", *SMALL, "--by", "quad"),
    "board, blit": ("corpus/board_fbo", *SMALL, "--by", "blit"), "closed hall": ("corpus/closed_hall", *SMALL), "courtyard": ("corpus/courtyard", *SMALL),
    "courtyard, lit": ("corpus/courtyard", "lit", *SMALL), "facets": ("corpus/facets", *SMALL), "hall": ("corpus/hall", *SMALL),
    "cube": ("corpus/model_on_cube", *SMALL), "phong": ("corpus/phong", *SMALL), "phong, glsl": ("corpus/phong", *SMALL, "--by", "glsl"),
    "phong, vertex": ("corpus/phong", *SMALL, "--by", "vertex"), "spheres": ("corpus/spheres", *SMALL), "still life": ("corpus/still_life", *SMALL),
    "street": ("corpus/street", *SMALL), "street, unlit": ("corpus/street", *SMALL, "--by", "unlit"), "trees": ("corpus/tree_cards", *SMALL),
    "planar": ("corpus/tricks", "planar", *SMALL), "zfail": ("corpus/tricks", "zfail", *SMALL), "mirror": ("corpus/tricks", "mirror", *SMALL),
    "viewer": ("corpus/viewer", *SMALL), "viewer, parallel": ("corpus/viewer", *SMALL, "--ortho"), "marbles": ("corpus/glx/marbles", "--frames", "3"),
    "rooms": ("corpus/rooms", "--frames", "3"), "fixed": ("corpus/es/fixed", "--frames", "3"), "shapes": ("corpus/es/shapes", "--frames", "3"),
    "light panel": ("tests/real/panels/light",), "fog panel": ("tests/real/panels/fog",), "texture panel": ("tests/real/panels/texture",),
}
FRAME = 1
FAULTS = {"passes1": 1, "bulb3": 0, "sky3dn": 0, "grow": 0}  # programs of ../shared/faults: a frame that is as it should be


def record(build, path, command):
    done = run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", path, "--", *command)
    return path if path.exists() and not done.returncode else print(f"not recorded: {path.stem}: {done.stderr.strip()[-200:]}")


def recordings(build, work):
    """(name, trace, frame) of all that are there."""
    for trace in sorted((ROOT / "tests/golden").glob("*.trace")):
        yield trace.stem, trace, 1
    for name, (program, *options) in PROGRAMS.items():
        yield name, lambda name=name, c=(build / program, *options): record(build, work / f"{name}.trace", c), FRAME
    frames = ROOT.parent / "shared/traces/frames.tsv"
    for name, frame in (line.split("\t")[:2] for line in frames.read_text().splitlines()[1:]) if frames.exists() else ():
        yield name, frames.parent / f"{name}.trace", int(frame)
    for name, frame in FAULTS.items():
        source, program = ROOT.parent / f"shared/faults/{name}.c", work / name
        if source.exists() and not run("gcc", "-w", source, "-o", program, "-lGL", "-lGLU", "-lX11", "-lm").returncode:
            yield name, lambda name=name, c=(program,): record(build, work / f"{name}.trace", c), frame


def main(build, only):
    shown = Shown(build, "same")
    counts, differ, reasons = collections.Counter(), [], collections.Counter()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        work = pathlib.Path(folder)

        def look(name, trace, frame):
            trace = trace() if callable(trace) else trace
            if not trace:
                return []
            told = Told(build, trace, frame, work / f"{name}.told")
            wanted = [r for r, (base, _, _) in told.relations.items() if base and (not only or any(o in name or o in r for o in only))]
            found = [(name, relation, told.pair(relation)) for relation in wanted]
            shutil.rmtree(told.folder)
            return found

        for done in concurrent.futures.as_completed([pool.submit(look, *r) for r in recordings(build, work)]):
            found = done.result()
            counts["recordings"] += bool(found)
            for name, relation, verdict in found:
                counts[verdict.same] += 1
                if verdict.same is False:
                    differ.append((verdict.share, f"{name}, {relation}: {verdict}"))
                    print("DIFFERS", differ[-1][1], flush=True)
                elif verdict.same is None:
                    reasons[f"{relation}: {verdict}"] += 1
    for reason, n in sorted(reasons.items()):
        print(f"does not apply to {n}: {reason}")
    differ.sort(reverse=True)
    n = counts[True] + counts[False]
    shown.row(f"pairs of pictures of the same scene, told otherwise, of {counts['recordings']} recordings, that differ", f"{len(differ)} of {n}", 0,
              n > 0 and not differ, f"worst: {differ[0][1]}" if differ else None)
    shown.row("pairs to which a relation does not apply, each with its reason", counts[None], None, None)
    return shown.finish()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), [part for part in sys.argv[2:] if part != "--only"]))
