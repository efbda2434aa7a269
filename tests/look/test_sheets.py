#!/usr/bin/python3
# limit: 600 s
"""Sheets that must not block light, and shadows that the program draws itself: frames of tests/real/sheets.c."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import BUILD, SCRATCH, check, finish, record, render  # noqa: E402

CHANNELS = [f"{layer}{c}" for layer in ("", "gl.") for c in "RGB"]
SIZE = 100


def frames(kind):
    """The planes of each frame of a kind."""
    trace = SCRATCH / f"{kind}.trace"
    record(trace, BUILD / "tests/real/sheets", kind, options=())
    return [Image(f, CHANNELS).planes for f in render(trace, SCRATCH / kind)]


def differing(a, b, of_a="", of_b=""):
    """Pixels that differ by more than one 8-bit step."""
    return sum(any(abs(a[of_a + c][y][x] - b[of_b + c][y][x]) > 1 / 255 for c in "RGB")
               for y in range(SIZE) for x in range(SIZE))


for kind in ("window", "iso", "unseen"):
    alone, *others = frames(kind)
    shadow = differing(alone, alone, of_b="gl.")
    check(20 < shadow < SIZE * SIZE / 2, f"{kind}: the box alone casts a shadow: {shadow} pixels")
    for number, frame in enumerate(others, 1):
        check(differing(alone, frame, "gl.", "gl.") == 0, f"{kind} {number}: OpenGL shows nothing of the sheet")
        differ = differing(alone, frame)
        check(differ == 0, f"{kind} {number}: the sheet does not block light: {differ} pixels differ")

alone, same, other = frames("drawn")
check(differing(same, same, of_b="gl.") > 20, "the drawn shadow of OpenGL's light differs from the traced one")
differ = differing(alone, same)
check(differ == 0, f"the traced shadow replaces it: {differ} pixels differ")
differ = differing(other, other, of_b="gl.")
check(differ == 0, f"the shadow of another light is the only one: {differ} pixels differ from OpenGL's picture")
check(differing(alone, other, "gl.", "gl.") > 20, "the shadow of another light is visible")

*bodies, behind = frames("leaning")
for number, frame in enumerate(bodies, 1):
    check(sum(frame["gl.R"][y][x] > 0 for y in range(SIZE) for x in range(SIZE)) > 500, f"leaning {number} is lit")
    differ = differing(frame, frame, of_b="gl.")
    check(differ == 0,
          f"leaning {number}: a face turned away keeps OpenGL's light: {differ} pixels differ")
differ = differing(behind, behind, of_b="gl.")
check(differ > 500, f"a board in the way blocks the light: {differ} pixels differ")

# Ambient occlusion on boards a pixel or two wide is not noisy: few rays give nearly the same result as many.
trace = SCRATCH / "steps.trace"
record(trace, BUILD / "tests/real/sheets", "steps", options=())
few, many = (Image(render(trace, SCRATCH / f"steps{n}", "--look", "auto", "--rays", n)[0], CHANNELS).planes
             for n in (16, 1024))
lit = [(x, y) for y in range(SIZE) for x in range(SIZE) if many["gl.B"][y][x] > 0]
dark = sum(many["B"][y][x] < 0.8 * many["gl.B"][y][x] for x, y in lit)
off = sum(abs(few["B"][y][x] ** (1 / 2.4) - many["B"][y][x] ** (1 / 2.4)) > 16 / 255 for x, y in lit)
check(dark > 0.2 * len(lit), f"boards shade each other: {dark} of {len(lit)} pixels")
check(off <= 0.2 * len(lit),
      f"few and many occlusion rays: {off} of {len(lit)} pixels differ by more than 16 of 255")
finish()
