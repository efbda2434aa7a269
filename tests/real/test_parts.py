#!/usr/bin/python3
"""Frames that need no earlier ones are rendered without them, and those that do say so: tests/real/parts.c. Those that begin with a picture are the
same whether they are drawn layer by layer (packets) or segment by segment."""
from helpers import AS_SHOWN, SCRATCH, check, check_alone, check_same_pictures, finish, must, relume

FRAMES = ("two views", "two views again", "a corner copied", "a corner copied again", "tiles", "tiles again", "blended tiles",
          "blended tiles again", "two views and a gap", "less of a corner copied", "tiles that let something through")
trace, _ = check_same_pictures("parts", FRAMES)
for frame in range(1, len(FRAMES)):
    done = must(relume("render", trace, "-f", frame, "-o", SCRATCH / "one.####.exr", *AS_SHOWN))
    told = f"frame {frame} needs the pixels of frames before it" in done.stderr
    check(told == (frame >= 8), f"{FRAMES[frame]}: said to need earlier frames: {told}: {done.stderr}")
    check_alone(trace, frame)
for device in ((), ("--device", "reference")):
    ways = []
    for kernels in ("packets", "binary"):
        folder = SCRATCH / f"{kernels}{len(device)}"
        must(relume("render", trace, "-f", f"0-{len(FRAMES) - 1}", "-o", folder / "####.exr", "--kernels", kernels, *device))
        ways.append([file.read_bytes() for file in sorted(folder.iterdir())])
    check(len(ways[0]) == len(FRAMES) and ways[0] == ways[1], f"{device}: packets leave other files than binary")
finish()
