#!/usr/bin/python3
"""Front and back buffer of a window: tests/real/front.c traced equals its raster pictures."""
from helpers import check_alone, check_same_pictures, finish

FRAMES = ("back", "band", "second band", "hides", "hidden", "after hidden", "hidden by an earlier frame",
          "front of both", "back of both", "front of listed", "back of listed", "copied", "alone", "alone again",
          "ended by a list", "back again")
trace, _ = check_same_pictures("front", FRAMES, "--frame-end", "flush")
# these show older contents of the front buffer, from frames that are not requested
for frame in (2, 4, 6, 7, 11, 13):
    check_alone(trace, frame)
finish()
