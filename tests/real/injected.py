"""Shared by the tests of failing calls. All calls: make show-inject."""
import sys
import tempfile

from helpers import BUILD, ROOT, SCRATCH, check, pathlib

sys.path.insert(0, str(ROOT / "tests/show"))
import inject  # noqa: E402


def last_mallocs(counts, most):
    """The last calls before a traced picture is written, when its attributes are built."""
    return [f"malloc:{counts['malloc'] - i}" for i in range(most)]


def last_places(counts, most):
    """The call sites of malloc that were reached last, with all their calls failing."""
    n = len(inject.places_counts(counts, "malloc"))
    return [f"malloc@{n - i}+" for i in range(most)]


def malloc_places(counts, most):
    return [point for point in inject.places_of(counts, most) if point.startswith("malloc")]


def malloc_places_always(counts, most):
    return [point for point in malloc_places(counts, most) if point[-1] == "+"]


def reads(counts, most):
    return [point for point in inject.points_of(counts, most) if point.startswith("read")]


def check_points(*asked):
    """asked: (name of a case, selection of points from the counts, minimum number of points, most)"""
    with tempfile.TemporaryDirectory(dir=SCRATCH) as folder:
        inputs = pathlib.Path(folder)
        inject.prepare(BUILD, inputs)
        trial = inject.Trial(BUILD, inputs)
        for name, points, least, most in asked:
            n, wrong = inject.try_case(trial, next(case for case in inject.CASES if case.name == name), most, 2, points)
            check(n >= least, f"{name}: {n} points")
            for what in wrong:
                check(False, what)
