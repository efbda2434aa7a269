#!/usr/bin/python3
# limit: 300 s
"""render while memory is short from some place in the code on: no draw is left out of a picture, and none is drawn as
another."""
from helpers import finish
from injected import check_points, malloc_places_always

check_points(("render by programs", malloc_places_always, 100, 0))
finish()
