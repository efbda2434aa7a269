#!/usr/bin/python3
# limit: 300 s
"""diff while memory is short or its files cannot be read: it must neither pass a frame nor write a page without having
read its input."""
from helpers import finish
from injected import check_points, malloc_places, reads

check_points(("diff", malloc_places, 30, 0), ("diff", reads, 20, 0))
finish()
