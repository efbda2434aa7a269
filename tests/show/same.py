#!/usr/bin/python3
"""tests/show/same.py BUILD [--only NAME...] (as `make show-same`): is the picture of a scene independent of the calls
that draw it?

Applies all relations of tests/same/relations.c to a frame of each recording: those of tests/golden, programs of corpus/
and tests/real/panels recorded here, and, if present, recordings of ../shared/traces and programs of ../shared/faults. A
pair that differs is reported with the first differing draw; a pair that a relation does not apply to is listed with the
reason. NAME is part of a recording's or relation's name.
"""
import collections
import concurrent.futures
import os
import pathlib
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/same"))
from pairs import Variants, run  # noqa: E402
from table import Shown  # noqa: E402

# Programs below BUILD with their options. Frame 1 of each is used.
SMALL = [f"corpus/{line} --frames 3 --size 400x300" for line in (
    "arena", "blocks", "board_fbo --by quad", "board_fbo --by blit", "closed_hall", "courtyard", "courtyard lit",
    "facets", "hall", "model_on_cube", "phong", "phong --by glsl", "phong --by vertex", "spheres", "still_life",
    "street", "street --by unlit", "tree_cards", "tricks planar", "tricks zfail", "tricks mirror", "viewer",
    "viewer --ortho")]
PROGRAMS = SMALL + [f"corpus/{name} --frames 3" for name in ("glx/marbles", "rooms", "es/fixed", "es/shapes")] + [
    f"tests/real/panels/{name}" for name in ("light", "fog", "texture")]
FAULTS = {"passes1": 1, "bulb3": 0, "sky3dn": 0, "grow": 0}  # from ../shared/faults: a frame without the fault


def record(build, path, *command):
    """Make a recording when it is first needed."""
    def make():
        done = run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", path, "--", *command)
        if path.exists() and not done.returncode:
            return path
        print(f"not recorded: {path.stem}: {done.stderr[-200:]}")
    return make


def recordings(build, work):
    """(name, trace or how to make it, frame) of all available recordings."""
    for trace in sorted((ROOT / "tests/golden").glob("*.trace")):
        yield trace.stem, trace, 1
    for line in PROGRAMS:
        program, *options = line.split()
        name = line.partition("/")[2].partition(" --frames")[0].replace("real/panels/", "panel ").replace("/", " ")
        yield name, record(build, work / f"{name}.trace", build / program, *options), 1
    frames = ROOT.parent / "shared/traces/frames.tsv"
    for line in frames.read_text().splitlines()[1:] if frames.exists() else ():
        name, frame = line.split("\t")[:2]
        yield name, frames.parent / f"{name}.trace", int(frame)
    for name, frame in FAULTS.items():
        source, program = ROOT.parent / f"shared/faults/{name}.c", work / name
        if source.exists() and not run("gcc", "-w", source, "-o", program, "-lGL", "-lGLU", "-lX11", "-lm").returncode:
            yield name, record(build, work / f"{name}.trace", program), frame


def look(build, work, only, name, trace, frame):
    """[(relation, verdict)] for a recording."""
    trace = trace() if callable(trace) else trace
    if not trace:
        return []
    variants = Variants(build, trace, frame, work / f"{name}.variants")
    wanted = [relation for relation, (base, _, _) in variants.relations.items()
              if base and (not only or any(part in name or part in relation for part in only))]
    found = [(relation, variants.pair(relation)) for relation in wanted]
    shutil.rmtree(variants.folder)
    return found


def main(build, only):
    shown = Shown(build, "same")
    counts, differ, reasons = collections.Counter(), [], collections.Counter()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        work = pathlib.Path(folder)
        looks = {pool.submit(look, build, work, only, *r): r[0] for r in recordings(build, work)}
        for done in concurrent.futures.as_completed(looks):
            counts["recordings"] += bool(done.result())
            for relation, verdict in done.result():
                counts[verdict.same] += 1
                if verdict.same is False:
                    differ.append((verdict.share, f"{looks[done]}, {relation}: {verdict}"))
                    print("DIFFERS", differ[-1][1], flush=True)
                elif verdict.same is None:
                    reasons[f"{relation}: {verdict}"] += 1
    for reason, n in sorted(reasons.items()):
        print(f"does not apply to {n}: {reason}")
    n = counts[True] + counts[False]
    shown.row(f"pairs of pictures of one scene, drawn in two ways, of {counts['recordings']} recordings, that differ",
              f"{len(differ)} of {n}", 0, n > 0 and not differ, f"worst: {max(differ)[1]}" if differ else None)
    shown.row("pairs that a relation does not apply to, each with the reason", counts[None], None, None)
    return shown.finish()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), [part for part in sys.argv[2:] if part != "--only"]))
