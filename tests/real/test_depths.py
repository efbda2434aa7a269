#!/usr/bin/python3
"""Depth that a frame does not clear must be Mesa's depth, or R5 must report it as unknown: tests/real/depths.c."""
from helpers import check, check_same_pictures, finish

FRAMES = ("never cleared", "never cleared again", "compared with what it began with", "compared with what was written",
          "kept, and not looked at", "cleared")
_, score = check_same_pictures("depths", FRAMES)
states = [(f["gates"]["R4"]["state"], f["gates"]["R5"]["state"]) for f in score["frames"]]
check(states == [("passed", "passed")] * 4 + [("passed", "not measured"), ("passed", "passed")],
      f"R4 and R5 of depths: {states}")
finish()
