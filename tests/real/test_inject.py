#!/usr/bin/python3
"""A few calls of the system fail in turn: the command does without them, or ends with one line (all of them: make show-inject)."""
import subprocess
import sys
import tempfile

from helpers import BUILD, ROOT, SCRATCH, check, finish, pathlib

sys.path.insert(0, str(ROOT / "tests/show"))
import inject  # noqa: E402

MOST = 7  # of each class


def last_mallocs(counts, most):
    """Those of a picture that is traced: what is told of it goes into its attributes."""
    return [f"malloc:{counts['malloc'] - i}" for i in range(most)]


with tempfile.TemporaryDirectory(dir=SCRATCH) as folder:
    inputs = pathlib.Path(folder)
    inject.prepare(BUILD, inputs)
    trial = inject.Trial(BUILD, inputs)
    for case in inject.CASES:
        if case.name in ("diff", "render"):
            continue
        n, wrong = inject.try_case(trial, case, MOST, 2)
        check(n > 10, f"{case.name}: {n} points")
        for what in wrong:
            check(False, what)
    n, wrong = inject.try_case(trial, next(case for case in inject.CASES if case.name == "render"), 20, 2, last_mallocs)
    check(n == 20 and not wrong, f"render: {wrong}")
    for verb in (["info"], ["scene", "-f", "0"], ["dump"]):
        with open("/dev/full", "w") as full:
            done = subprocess.run([trial.relume, *verb, inputs / "x.trace"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        check(done.returncode == 5 and done.stderr.count("standard output") == 1, f"{verb[0]} on a full disk: exit code {done.returncode}: {done.stderr}")
finish()
