#!/usr/bin/python3
"""`relume render --fps`: deforming objects are matched among others of their kind, even if some appear and disappear.
Compares tests/real/shoal.c at 15 frames per second with itself at 60.

limit: 300 s
"""
import json

import numpy

import exr
from helpers import BUILD, SCRATCH, check, finish, record, relume, render

SLOW, FAST, COUNT = 15, 60, 61
MOST_FLIP = 0.02

traces = {fps: SCRATCH / f"{fps}.trace" for fps in (SLOW, FAST)}
for fps, trace in traces.items():
    record(trace, BUILD / "tests/real/shoal", fps)
render(traces[FAST], SCRATCH / "shown")
files = render(traces[SLOW], SCRATCH / "film", "--fps", FAST, "--recorded-fps", SLOW)
done = relume("diff", SCRATCH / "shown", SCRATCH / "film", "--channel", "beauty", "--json", "-", timeout=300)
figures = [frame["gates"]["P"]["figures"][0]["value"] for frame in json.loads(done.stdout)["frames"]]
check(len(figures) == COUNT, f"{len(figures)} pictures of a second: {COUNT}")
worst = max((value, number) for number, value in enumerate(figures))
check(worst[0] <= MOST_FLIP, f"FLIP against the program's picture: {worst[0]:.4f} in picture {worst[1]}")

texts = [exr.attribute(file, "relume:between").decode() for file in files if exr.attribute(file, "relume:between")]
check(len(texts) == COUNT - COUNT // 4 - 1, f"{len(texts)} pictures are interpolated")
counts = numpy.array([(int(text.split()[0]), int(text.split()[3])) for text in texts])
check(0 < (counts[:, 1] > 0).sum() < len(texts) / 2, f"fish appear or disappear in some: {counts.tolist()}")
check(counts[:, 1].max() <= 2, "the others are matched")
finish()
