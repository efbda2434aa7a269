#!/usr/bin/python3
"""Two white triangles on black: traced and rasterized frames agree, whatever the angle."""
from helpers import SCRATCH, check, corpus, diff, finish, record, render

FRAMES = 12
trace = SCRATCH / "two.trace"
record(trace, corpus("two_triangles"), "--frames", str(FRAMES), "--animate", "camera")
files = render(trace, SCRATCH / "frames")
check(len(files) == FRAMES, f"{len(files)} frames of {FRAMES}")
code, score = diff(trace, SCRATCH / "frames")
check(code == 0, f"exit code {code}")
check(len(score["frames"]) == FRAMES, "every frame is scored")
for frame in score["frames"]:
    figure = frame["gates"]["R1"]["figures"][0]["value"]
    check(figure == 0, f"frame {frame['frame']}: {figure} % of the interior pixels differ")
    check(frame["failing_pixels"] == 0, f"frame {frame['frame']}: {frame['failing_pixels']} pixels fail")
finish()
