#!/usr/bin/python3
# limit: 300 s
"""Forty wrong inputs: one line with the reason, the right exit code, no partial output."""
import os

import wrong_inputs
from journey import BUILD, PLACE, RELUME, begin, check, end, typed

begin("two_triangles", 3)
typed("relume record -o game.trace --ref color,depth -- ./game")
typed("relume render game.trace -o out/game.####.exr")
check(len(wrong_inputs.CASES) == 40, f"{len(wrong_inputs.CASES)} are forty")
for outcome in wrong_inputs.try_all(RELUME, PLACE, {**os.environ, "XDG_CACHE_HOME": str(BUILD / "tests/cache")}):
    check(not outcome.faults, f"{outcome.typed}: {outcome.faults}: {outcome.line}")
end()
