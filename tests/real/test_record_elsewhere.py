#!/usr/bin/python3
"""While another window is the read drawable, frames keep their own window's size and have no reference; other frames
have one: tests/real/elsewhere.c."""
from exr import Image
from helpers import AS_SHOWN, BUILD, SCRATCH, check, diff, finish, on_display, record, render, skip

if on_display(BUILD / "tests/real/elsewhere").returncode == 77:
    skip("no other window can be the read drawable")
trace = SCRATCH / "elsewhere.trace"
said = record(trace, BUILD / "tests/real/elsewhere").stderr
check(" 4 frames, " in said and said.count("another read drawable") == 1, f"it is said, once: {said}")
render(trace, SCRATCH / "out", *AS_SHOWN)
frames = {frame["frame"]: frame for frame in diff(trace, SCRATCH / "out")[1]["frames"]}
check([frames[i]["outcome"] for i in range(4)] == ["extra", "extra", "passed", "passed"],
      f"outcomes: {[f['outcome'] for f in frames.values()]}")
check(all(frame["failing_pixels"] == 0 for frame in (frames[2], frames[3])), "frames with a reference are the same")


sizes = [(image.width, image.height) for image in map(Image, sorted((SCRATCH / "out").glob("*.exr")))]
check(sizes == [(64, 48)] * 4, f"sizes: {sizes}")
finish()
