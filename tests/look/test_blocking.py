#!/usr/bin/python3
# limit: 600 s
"""Objects that block light without any rules, and others that only seem to: frames of tests/real/blocking.c."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import BUILD, SCRATCH, check, finish, record, render  # noqa: E402

CHANNELS = [f"{layer}{c}" for layer in ("", "gl.", "shadow.") for c in "RGB"]
SIZE = 100


def frames(kind):
    """The planes of each frame of a kind."""
    trace = SCRATCH / f"{kind}.trace"
    record(trace, BUILD / "tests/real/blocking", kind, options=())
    return [Image(f, CHANNELS).planes for f in render(trace, SCRATCH / kind)]


def shadowed(frame, rows=range(SIZE)):
    """Pixels in shadow."""
    return {(x, y) for y in rows for x in range(SIZE) if min(frame[f"shadow.{c}"][y][x] for c in "RGB") < 0.99}


def differing(a, b, layer=""):
    """Pixels that differ by more than one 8-bit step."""
    return sum(any(abs(a[layer + c][y][x] - b[layer + c][y][x]) > 1 / 255 for c in "RGB")
               for y in range(SIZE) for x in range(SIZE))


for number, frame in enumerate(frames("far")):
    check(not shadowed(frame), f"far {number}: a bare floor is in its own shadow: {len(shadowed(frame))} pixels")

plane = frames("plane")
for number, frame in enumerate(plane[:3]):
    check(not shadowed(frame), f"plane {number}: a bare plane is in its own shadow: {len(shadowed(frame))} pixels")
near, wide = shadowed(plane[3]), shadowed(plane[4])
check(len(near) > 20 and len(near ^ wide) < len(near) / 2,
      f"a box's shadow on a plane of 1e5 is that on one of 100: {len(near)}, {len(wide)}, {len(near ^ wide)} differ")

passes = frames("passes")
check(len(shadowed(passes[0])) > 100, f"lights at once: shadows of two boxes: {len(shadowed(passes[0]))} pixels")
for number, what in ((1, "under GL_EQUAL"), (2, "under GL_LEQUAL")):
    check(differing(passes[0], passes[number], "gl.") == 0, f"passes {number}: the same picture without shadows")
    differ = differing(passes[0], passes[number])
    check(differ == 0, f"lights one by one {what} equal all lights at once: {differ} pixels differ")
check(not shadowed(passes[3]), f"a transparent body casts no shadow by its depth: {len(shadowed(passes[3]))}")

sky = frames("sky")
GROUND = range(SIZE // 2, SIZE)
alone = shadowed(sky[0], GROUND)
check(10 < len(alone) < 1000, f"a box on a floor: {len(alone)} pixels in its shadow")
for number, what in ((1, "a sky before a clear of the depth"), (2, "a hand after one")):
    differ = shadowed(sky[number], GROUND) ^ alone
    check(not differ, f"{what} casts no shadow: {len(differ)} pixels differ")

globe = frames("globe")
BODIES = ("no globe", "twelve unlit strips", "a lit globe", "six faces of a lit box", "an unlit globe without normals")
for number, what in enumerate(BODIES):
    check(not shadowed(globe[number]), f"a lamp in {what} lights the floor: {len(shadowed(globe[number]))} in shadow")
check(20 < len(shadowed(globe[5])) < 5000, f"a globe beside the lamp casts a shadow: {len(shadowed(globe[5]))} pixels")
finish()
