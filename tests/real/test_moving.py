#!/usr/bin/python3
"""jigglypuff's 4096 triangles move in each frame: their tree is refitted from frame to frame, or built if a frame is
rendered alone.

The frame's file must be the same to the byte.
"""
import pathlib

from helpers import SCRATCH, check, finish, record, render, skip

PROGRAM = pathlib.Path("/usr/libexec/xscreensaver/jigglypuff")
if not PROGRAM.exists():
    skip("jigglypuff is not installed (xscreensaver-gl-extra)")
trace = SCRATCH / "jigglypuff.trace"
record(trace, "sh", "-c", f"timeout 3 {PROGRAM} -geometry 200x200; true", options=())
row = render(trace, SCRATCH / "row", "-f", "0-6", "-j", "1")
check(len(row) == 7, f"{len(row)} frames")
for frame in (3, 6):
    alone = render(trace, SCRATCH / f"alone{frame}", "-f", frame)
    check(alone[0].read_bytes() == row[frame].read_bytes(), f"frame {frame} differs when rendered alone")
check(row[3].read_bytes() != row[6].read_bytes(), "nothing moves")
finish()
