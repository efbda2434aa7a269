#!/usr/bin/python3
"""Vertices with NaN colours, with w other than 1, and cut away by clip planes: tests/real/vertices.c traced equals its
raster pictures."""
from helpers import check_same_pictures, finish

check_same_pictures("vertices", ("no numbers", "divided", "planes", "octagon", "provoking", "packed"))
finish()
