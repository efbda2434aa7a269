#!/usr/bin/python3
# limit: 300 s
"""A few calls of the system fail in turn: the command does without them, or ends with one line (all of them: make show-inject)."""
import subprocess
import sys
import tempfile

from helpers import BUILD, ROOT, SCRATCH, check, finish, pathlib

sys.path.insert(0, str(ROOT / "tests/show"))
import inject  # noqa: E402

MOST = 7  # of each class
QUICK = ("index", "info", "scene", "trim", "approve")


def last_mallocs(counts, most):
    """Those of a picture that is traced: what is told of it goes into its attributes."""
    return [f"malloc:{counts['malloc'] - i}" for i in range(most)]


def last_places(counts, most):
    """The same, and always."""
    n = len(inject.places_counts(counts, "malloc"))
    return [f"malloc@{n - i}+" for i in range(most)]


def malloc_places(counts, most):
    return [point for point in inject.places_of(counts, most) if point.startswith("malloc")]


with tempfile.TemporaryDirectory(dir=SCRATCH) as folder:
    inputs = pathlib.Path(folder)
    inject.prepare(BUILD, inputs)
    trial = inject.Trial(BUILD, inputs)
    for name, points, least, most in (*((name, inject.points_of, 11, MOST) for name in QUICK), *((name, inject.places_of, 30, 0) for name in QUICK),
                                      ("diff", malloc_places, 30, 0), ("render", last_mallocs, 20, 20), ("render by programs", last_places, 20, 20)):
        n, wrong = inject.try_case(trial, next(case for case in inject.CASES if case.name == name), most, 2, points)
        check(n >= least, f"{name}: {n} points")
        for what in wrong:
            check(False, what)
    for verb in (["info"], ["scene", "-f", "0"], ["dump"]):
        with open("/dev/full", "w") as full:
            done = subprocess.run([trial.relume, *verb, inputs / "x.trace"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        check(done.returncode == 5 and done.stderr.count("standard output") == 1, f"{verb[0]} on a full disk: exit code {done.returncode}: {done.stderr}")
finish()
