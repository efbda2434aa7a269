#!/usr/bin/python3
"""tests/show/beyond.py BUILD [--only PART] (as `make show-beyond`): pictures that go beyond what the program drew.

size: programs recorded in a 320x240 window and rendered with `--scale 4`, compared with Mesa's picture in a 1280x960
window (`relume raster`): number of frames that pass the gates of `relume diff`, and the lowest fidelity. Also the cost
relative to rendering a recording made at the larger size: processor time of whole runs, alternated.

moment: programs recorded at a quarter of their rate and rendered with `--fps`, compared with the same programs recorded
at the full rate: mean FLIP of the pictures between recorded frames.
"""
import argparse
import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

from display import need_display
from table import Shown

FACTOR, WIDTH, HEIGHT, FRAMES = 4, 320, 240, 3
FIDELITY = 99.5  # per cent
MOST_COST = 1.1
RUNS = 5
PROGRAMS = {
    "spheres": (), "hall": (), "still_life": (), "courtyard": (), "street": (), "tree_cards": (), "cornell": (),
    "two_triangles": (), "tricks": ("planar", ), "facets": ()
}


STEP, MOMENTS = 4, 25
MOST_FLIP = 0.02
MOVING = {
    "arena": ("camera", ), "blocks": ("camera", "light"), "board_fbo": ("camera", ), "closed_hall": ("camera", ),
    "courtyard": ("camera", ), "facets": ("camera", ), "hall": ("camera", "light"),
    "model_on_cube": ("camera", "light"), "phong": ("camera", ), "spheres": ("camera", "light"),
    "tree_cards": ("camera", "light")
}


class Recordings:
    def __init__(self, build, folder):
        self.build, self.folder = build, pathlib.Path(folder)
        self.relume = build / "relume"

    def run(self, *args, check=True):
        return subprocess.run([str(a) for a in args], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, check=check)

    def record(self, name, width, height):
        trace = self.folder / f"{name}-{width}.trace"
        self.run(self.relume, "record", "-o", trace, "--", self.build / "corpus" / name, *PROGRAMS[name], "--frames",
                 FRAMES, "--size", f"{width}x{height}")
        return trace

    def flips(self, name, what):
        """Mean FLIP of each picture between recorded frames."""
        traces = {step: self.folder / f"{name}-every-{step}.trace" for step in (1, STEP)}
        for step, trace in traces.items():
            self.run(self.relume, "record", "-o", trace, "--", self.build / "corpus" / name, "--animate", what,
                     "--frames", (MOMENTS - 1) // step + 1, "--step", step, "--size", f"{WIDTH}x{HEIGHT}")
        self.run(self.relume, "render", traces[1], "-o", f"{name}.shown.####.exr")
        self.run(self.relume, "render", traces[STEP], "--recorded-fps", 1, "--fps", STEP, "-o", f"{name}.made.####.exr")
        scored = json.loads(
            self.run(self.relume, "diff", f"{name}.shown.####.exr", f"{name}.made.####.exr", "--channel", "beauty",
                     "--json", "-", check=False).stdout)
        flips = [frame["gates"]["P"]["figures"][0]["value"] for frame in scored["frames"]]
        assert len(flips) == MOMENTS, scored
        return [flip for number, flip in enumerate(flips) if number % STEP]

    def score(self, name):
        """(frames that pass, frames, lowest fidelity in per cent)."""
        small = self.record(name, WIDTH, HEIGHT)
        large = self.record(name, WIDTH * FACTOR, HEIGHT * FACTOR)
        self.run(self.relume, "raster", large, "-o", f"{name}.####.png")
        self.run(self.relume, "render", small, "--scale", FACTOR, "--mode", "gl", "-o", f"{name}.####.exr")
        scored = json.loads(
            self.run(self.relume, "diff", f"{name}.####.png", f"{name}.####.exr", "--json", "-", check=False).stdout)
        return (scored["counts"]["passed"], len(scored["frames"]),
                100 * min(frame["fidelity"] for frame in scored["frames"]))

    def seconds(self, trace, *options):
        """Processor time of rendering all frames."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.run(self.relume, "render", trace, *options, "-o", "cost.####.exr")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def show_sizes(shown, recordings):
    for name in PROGRAMS:
        passed, frames, fidelity = recordings.score(name)
        shown.row(f"size: {name}, {WIDTH}x{HEIGHT} scaled by {FACTOR}, against a recording of that size",
                  f"{passed} of {frames} frames pass, fidelity {fidelity:.3f} %", f"all, {FIDELITY} %",
                  passed == frames == FRAMES and fidelity >= FIDELITY, "Mesa")
    for name in ("hall", "spheres"):
        ways = ((recordings.folder / f"{name}-{WIDTH}.trace", "--scale", FACTOR),
                (recordings.folder / f"{name}-{WIDTH * FACTOR}.trace", ))
        for way in ways:  # the first run compiles the kernels
            recordings.seconds(*way)
        pairs = [[recordings.seconds(*way) for way in ways] for _ in range(RUNS)]
        cost = statistics.median(scaled / recorded for scaled, recorded in pairs)
        shown.row(f"size: {name}, processor time relative to a recording of that size", f"{cost:.2f} times",
                  f"{MOST_COST} times", cost <= MOST_COST)


def show_moments(shown, recordings):
    for name, what in ((name, what) for name, moving in MOVING.items() for what in moving):
        flips = recordings.flips(name, what)
        shown.row(f"moment: {name}, its {what} moving: FLIP's mean of {len(flips)} pictures between frames, at most",
                  f"{max(flips):.4f}", f"{MOST_FLIP}", max(flips) <= MOST_FLIP, "the program at four times the rate")


PARTS = {"size": show_sizes, "moment": show_moments}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--only", choices=PARTS)
    args = parser.parse_args()
    need_display()
    os.environ.setdefault("POCL_CACHE_DIR", str(args.build / "tests/pocl-cache"))
    shown = Shown(args.build, "beyond")
    with tempfile.TemporaryDirectory(prefix="relume-") as folder:
        for name, part in PARTS.items():
            if args.only in (None, name):
                part(shown, Recordings(args.build, folder))
    return shown.finish()


if __name__ == "__main__":
    sys.exit(main())
