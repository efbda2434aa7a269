#!/usr/bin/python3
"""A window that changes its size between frames and within one: each frame of tests/real/growing.c is seen completely
at its own size."""
from helpers import check_same_pictures, finish

check_same_pictures("growing", ("64 x 48", "grown to 100 x 80", "100 x 80 still", "shrunk to 60 x 70", "100 x 80 again",
                                "narrower, and higher", "begun before it grew", "110 x 140"))
finish()
