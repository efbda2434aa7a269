#!/usr/bin/python3
# limit: 400 s
"""The Cornell box: every gate on every frame, geometrically correct shadows, and a mirror with the right reflection."""
import math

from exr import Image
from helpers import SCRATCH, check, check_gates, corpus, diff, finish, record, render

WIDTH, HEIGHT = 800, 600
EYE, LIGHT, FLOOR = (0.0, 0.0, 3.6), (0.0, 0.85, 0.0), -1.0
# x, z, half width, height, rotation in degrees: as in corpus/cornell.c
BOXES = ((-0.35, -0.35, 0.3, 1.2, 18), (0.37, 0.3, 0.3, 0.6, -17))


def segment_meets_box(a, b, box):
    """Whether the segment from a to b passes through a box (slab test in the box's own frame)."""
    x, z, half, height, turn = box
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))

    def local(p):
        dx, dz = p[0] - x, p[2] - z
        return (c * dx - s * dz, p[1] + 1, s * dx + c * dz)

    start, end = local(a), local(b)
    near, far = 0.0, 1.0
    for k, (low, high) in enumerate(((-half, half), (0, height), (-half, half))):
        d = end[k] - start[k]
        if abs(d) < 1e-12:
            if not low < start[k] < high:
                return False
            continue
        t0, t1 = sorted(((low - start[k]) / d, (high - start[k]) / d))
        near, far = max(near, t0), min(far, t1)
    return near < far - 1e-9


def floor_point(x, y):
    """The point of the floor seen through a pixel centre, or None."""
    tangent = math.tan(math.radians(45) / 2)
    direction = ((2 * (x + 0.5) / WIDTH - 1) * tangent * WIDTH / HEIGHT, (1 - 2 * (y + 0.5) / HEIGHT) * tangent, -1.0)
    if direction[1] >= 0:
        return None
    t = (FLOOR - EYE[1]) / direction[1]
    p = tuple(EYE[k] + t * direction[k] for k in range(3))
    return p if abs(p[0]) < 1 and abs(p[2]) < 1 else None


def expected_shadow(x, y):
    """True in shadow, False in light, None if the pixel does not show the floor."""
    p = floor_point(x, y)
    if p is None or any(segment_meets_box(EYE, p, box) for box in BOXES):
        return None
    return any(segment_meets_box(p, LIGHT, box) for box in BOXES)


def check_shadow(path):
    image = Image(path, {"shadow.G", "gl.G"})
    first_row = HEIGHT // 2
    expected = [[expected_shadow(x, y) for x in range(WIDTH)] for y in range(first_row, HEIGHT)]
    wrong = lit = dark = 0
    for y in range(first_row + 1, HEIGHT - 1):
        for x in range(1, WIDTH - 1):
            around = {expected[y - first_row + dy][x + dx] for dy in (-1, 0, 1) for dx in (-1, 0, 1)}
            if len(around) != 1 or around == {None}:
                continue  # not the floor, or within a pixel of the shadow's edge
            in_shadow = around == {True}
            dark, lit = dark + in_shadow, lit + (not in_shadow)
            wrong += (image.at("shadow.G", x, y) < 0.9) != in_shadow
    check(dark > 2000 and lit > 20000, f"the floor is partly in shadow: {dark} dark and {lit} lit pixels")
    check(wrong == 0, f"{wrong} of {dark + lit} floor pixels are lit or dark against the geometry")


for name, options in (("camera", ["--animate", "camera"]), ("light", ["--animate", "light"]), ("vbo", ["--vbo"])):
    trace = SCRATCH / f"{name}.trace"
    record(trace, corpus("cornell"), "--frames", "4", *options)
    files = render(trace, SCRATCH / name)
    check(len(files) == 4, f"{name}: {len(files)} frames of 4")
    code, score = diff(trace, SCRATCH / name)
    check(code == 0, f"{name}: relume diff exits with {code}")
    check_gates(score, 4, name)
check_shadow(SCRATCH / "vbo" / "vbo.0003.exr")

plain, mirror = SCRATCH / "plain.trace", SCRATCH / "mirror.trace"
record(plain, corpus("cornell"), "--frames", "2")
record(mirror, corpus("cornell"), "--frames", "2", "--mirror")
wanted = {"R", "B", "gl.R", "gl.B", "reflect.G"}
before = Image(render(plain, SCRATCH / "plain", "-f", "1")[0], wanted)
after = Image(render(mirror, SCRATCH / "mirror", "-f", "1")[0], wanted)


def reflecting(image):
    return [(x, y) for y in range(HEIGHT) for x in range(WIDTH) if image.at("reflect.G", x, y) > 0.02]


check("reflect.G" not in before.names or not reflecting(before), "nothing reflects without the mirror")
spots = reflecting(after)
check(len(spots) > 3000, f"the mirror shows something: {len(spots)} pixels")
check(all(x < WIDTH / 2 for x, _ in spots), "only the left wall reflects")
check(before.planes["gl.R"] == after.planes["gl.R"], "the mirror does not change OpenGL's picture")


def display(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def mirrored(channel, x, y):
    """The reflected colour: a tenth of the pixel is the wall itself, mixed in display codes."""
    return (display(after.at(channel, x, y)) - 0.1 * display(after.at(f"gl.{channel}", x, y))) / 0.9


# From here the mirror shows the back wall, the floor and the boxes, all grey; the wall itself is red.
tinted = sum(abs(mirrored("R", x, y) - mirrored("B", x, y)) > 0.05 for x, y in spots)
check(tinted <= len(spots) // 1000,
      f"the mirror shows the grey of the room: {tinted} of {len(spots)} pixels are tinted")
finish()
