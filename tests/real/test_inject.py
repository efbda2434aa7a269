#!/usr/bin/python3
# limit: 300 s
"""A few system calls fail in turn: the command gives the same result anyway, or ends with one line."""
import subprocess

from helpers import RELUME, SCRATCH, check, corpus, finish, record
from injected import check_points, inject

MOST = 7  # per class
QUICK = ("index", "info", "scene", "trim", "approve")

check_points(*((name, inject.points_of, 11, MOST) for name in QUICK),
             *((name, inject.places_of, 30, 0) for name in QUICK))
record(SCRATCH / "x.trace", corpus("two_triangles"), "--frames", "2", "--size", "64x48")
for verb in (["info"], ["scene", "-f", "0"], ["dump"]):
    with open("/dev/full", "w") as full:
        done = subprocess.run([RELUME, *verb, SCRATCH / "x.trace"], stdout=full, stderr=subprocess.PIPE, text=True,
                              check=False)
    check(done.returncode == 5 and done.stderr.count("standard output") == 1,
          f"{verb[0]} on a full disk: exit code {done.returncode}: {done.stderr}")
finish()
