#!/usr/bin/python3
# limit: 500 s
"""Small programs of single calls and rare uses must be drawn as Mesa draws them, with no call omitted:
tests/real/small/, where each describes its subject. Arguments select programs by name.
"""
import sys

from exr import Image
from helpers import (
    AS_SHOWN, BUILD, SCRATCH, check, check_same_pictures, diff, finish, must, on_display, record, relume, render)

PROGRAMS = {
    "bare": ("lines", "a strip", "a wide loop", "points", "outlines"),
    "beyond": ("arrays", "indices", "colours of four", "all of a draw", "colours alone"),
    "asks": ("framebuffers", "shader objects", "texture objects of EXT", "one deleted"),
    "colors": tuple(f"seed {seed}" for seed in range(1, 13)),
    "condition": ("draws", "clears and pixels", "lists and arrays", "inverted"),
    "copied": ("swapped", "copied", "over it, in parts", "swapped again"),
    "core": ("linear", "encoded", "encoded and blended", "behind"),
    "copies": ("parts", "without alpha", "depths", "many of a large one"),
    "defines": ("without a version", "version 120"),
    "depthless": ("an object's picture", "over a quad", "one with depth"),
    "direct": ("matrices", "named textures", "units", "buffers and programs", "framebuffers"),
    "frustum": ("all orders", "seed 1", "seed 2", "seed 3"),
    "habits": ("lines' offset", "points' offset", "an offset to behind", "beside stipple",
               "beside stipple without gaps", "beside smooth points", "flags of a strip", "flags of a fan",
               "flags of a quad strip", "sprites left on", "blended ones", "by two filters", "a large rectangle",
               "a huge rectangle", "coordinates of 4 and 2", "a clip plane beside", "a clip plane through", "stipple",
               "by stages", "not by stages", "a list of arrays that is drawn at once", "one of indices",
               "one that is called", "a texel's edge", "a cube map without faces", "flags of elements",
               "no accumulation buffer"),
    "kept": ("alpha of quads", "alpha of triangles", "alpha by type", "alpha between", "a popped colour",
             "one with its lights", "a popped switch", "all popped", "bitmaps' normals",
             "blanks of fonts"),
    "layers": ("nearest", "linear", "levels", "parts", "one that is drawn to"),
    "listed": ("a small window", "a larger one", "executed at once", "a larger one still"),
    "open": ("a light that nothing attenuates", "a highlight without a power", "fog without length",
             "powers of programs", "known powers", "logarithms", "powers of shaders", "places between pixels",
             "an offset of EXT", "between faces of a cube", "filtered there", "a level there", "levels there"),
    "outward": ("far out", "hardly any w", "without w", "corners of different w", "a ground to the horizon"),
    "refused": ("after another", "alone", "blanks before it", "for vertices", "an option", "state",
                "an instruction", "another language"),
    "resized": ("as it was opened", "larger, without a viewport", "scissored clears", "pixels", "views of parts",
                "smaller", "another window", "that one smaller"),
    "fixed": ("a uniform", "numbers", "by a function", "before a condition", "after one", "state", "an element",
                "a column", "a component chosen", "a product", "under a condition"),
    "summed": ("colours", "numbers", "a product", "a large load", "sums that fit"),
    "srgb": ("shades", "blends", "pixels", "lit and textured", "through sRGB", "through a plain texture",
             "through floats", "a pushed switch"),
    "ties": ("a current colour", "the vertices' colour", "in a list", "a list's current colour", "an array",
             "set after a few vertices", "set after many", "clipped triangles", "lit", "textured", "other colours",
             "flat", "a second colour", "w of 3", "points"),
    "valleys": ("lit from the front",),
}

for name in sys.argv[1:] or PROGRAMS:
    done = on_display(BUILD / f"tests/real/small/{name}")
    if done.returncode == 77:
        print(f"small/{name} is {(done.stdout + done.stderr).strip().splitlines()[-1]}")
        continue
    trace, _ = check_same_pictures(f"small/{name}", PROGRAMS[name])
    done = must(relume("info", trace))
    check("not supported" not in done.stdout, f"{name}: nothing is left out: {done.stdout}")
    check(("core profile" in done.stdout) == (name == "core"), f"{name}: the profile: {done.stdout}")

if not sys.argv[1:]:
    trace = SCRATCH / "unended.trace"
    said = record(trace, BUILD / "tests/real/small/unended", options=("--ref", "color,depth")).stderr
    for what in "between glBegin and glEnd", "while a display list is made":
        check(f"a frame ends {what}; such frames get no reference frames" in said,
              f"the recorder says why frames lack pixels: {said}")
    render(trace, SCRATCH / "unended", *AS_SHOWN)
    _, score = diff(trace, SCRATCH / "unended")
    outcomes = [frame["outcome"] for frame in score["frames"]]
    check(outcomes == ["extra", "passed", "extra", "passed"],
          f"frames without readable pixels have no reference: {outcomes}")
    trace = SCRATCH / "lacking.trace"
    record(trace, BUILD / "tests/real/small/lacking", options=())
    said = must(relume("info", trace)).stdout
    check("glBegin: a shader reads or writes gl_ClipDistance, which is not supported" in said,
          f"the draw and the name are reported: {said}")
    for name in "glBindTexture", "glTexImage3D", "glTexParameteri":
        check(f"{name}: texture targets of later GL" in said, f"features that Relume lacks: {name}: {said}")
    check("GL errors" not in said, f"the program is not blamed: {said}")
    trace = SCRATCH / "valleys.trace"
    for file in render(trace, SCRATCH / "valleys") if trace.exists() else ():
        planes = Image(file, ["id", "shadow.G"]).planes
        dark = sum(i > 0 and s < 0.99
                   for ids, shadows in zip(planes["id"], planes["shadow.G"])
                   for i, s in zip(ids, shadows))
        check(not dark, f"places that the light sees like the viewer: {dark} pixels are in shadow")
    trace = SCRATCH / "outward.trace"
    files = render(trace, SCRATCH / "outward", "-f", "2-4")
    _, score = diff(trace, SCRATCH / "outward", "-f", "2-4")
    check(all(frame["outcome"] == "passed" for frame in score["frames"]),
          f"traced with vertices without w: {score['frames']}")
    mixed, ground = (Image(f, ["P.Y", "P.Z", "id", "shadow.G"]).planes for f in files[1:])
    off = [
        abs(mixed["P.Z"][y][x] + 4 + (mixed["P.Y"][y][x] + 3) / 6)
        for y in range(48)
        for x in range(64)
        if mixed["id"][y][x]
    ]
    check(
        len(off) > 500 and max(off) < 1e-4,
        f"positions between vertices of different w: {len(off)} pixels, at most {max(off)} off")
    dark = [ground["P.Z"][y][x] for y in range(48) for x in range(64) if ground["shadow.G"][y][x] < 0.5]
    check(
        len(dark) > 20 and all(-6.5 < z < -3.5 for z in dark),
        f"a board's shadow on a ground to the horizon: {len(dark)} pixels, {dark[:4]}")
finish()
