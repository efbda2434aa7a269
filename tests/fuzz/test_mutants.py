#!/usr/bin/python3
# limit: 300 s
"""A recording of one of our programs, damaged in many ways: info and scene must handle each mutant properly."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
sys.dont_write_bytecode = True
from helpers import SCRATCH, corpus, record  # noqa: E402
from mutate import main  # noqa: E402

trace = SCRATCH / "mutants.trace"
record(trace, corpus("two_triangles"), "--frames", "6", options=())
sys.exit(bool(main(trace, 60, 1, 200000)))
