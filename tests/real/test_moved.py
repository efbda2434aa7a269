#!/usr/bin/python3
"""What a vertex program moves throws its shadow from where it is: tests/real/moved.c, whose two frames show the
same."""
import numpy

import exr
from helpers import BUILD, SCRATCH, check, finish, record, render

MOST = 4  # pixels: one tree holds what the program gave, the other what it left

trace = SCRATCH / "moved.trace"
record(trace, BUILD / "tests/real/moved")
shadows = []
for file in render(trace, SCRATCH / "moved"):
    shadows.append(numpy.asarray(exr.Image(file).planes["shadow.R"]))
there, moved = shadows
dark = numpy.count_nonzero(there < 0.5)
differ = numpy.count_nonzero(abs(there - moved) > 1e-3)
check(dark > 200, f"{dark} pixels of shadow")
check(differ <= MOST, f"{differ} pixels of shadow differ where the program moves the triangle")
finish()
