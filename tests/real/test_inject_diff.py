#!/usr/bin/python3
# limit: 300 s
"""diff while memory is short and while its files cannot be read: no frame passes, and no page is written, by what was
not seen."""
from helpers import finish
from injected import check_points, malloc_places, reads

check_points(("diff", malloc_places, 30, 0), ("diff", reads, 20, 0))
finish()
