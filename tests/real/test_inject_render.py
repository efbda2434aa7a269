#!/usr/bin/python3
# limit: 300 s
"""render while memory is short for what is told of a picture, or its recording cannot be read: a picture is whole or
not there."""
from helpers import finish
from injected import check_points, last_mallocs, last_places, reads

check_points(("render", last_mallocs, 20, 20), ("render by programs", last_places, 20, 20),
             ("render by programs", reads, 20, 0))
finish()
