#!/usr/bin/python3
# limit: 300 s
"""render with memory failures while a picture's attributes are made, or with an unreadable recording: a picture is
complete or missing."""
from helpers import finish
from injected import check_points, last_mallocs, last_places, reads

check_points(("render", last_mallocs, 20, 20), ("render by programs", last_places, 20, 20),
             ("render by programs", reads, 20, 0))
finish()
