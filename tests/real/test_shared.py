#!/usr/bin/python3
"""A program object whose uniforms are set by two contexts (tests/real/shared.c): each must draw with the values that
Mesa uses, from the start and from any frame."""
from helpers import check_alone, check_same_pictures, finish

FRAMES = ("the same value", "no value", "another value", "another and back", "another element", "no program between",
          "another program between", "linked again")
trace, _ = check_same_pictures("shared", FRAMES)
for frame in (1, 4, 7):
    check_alone(trace, frame)
finish()
