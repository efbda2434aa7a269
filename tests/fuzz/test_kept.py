#!/usr/bin/python3
# limit: 300 s
"""Inputs found by libFuzzer, including every one that ever failed: info and scene must handle each of them properly."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "real"))
sys.dont_write_bytecode = True
from helpers import SCRATCH, check, finish  # noqa: E402
from mutate import pack, run  # noqa: E402

trace = SCRATCH / "kept.trace"
for kept in sorted((HERE / "kept").iterdir()):
    trace.write_bytes(pack(kept.read_bytes()))
    wrong = run(trace)
    check(not wrong, f"{kept.name}: {wrong}")
finish()
