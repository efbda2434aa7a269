#!/usr/bin/python3
"""Vertices whose colours are no numbers, whose w is not 1, and that planes cut away: what tests/real/vertices.c draws
is traced as it was rasterized."""
from helpers import check_same_pictures, finish

check_same_pictures("vertices", ("no numbers", "divided", "planes", "octagon", "provoking", "packed"))
finish()
