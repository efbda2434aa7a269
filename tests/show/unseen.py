"""Geometry that portal culling leaves out (corpus/rooms; the viewer walks through all rooms, so other frames draw it).
With the geometry of other frames, does the culled recording show the shadows and mirrors of the whole level?"""
import pathlib
import re
import subprocess

import numpy

import exr_numpy
import sheet

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SEEDS, FRAMES, SHOWN = (5, 7), 120, (6, 40, 90)
BAR = 99 # percentage of the pixels
NEAR = 2 # codes, of 255


def equal_share(first, second):
    """Percentage of equal pixels, shadows and mirrors included."""
    apart = numpy.abs(
        sheet.display(exr_numpy.Image(first)).astype(int) - sheet.display(exr_numpy.Image(second)).astype(int))
    return float(100 * (apart.max(axis=-1) <= NEAR).mean())


def rows(build, work):
    """One row per seed: the worst frame, with and without the geometry of other frames."""
    for seed in SEEDS:
        for cull in ("none", "portal"):
            sheet.run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", work / f"{cull}.trace", "--",
                      build / "corpus/rooms", "--seed", seed, "--frames", FRAMES, "--walk", "--mirror", "--shadow",
                      "--lighting", "opengl", "--cull", cull)
        found, none = work / "found.look.yaml", work / "none.look.yaml"
        sheet.run(build / "relume", "look", work / "portal.trace", "-o", found)
        # Keep only the rules for unseen geometry: the others differ slightly between the two recordings.
        unseen, world = re.search(r"\nunseen:\n(?:  .*\n)+",
                                  found.read_text()), re.search(r"\nworld:\n(?:  .*\n?)+", found.read_text())
        found.write_text("spare: no" + (unseen[0] if unseen else "\n") + world[0])
        none.write_text("spare: no\n")
        shares = {"without": [], "with": []}
        for frame in SHOWN:
            for name, trace, rules in (("whole", "none", none), ("without", "portal", none), ("with", "portal", found)):
                sheet.run(build / "relume", "render", work / f"{trace}.trace", "-f", frame, "-o", work / f"{name}.exr",
                          "--look", rules)
            for name, list_of in shares.items():
                list_of.append(equal_share(work / "whole.exr", work / f"{name}.exr"))
        print(
            f"rooms {seed}, culled: equals the whole level on {min(shares['with']):.2f} % of the pixels of its worst "
            f"frame (without geometry that other frames "
            f"draw: {min(shares['without']):.2f} %; bar: {BAR} %)", flush=True)
        yield {
            "what": f"rooms, seed {seed}: pixels of the culled recording that equal the whole one, worst of "
                    f"{len(SHOWN)} frames",
            "figure": f"{min(shares['with']):.2f} % (without that of other frames: {min(shares['without']):.2f} %)",
            "bar": f"{BAR} %", "peer": None, "passed": min(shares["with"]) >= BAR
        }
