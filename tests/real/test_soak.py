#!/usr/bin/python3
# limit: 300 s
"""The short form of show-soak: a few hundred frames and a few programs by one process each, and the disturbances."""
import pathlib
import sys

from helpers import BUILD, SCRATCH, check, finish

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "show"))
sys.dont_write_bytecode = True
from soak import soak  # noqa: E402

for row in soak(BUILD, SCRATCH, 400, 40, 20):
    check(row["passed"], f"{row['what']}: {row['figure']} (bar {row['bar']})")
finish()
