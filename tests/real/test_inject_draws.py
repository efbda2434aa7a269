#!/usr/bin/python3
# limit: 300 s
"""render with memory failures from a given place in the code on: no draw may be left out of a picture or drawn
differently."""
from helpers import finish
from injected import check_points, malloc_places_always

check_points(("render by programs", malloc_places_always, 100, 0))
finish()
