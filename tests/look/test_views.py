#!/usr/bin/python3
# limit: 300 s
"""Cameras beyond projection matrices (look/camera/lens.h): panoramas, cubes and stereo pairs show the same as a pinhole
from the same place; a lens blurs everything except the distance in focus. Errors in files give one line each."""
import math
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, finish, record, relume, render  # noqa: E402

N = 120
trace = SCRATCH / "hall.trace"
record(trace, corpus("hall"), "--frames", 2, "--size", "160x120", options=())


def see(name, text, *options):
    """Planes of frame 1 through a camera."""
    camera = SCRATCH / f"{name}.yaml"
    camera.write_text(text)
    planes = Image(render(trace, SCRATCH / name, "-f", 1, "--camera", camera, *options)[0]).planes
    return {plane: numpy.asarray(values) for plane, values in planes.items()}


def picture(planes):
    return numpy.stack([planes[c] for c in "RGB"], axis=-1)


straight = see("pinhole", f"kind: pinhole\nfield_of_view: 90\nsize: [{N}, {N}]\n")
around = see("cube", f"kind: cube\nsize: [{3 * N}, {2 * N}]\n")
pinhole, cube = picture(straight), picture(around)
front = cube[:N, N:2 * N]
# grain of textures differs: rays choose mipmap levels by distance, a projection by its pixels
places = [abs(around[f"P.{c}"][:N, N:2 * N] - straight[f"P.{c}"]) / -straight["P.Z"].clip(max=-1) for c in "XYZ"]
off = numpy.mean(numpy.max(places, axis=0) > 1e-3)
check(off < 0.01, f"a cube's front shows the same places as a 90-degree pinhole: {100 * off:.2f} % differ")
off = float(numpy.median(abs(front - pinhole)))
check(off < 0.02, f"a cube's front shows the same colours: {off:.4f} in the median")
seams = {"left": (cube[:N, N - 1], cube[:N, N]), "right": (cube[:N, 2 * N - 1], cube[:N, 2 * N]),
         "down": (cube[N, :N], front[N - 1]), "up": (cube[2 * N - 1, 2 * N:], front[0])}
for side, (one, other) in seams.items():
    apart, along = numpy.mean(abs(one - other)), numpy.mean(abs(front[:, 1:] - front[:, :-1]))
    check(apart < 2 * along, f"{side} meets the front: {apart:.4f} across the edge, {along:.4f} between pixels")

# Each pixel of the pinhole, looked up in the panorama by its two angles.
panorama = picture(see("panorama", f"kind: panorama\nsize: [{8 * N}, {4 * N}]\n"))
middle = (numpy.arange(N) + 0.5) / N * 2 - 1
a, b = numpy.meshgrid(middle, -middle)
x = (numpy.arctan(a) / (2 * math.pi) + 0.5) * 8 * N - 0.5
y = (0.5 - numpy.arctan(b / numpy.sqrt(1 + a * a)) / math.pi) * 4 * N - 0.5
x0, y0 = numpy.floor(x).astype(int), numpy.floor(y).astype(int)
s, t = (x - x0)[..., None], (y - y0)[..., None]
found = ((1 - s) * (1 - t) * panorama[y0, x0] + s * (1 - t) * panorama[y0, x0 + 1] +
         (1 - s) * t * panorama[y0 + 1, x0] + s * t * panorama[y0 + 1, x0 + 1])
off = float(numpy.median(abs(found - pinhole)))
check(off < 0.01, f"the panorama's middle equals a pinhole's picture: {off:.4f} in the median")

# A point of the left eye's picture, looked up in the right eye's.
EYES, CONVERGE, FOV = 0.25, 6, 60
WIDE, HIGH = 400, 150
stereo = see(
    "stereo",
    f"kind: stereo\neyes: {EYES}\nconverge: {CONVERGE}\nfield_of_view: {FOV}\nsize: [{WIDE}, {HIGH}]\n")
points = numpy.stack([stereo[f"P.{c}"] for c in "XYZ"], axis=-1)
half = WIDE // 2
units = 2 * math.tan(math.radians(FOV / 2)) / HIGH * CONVERGE  # per pixel, at the screen
errors = []
for row in range(HIGH * 2 // 3, HIGH, 5):  # the floor
    for column in range(20, half - 20, 7):
        at = points[row, column]
        if not at[2] < -1:
            continue
        there = 0.5 * EYES + (at[0] - 0.5 * EYES) * CONVERGE / -at[2]
        expected = there / units + 0.5 * half - 0.5
        low = math.floor(expected)
        if not 0 <= low < half - 1:
            continue
        left, right = points[row, half + low], points[row, half + low + 1]
        if abs(left[2] - at[2]) + abs(right[2] - at[2]) > 0.02 * -at[2]:
            continue  # hidden by another object
        errors.append(abs((expected - low) - (at[0] - left[0]) / (right[0] - left[0])))
check(len(errors) > 100, f"points visible to both eyes: {len(errors)}")
check(numpy.median(errors) < 0.1, f"points are where the other eye sees them: {numpy.median(errors):.3f} pixels off")

both = picture(see("around", f"kind: panorama\neyes: {EYES}\nsize: [{2 * N}, {2 * N}]\n"))
differ = numpy.mean(abs(both[:N] - both[N:]).max(axis=-1) > 8 / 255)
check(0.05 < differ < 0.9, f"each eye has its panorama: {100 * differ:.0f} % differ")

# Depth of field: objects in focus are sharp, others are blurred.
sharp = see("sharp", f"field_of_view: 60\nsize: [{N}, {N}]\n")
blurred = see("blurred", f"field_of_view: 60\naperture: 0.2\nfocus: 5\nsize: [{N}, {N}]\n", "--samples", 64)
distance = -sharp["P.Z"]
change = abs(picture(sharp) - picture(blurred)).max(axis=-1)
near, far = (float(numpy.mean(change[part]))
             for part in (abs(distance - 5) < 0.4, (distance > 12) & (distance < 1e3)))
check(far > 1.5 * near, f"more changes out of focus: {near:.4f} at its distance, {far:.4f} far off")

for what, text, words in (
    ("no such kind", "kind: fisheye\n", "panorama"), ("no eyes", "kind: stereo\n", "eyes"),
    ("eyes of a pinhole", "eyes: 0.1\n", "eyes"), ("no focus", "aperture: 0.1\n", "focus"),
    ("a lens without perspective", "kind: orthographic\naperture: 0.1\nfocus: 3\n", "pinhole"),
    ("an angle of a panorama", "kind: panorama\nfield_of_view: 40\n", "field_of_view")):
    (SCRATCH / "wrong.yaml").write_text(text)
    done = relume("render", trace, "-f", 1, "--camera", SCRATCH / "wrong.yaml", "-o", SCRATCH / "wrong.exr")
    ours = [line for line in done.stderr.splitlines() if line.startswith("relume: ")]
    check(done.returncode == 3 and len(ours) == 1 and words in ours[0], f"{what}: {done.stderr}")
(SCRATCH / "wrong.yaml").write_text("kind: cube\n")
done = relume("render", trace, "-f", 1, "--camera", SCRATCH / "wrong.yaml", "--mode", "gl", "-o", SCRATCH / "wrong.exr")
check(done.returncode == 2 and "mode gl" in done.stderr, f"a mode without rays: {done.stderr}")
finish()
