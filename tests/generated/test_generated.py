#!/usr/bin/python3
"""Random programs (tests/generated/program.c) are recorded, and must be drawn as Mesa draws them: some of those of
`make show-generated`, and each kind of step.

limit: 300 s
"""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "tests/real"), str(ROOT / "tests/show")]
from generated import UNABLE, Generator  # noqa: E402
from helpers import BUILD, SCRATCH, check, finish, run, skip  # noqa: E402

COUNT, LEAST = 50, 0.9

generator = Generator(BUILD, "color")
numbers = [str(n) for n in range(1, COUNT + 1)]
if run(ROOT / "tests/xvfb.sh", generator.program, numbers[0]).returncode == 77:
    skip("this GL has no such windows")
kinds = set()
for number in numbers:
    steps = generator.steps(number)
    check(steps == generator.steps(number), f"program {number} is the same each time")
    kinds |= set(steps.values())
check(len(kinds) == int(run(generator.program, "--kinds").stdout), f"kinds of steps: {len(kinds)}")
score = generator.score(numbers, SCRATCH / "generated")
bad = {name: gates for name, gates in score.items() if gates and gates is not UNABLE}
check(len(bad) <= (1 - LEAST) * COUNT, f"programs drawn differently from Mesa: {bad}")
finish()
