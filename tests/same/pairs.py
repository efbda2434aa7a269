"""Pairs of recordings that draw the same scene, and the requirements on their pictures.

A frame of a recording is cut out (relume trim) and drawn in another way (relations.c); `relume render` makes both
pictures. `gl.*`, GL's picture, and R G B, the traced one, are compared in display codes (--encoding display). Two
pixels are equal if no channel differs by more than TOLERANCE, and no pixel may differ. If a relation changes rounding,
the tolerance is ROUNDED_TOLERANCE, and edges may shift by one pixel: a pixel then differs if it is outside the range of
the 3 x 3 pixels around it in the other picture, and a share of ROUNDED, or of COARSELY, may differ. In several passes
the same share may differ, because another one of coplanar surfaces may be visible.
"""
import pathlib
import subprocess
import sys

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/show"))
import exr_numpy as exr  # noqa: E402

RUNS, ALL, PASSES, ROUNDS, SATURATES, COVERS, COARSE, TRIPLES = (1 << i for i in range(8))
TOLERANCE = 1.01 / 255
ROUNDED_TOLERANCE = 4.01 / 255  # if rounding differs, also for light added in passes
ROUNDED = 5e-4
COARSELY = 1e-2
COVERED = 0.1  # share of the picture where GL's own may differ
PICTURES = {"gl": ("gl.R", "gl.G", "gl.B"), "traced": ("R", "G", "B")}
TRIMMED = "trimmed"  # the frame cut out, compared with the whole recording


class Verdict:
    """same: True, False, or None if the relation does not apply, with the reason."""

    def __init__(self, same, why="", share=0.0, picture="", where=None, draw=None):
        self.same, self.why, self.share, self.picture, self.where, self.draw = same, why, share, picture, where, draw

    def __str__(self):
        if self.same is not False or not self.picture:
            return self.why or "same"
        at = f"pick {self.where[0]},{self.where[1]}"
        return f"{self.picture}: {100 * self.share:.3g} % of the pixels differ, first draw {self.draw} ({at})"


def run(*args):
    """Run a program; after five minutes it counts as failed."""
    return subprocess.run(["timeout", "300", *map(str, args)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          errors="replace", check=False)


def read_relations(tool):
    """{name: (base, flags, what)}, in order. base: a relation, "-" for the recording itself, "" for a relation that is
    only a base.
    """
    rows = [line.split("\t") for line in run(tool).stdout.splitlines()]
    return {TRIMMED: ("-", 0, "the frame cut out by relume trim"),
            **{name: (base, int(flags), what) for name, base, flags, what in rows}}


def around(plane, take):
    """The least or greatest (take) of each pixel's 3 x 3 neighbours."""
    padded = numpy.pad(plane, 1, mode="edge")
    height, width = plane.shape
    return take.reduce([padded[y:y + height, x:x + width] for y in range(3) for x in range(3)])


def outside(plane, other, tolerance):
    """Pixels of a plane outside the range of the pixels around them in the other one."""
    low, high = around(other, numpy.minimum) - tolerance, around(other, numpy.maximum) + tolerance
    return ~((plane >= low) & (plane <= high))


def differing(ours, theirs, tolerance, rounds):
    """Pixels that differ between both."""
    bad = numpy.logical_or.reduce([~(abs(p - q) <= tolerance) for p, q in zip(ours, theirs)])
    if rounds and bad.any():
        both = [*zip(ours, theirs), *zip(theirs, ours)]
        bad = numpy.logical_or.reduce([outside(plane, other, tolerance) for plane, other in both])
    return bad


def compare(image, other, flags):
    """The verdict on two pictures; image is the base's."""
    tolerance = ROUNDED_TOLERANCE if flags & (ROUNDS | SATURATES) else TOLERANCE
    allowed = COARSELY if flags & COARSE else ROUNDED if flags & (ROUNDS | PASSES | COVERS) else 0
    planes = {name: [[i.planes[c].astype("f4") for c in channels] for i in (image, other)]
              for name, channels in PICTURES.items()}
    if flags & TRIPLES:
        planes = {name: [ours, [plane[1::3, 1::3] for plane in theirs]] for name, (ours, theirs) in planes.items()}
    if any(a.shape != b.shape for a, b in zip(*planes["gl"])):
        return Verdict(False, "the pictures have different sizes")
    left = numpy.ones(planes["gl"][0][0].shape, bool)
    if flags & SATURATES:
        left = around(numpy.maximum.reduce(planes["gl"][0]), numpy.maximum) < 1 - TOLERANCE
    if flags & COVERS:
        left = ~around(differing(*planes["gl"], tolerance, flags & ROUNDS), numpy.maximum)
        if left.mean() < 1 - COVERED:
            return Verdict(None, "GL's picture is another one, as it may be")
    for name, pair in planes.items():
        bad = differing(*pair, tolerance, flags & ROUNDS) & left
        if bad.mean() > allowed:
            draws = numpy.where(bad, image.planes["id"].astype("f8"), numpy.inf)
            y, x = numpy.unravel_index(numpy.argmin(draws), draws.shape)
            return Verdict(False, share=bad.mean(), picture=name, where=(int(x), int(y)), draw=int(draws[y, x]))
    return Verdict(True)


class Variants:
    """A frame of a recording, and its variants. Files go into a folder of its own."""

    def __init__(self, build, trace, frame, folder):
        self.build, self.trace, self.frame = build, pathlib.Path(trace), frame
        self.folder, self.images = pathlib.Path(folder), {}
        self.relations = read_relations(build / "tests/same/relations")
        self.folder.mkdir(parents=True, exist_ok=True)
        self.cut = self.folder / "cut.trace"
        done = run(build / "relume", "trim", "-f", frame, "-o", self.cut, trace)
        if done.returncode:
            raise ValueError(f"{trace}: {done.stderr}")
        before = done.stdout.rpartition("it is frame ")[2].split()  # it may need earlier frames, which are kept
        self.cut_frame = int(before[0]) if "it is frame " in done.stdout else 0

    def render(self, trace, frame, name):
        """The picture, or a verdict with the reason why there is none."""
        path = self.folder / f"{name}.exr"
        done = run(self.build / "relume", "render", trace, "-f", frame, "-o", path, "--encoding", "display",
                   "--aov", "gl,id", "--progress", "none")
        if done.returncode not in (0, 6):
            return Verdict(False, f"render exits with {done.returncode}: {done.stderr.strip()[-200:]}")
        image = exr.Image(path)
        path.unlink()
        return image

    def picture(self, name):
        """The frame's picture as drawn under a relation, or a verdict with the reason why there is none. Bases are
        cached.
        """
        if name in self.images:
            return self.images[name]
        if name == TRIMMED:
            return self.render(self.trace, self.frame, name)
        trace = self.cut if name == "-" else self.folder / f"{name}.trace"
        if name != "-":
            done = run(self.build / "tests/same/relations", name, self.cut, trace)
            if done.returncode == 77:
                return Verdict(None, done.stdout.strip())
            if done.returncode:
                return Verdict(
                    False, f"the relation cannot be applied: exit code {done.returncode}: {done.stderr.strip()}")
        image = self.render(trace, self.cut_frame, name)
        if name != "-":
            trace.unlink()
        if any(base == name for base, _, _ in self.relations.values()):
            self.images[name] = image
        return image

    def pair(self, name):
        """The verdict on a relation."""
        base, flags, _ = self.relations[name]
        images = self.picture(base), self.picture(name)
        return next((image for image in images if isinstance(image, Verdict)), None) or compare(*images, flags)
