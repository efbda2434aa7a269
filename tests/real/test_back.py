#!/usr/bin/python3
"""A frame that shows the drawing of earlier frames starts from the latest frame possible, and gives the same picture:
tests/real/back.c. On the way it caches pixels for later frames.
"""
import os
import re

from helpers import AS_SHOWN, BUILD, SCRATCH, check, finish, frames_of, must, record, relume, render

trace = SCRATCH / "back.trace"
record(trace, BUILD / "tests/real/back")
whole = frames_of(trace)
render(trace, whole, *AS_SHOWN, "-f", "0-239")


def beginnings(frames, *options):
    """Render some frames alone; they must equal those of a full run. Returns the frames that replay started from."""
    out = SCRATCH / f"alone{frames}"
    done = must(relume("render", trace, "-f", frames, "-o", out / "x.####.exr", *AS_SHOWN, *options))
    for frame in frames.split(","):
        one, = out.glob(f"x.{frame:>04}.exr")
        same, = whole.glob(f"*.{frame:>04}.exr")
        check(
            must(relume("diff", same, one)).returncode == 0 and one.read_bytes() == same.read_bytes(),
            f"{frames}: frame {frame} differs")
    return [(int(frame), int(first))
            for frame, first in re.findall(r"frame (\d+) needs the pixels .*playing them from frame (\d+)", done.stderr)
            ]


def kept():
    """Frames with pixels in the cache, and their files."""
    return {int(path.stem.rpartition("-")[2]): path for path in PIXELS.glob("*.index")}


os.environ["XDG_CACHE_HOME"] = str(SCRATCH / "cache")
PIXELS = SCRATCH / "cache/relume/pixels"
near = beginnings("135", "--no-cache")
check([frame for frame, _ in near] == [135] and 60 < near[0][1] <= 119, f"frame 135 needs them from frame 120: {near}")
far = beginnings("230", "--no-cache")
check(len(far) == 2 and 140 < far[0][1] <= 214 and 60 < far[1][1] <= 102, f"frame 230 needs them from frame 140: {far}")
check(beginnings("140") == [], "frame 140 needs none")
check(len(beginnings("95,115,135", "--no-cache")) == 1, "the next frames reuse the pixels made for one")
check(not kept(), "--no-cache caches no pixels")

def last_kept(frame):
    return max(number for number in kept() if number <= frame)


beginnings("230")
there = sorted(kept())
check(there and 60 <= there[0] <= 230 and there[-1] <= 230, f"pixels are cached on the way: {there}")
for frame in (230, 239, 200, 191, 150):
    begins = last_kept(frame)
    found = beginnings(str(frame))
    check(found in ([(frame, begins)], []), f"frame {frame} starts from the pixels of frame {begins}: {found}")
damaged, gone = sorted(number for number in kept() if number <= 230)[-1:-3:-1]
kept()[damaged].write_bytes(kept()[damaged].read_bytes()[:-50])
kept()[gone].unlink()
found = beginnings("230")
check(found[-1][1] <= last_kept(damaged - 1), f"frame 230 ignores the damaged pixels of frame {damaged}: {found}")
check(len(beginnings("230")) <= 1, "damaged pixels are rebuilt")
finish()
