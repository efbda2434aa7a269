#!/usr/bin/python3
"""An object moved by a vertex program casts its shadow from its new place: both frames of tests/real/moved.c show the
same."""
import numpy

import exr
from helpers import BUILD, SCRATCH, check, finish, record, render

MOST = 4  # pixels: one tree holds the program's vertices, the other the transformed ones

trace = SCRATCH / "moved.trace"
record(trace, BUILD / "tests/real/moved")
shadows = []
for file in render(trace, SCRATCH / "moved"):
    shadows.append(numpy.asarray(exr.Image(file).planes["shadow.R"]))
there, moved = shadows
dark = numpy.count_nonzero(there < 0.5)
differ = numpy.count_nonzero(abs(there - moved) > 1e-3)
check(dark > 200, f"{dark} pixels of shadow")
check(differ <= MOST, f"{differ} pixels of shadow differ if the program moves the triangle")
finish()
