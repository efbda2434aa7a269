#!/usr/bin/python3
"""A frame that shows what earlier ones drew goes back as far as it must, and no farther, with the same picture:
tests/real/back.c. On the way it leaves pixels in the cache for those that come later.
"""
import os
import re

from helpers import AS_SHOWN, BUILD, SCRATCH, check, finish, frames_of, must, record, relume, render

trace = SCRATCH / "back.trace"
record(trace, BUILD / "tests/real/back")
whole = frames_of(trace)
render(trace, whole, *AS_SHOWN, "-f", "0-239")


def beginnings(frames, *options):
    """Render some frames alone; they show what they show among all others. Returns where frames were played from."""
    out = SCRATCH / f"alone{frames}"
    done = must(relume("render", trace, "-f", frames, "-o", out / "x.####.exr", *AS_SHOWN, *options))
    for frame in frames.split(","):
        one, = out.glob(f"x.{frame:>04}.exr")
        same, = whole.glob(f"*.{frame:>04}.exr")
        check(
            must(relume("diff", same, one)).returncode == 0 and one.read_bytes() == same.read_bytes(),
            f"{frames}: frame {frame} is another picture")
    return [(int(frame), int(first))
            for frame, first in re.findall(r"frame (\d+) needs the pixels .*playing them from frame (\d+)", done.stderr)
            ]


def kept():
    """Frames that have pixels in the cache, and their files."""
    return {int(path.stem.rpartition("-")[2]): path for path in PIXELS.glob("*.index")}


os.environ["XDG_CACHE_HOME"] = str(SCRATCH / "cache")
PIXELS = SCRATCH / "cache/relume/pixels"
near = beginnings("135", "--no-cache")
check([frame for frame, _ in near] == [135] and 60 < near[0][1] <= 119, f"frame 135 needs them from frame 120: {near}")
far = beginnings("230", "--no-cache")
check(len(far) == 2 and 140 < far[0][1] <= 214 and 60 < far[1][1] <= 102, f"frame 230 needs them from frame 140: {far}")
check(beginnings("140") == [], "frame 140 needs none")
check(len(beginnings("95,115,135", "--no-cache")) == 1, "what one frame needs, the next ones get at once")
check(not kept(), "--no-cache keeps no pixels")

beginnings("230")
check(set(kept()) == {128, 160, 192, 224}, f"pixels are kept on the way: {sorted(kept())}")
for frame, begins in ((230, 224), (239, 224), (200, 192), (191, 160)):
    found = beginnings(str(frame))
    check(found == [(frame, begins)], f"frame {frame} begins with pixels: {found}")
kept()[224].write_bytes(kept()[224].read_bytes()[:-50])
kept()[192].unlink()
found = beginnings("230")
check(found == [(230, 192), (230, 160)], f"frame 230 does without the damaged pixels of frame 224: {found}")
check(beginnings("230") == [(230, 224)], "they are made anew")
finish()
