#!/usr/bin/python3
"""tests/show/lot.py BUILD [--seed N] [--programs N] (as `make show-lot`): traced pictures of randomly drawn programs,
for inspection.

Some of the sweep's installed programs are drawn at random, so that nobody chooses them. A late frame of each is
rendered with default settings and with `--look auto`; BUILD/show/lot/NAME.png shows raster, default and auto side by
side. Someone inspects each sheet and enters the result in tests/show/lot.yaml under the seed: whether default and auto
are better than the raster frame, equal or worse, and whether the scene is lit or has shadows. Without a seed a new one
is drawn, and its pictures have to be inspected.

The bars: no default picture worse, no auto picture worse, and one of the two better for a third of the scenes that are
lit.
"""
import argparse
import pathlib
import random
import secrets
import sys

import yaml

import programs
import recording
import sheet
from display import need_display
from table import Shown

SEEN = recording.ROOT / "tests/show/lot.yaml"
ENOUGH = 40
LEAST_BETTER = 1 / 3


def picture(build, program, folder):
    """Make a program's sheet; returns its path. Raises RuntimeError if there is none."""
    done = recording.record(build / "relume", program, folder)
    if done.trace is None or not done.references:
        raise RuntimeError(f"no recording: {done.said[:120]}")
    images = [sheet.render(build, done.trace, sheet.late(done), folder / f"{name}.exr", *options)
              for name, options in (("default", ()), ("auto", ("--look", "auto")))]
    if not any(images[0].planes[f"gl.{c}"].any() for c in "RGB"):
        raise RuntimeError("the frame is black")
    out = folder.parent / f"{program.name}.png"
    sheet.side_by_side(out, *images)
    return out


def count(seen, of, verdict):
    return [name for name, line in seen.items() if line[of] == verdict]


def show_verdicts(shown, seen, n):
    shown.row("programs drawn, with a picture, and inspected", f"{len(seen)} of {n}", f"{n}", len(seen) == n)
    for of in ("default", "auto"):
        worse = count(seen, of, "worse")
        shown.row(f"{of}: worse than the raster frame", f"{len(worse)}: {', '.join(worse)}" if worse else "0", "0",
                  not worse)
    lit = [name for name, line in seen.items() if line["lit"]]
    better = [name for name in lit if "better" in (seen[name]["default"], seen[name]["auto"])]
    shown.row("better, among scenes that are lit or have shadows", f"{len(better)} of {len(lit)}",
              f"{LEAST_BETTER:.0%}",
              len(better) >= LEAST_BETTER * len(lit))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--programs", type=int, default=ENOUGH)
    options = parser.parse_args()
    need_display()
    build = options.build.resolve()
    known = yaml.safe_load(SEEN.read_text()) if SEEN.exists() else {}
    seed = options.seed if options.seed is not None else max(known, default=secrets.randbelow(1 << 31))
    every = programs.sweep()
    order = random.Random(seed).sample(every, len(every))
    shown, seen, drawn = Shown(build, "lot"), {}, 0
    print(f"seed {seed}, of {len(every)} programs", flush=True)
    for program in order:
        if drawn == options.programs:
            break
        try:
            path = picture(build, program, build / "show/lot" / program.name)
        except RuntimeError as why:
            print(f"{program.name}: {why}", flush=True)
            continue
        drawn += 1
        line = known.get(seed, {}).get(program.name)
        if line:
            seen[program.name] = line
        print(f"{program.name}: {line or 'inspect'} {path}", flush=True)
    show_verdicts(shown, seen, options.programs)
    sys.exit(shown.finish())


if __name__ == "__main__":
    main()
