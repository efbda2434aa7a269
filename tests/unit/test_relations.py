#!/usr/bin/python3
# limit: 240 s
"""relume diff on pairs of pictures whose verdict is known: a picture and a changed version of it. Pictures are
generated from a seed; each relation is tried in both directions, with either one as the reference. All pairs are frames
of one run for each set of options.
"""
import collections
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy

RELUME = os.environ.get("RELUME", "build/relume")
SEEDS, WIDTH, HEIGHT = (1, 2, 3), 60, 44
PASS, FAIL, EITHER = {"passed"}, {"failed"}, {"passed", "failed"}

# --- Files ----------------------------------------------------------------------------------------------------------


def write_png(path, codes, depth=8, level=6):
    """Codes [height][width][1 to 4] of 8 or 16 bits."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width, n = codes.shape
    rows = b"".join(b"\0" + numpy.ascontiguousarray(row.astype(">u2" if depth == 16 else "u1")).tobytes()
                    for row in codes)
    head = struct.pack(">IIBBBBB", width, height, depth, {1: 0, 2: 4, 3: 2, 4: 6}[n], 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, level)) +
                     chunk(b"IEND", b""))


def write_exr(path, planes, at=(0, 0), shown=None, in_tile=False):
    """Planes {name: [height][width], half, float or uint32} as an uncompressed OpenEXR file. at: first pixel of the
    data window; shown: x, y, width and height of the display window, or None for that of the data; in_tile: store
    everything as one tile.
    """
    types = {"uint32": 0, "float16": 1, "float32": 2}
    names = sorted(planes)
    height, width = planes[names[0]].shape
    x, y, w, h = shown or (*at, width, height)
    channels = b"".join(name.encode() + b"\0" + struct.pack("<iB3xii", types[planes[name].dtype.name], 0, 1, 1)
                        for name in names) + b"\0"
    header = (("channels", "chlist", channels), ("compression", "compression", b"\0"),
              ("dataWindow", "box2i", struct.pack("<4i", *at, at[0] + width - 1,
                                                  at[1] + height - 1)), ("displayWindow", "box2i",
                                                                         struct.pack("<4i", x, y, x + w - 1,
                                                                                     y + h - 1)),
              ("lineOrder", "lineOrder", b"\0"), ("pixelAspectRatio", "float", struct.pack("<f", 1)),
              ("screenWindowCenter", "v2f", bytes(8)), ("screenWindowWidth", "float", struct.pack("<f", 1)))
    header += (("tiles", "tiledesc", struct.pack("<IIB", width, height, 0)),) if in_tile else ()
    out = struct.pack("<II", 20000630, 0x202 if in_tile else 2) + b"".join(
        f"{name}\0{kind}\0".encode() + struct.pack("<i", len(value)) + value for name, kind, value in header) + b"\0"
    lines = [b"".join(numpy.ascontiguousarray(planes[name][row]).tobytes() for name in names) for row in range(height)]
    if in_tile:
        path.write_bytes(out + struct.pack("<Q4iI", len(out) + 8, 0, 0, 0, 0, len(b"".join(lines))) + b"".join(lines))
        return
    first = len(out) + 8 * height
    table = struct.pack(f"<{height}Q", *(first + row * (8 + len(lines[0])) for row in range(height)))
    path.write_bytes(out + table +
                     b"".join(struct.pack("<ii", at[1] + row, len(line)) + line for row, line in enumerate(lines)))


def converted(source, path, *options):
    """The same written by oiiotool, for formats that we do not write."""
    subprocess.run(["oiiotool", source, *options, "-o", path], check=True, capture_output=True)


# --- Pictures -------------------------------------------------------------------------------------------------------


def codes_of(seed, n=3):
    """A picture of codes: a gradient, noise, shapes with plain colours; with n = 4 also alpha from 0 to 255."""
    random = numpy.random.default_rng(seed)
    y, x = numpy.mgrid[0:HEIGHT, 0:WIDTH]
    out = numpy.stack([40 + 2 * x, 30 + 3 * y, 200 - x - y][:3], -1).astype(int)
    out[:, 40:] += random.integers(0, 30, (HEIGHT, WIDTH - 40, 1))
    for _ in range(4):
        left, top = random.integers(0, WIDTH - 16), random.integers(0, HEIGHT - 14)
        out[top:top + 10, left:left + 12] = random.integers(20, 236, 3)
    if n == 4:
        alpha = numpy.clip(255 * (x - 8) // 40, 0, 255)
        out = numpy.concatenate((out, alpha[..., None]), -1)
    return numpy.clip(out, 0, 255)


def light_of(codes):
    v = codes / 255
    return numpy.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def planes_of(values, dtype="f4", prefix=""):
    return {prefix + "RGBA"[c]: values[..., c].astype(dtype) for c in range(values.shape[-1])}


def bright_of(seed):
    """Linear light up to 500 times white."""
    return light_of(codes_of(seed)) * numpy.where(numpy.mgrid[0:HEIGHT, 0:WIDTH][1] < 20, 500, 1)[..., None]


def changed(values, patch, by):
    out = numpy.array(values)
    out[patch] = by(out[patch])
    return out


EXTRA_PART = ("--create", "20x10+5+6", "1", "--fullsize", f"{WIDTH}x{HEIGHT}+0+0", "--chnames", "extra.Y", "--attrib",
              "oiio:subimagename", "extra")
PATCH = (slice(10, 30), slice(12, 34))
Case = collections.namedtuple(
    "Case", "name verdict write_a write_b")  # the writers take a path without ending, and return the complete one


def png(codes, **how):
    def write(path):
        write_png(path.with_suffix(".png"), numpy.asarray(codes), **how)
    return write


def exr(values, dtype="f4", prefix="", more=None, **where):
    def write(path):
        write_exr(path.with_suffix(".exr"), {**planes_of(values, dtype, prefix), **(more or {})}, **where)
    return write


def by_oiio(writer, ending, *options):
    def write(path):
        with tempfile.TemporaryDirectory() as folder:
            writer(pathlib.Path(folder) / "from")
            source, = pathlib.Path(folder).iterdir()
            converted(source, path.with_suffix("." + ending), *options)
    write.is_slow = True
    return write


# --- Relations ------------------------------------------------------------------------------------------------------


def of_codes(seed):
    """8 bits without alpha."""
    a = codes_of(seed)
    base = png(a)
    for name, verdict, b in (("the same", PASS, base), ("padded on the right", FAIL,
                                                        png(numpy.pad(a, ((0, 0), (0, 1), (0, 0))))),
                             ("padded all around", FAIL, png(numpy.pad(a, ((3, 3), (5, 5), (0, 0))))),
                             ("cropped by a row", FAIL, png(a[1:])), ("cropped to its middle", FAIL, png(a[8:-8,
                                                                                                           8:-8])),
                             ("moved by 1,0", FAIL, png(numpy.roll(a, 1,
                                                                   1))), ("moved by 0,2", FAIL, png(numpy.roll(a, 2,
                                                                                                               0))),
                             ("moved by 5,3, edges repeated", FAIL,
                              png(numpy.pad(a, ((3, 0), (5, 0), (0, 0)),
                                            "edge")[:HEIGHT, :WIDTH])), ("mirrored", FAIL, png(a[:, ::-1])),
                             ("upside down", FAIL, png(a[::-1])), ("red and blue swapped", FAIL, png(a[..., ::-1])),
                             ("green and blue swapped", FAIL, png(a[..., [0, 2, 1]])), ("its grey", FAIL,
                                                                                        png(a.mean(2, keepdims=True))),
                             ("opaque alpha added", PASS,
                              png(numpy.concatenate(
                                  (a, numpy.full((HEIGHT, WIDTH, 1), 255)),
                                  2))), ("alpha of a half added", FAIL,
                                         png(numpy.concatenate((a, numpy.full((HEIGHT, WIDTH, 1), 128)), 2))),
                             ("alpha 0 in a patch", FAIL,
                              png(
                                  changed(numpy.concatenate((a, numpy.full((HEIGHT, WIDTH, 1), 255)), 2), (*PATCH, 3),
                                          lambda v: 0 * v))), ("16 bits", PASS, png(a * 257, depth=16)),
                             ("16 bits, half a code off", PASS,
                              png(numpy.clip(a * 257 + 120, 0, 65535),
                                  depth=16)), ("16 bits, four codes off", FAIL,
                                               png(numpy.clip(a * 257 + 4 * 257, 0, 65535),
                                                   depth=16)), ("4 bits of each channel", FAIL,
                                                                png(a & 0xf0)), ("one code off", PASS,
                                                                                 png(numpy.clip(a + 1, 0, 255))),
                             ("a patch of three codes off", FAIL,
                              png(changed(a, PATCH,
                                          lambda v: v + numpy.where(v < 128, 3, -3)))), ("packed not at all", PASS,
                                                                                         png(a, level=0)),
                             ("packed well",
                              PASS, png(a, level=9)), ("as TIFF, LZW", PASS, by_oiio(
                                  base, "tif", "--compression",
                                  "lzw")), ("as TIFF, packbits, tiles", PASS,
                                            by_oiio(base, "tif", "--compression", "packbits", "--tile", "16",
                                                    "16")), ("as TIFF of 16 bits", PASS,
                                                             by_oiio(base, "tif", "-d",
                                                                     "uint16")), ("as BMP", PASS, by_oiio(base, "bmp")),
                             ("as TGA", PASS, by_oiio(base, "tga")), ("as SGI", PASS, by_oiio(
                                 base,
                                 "sgi")), ("as lossy JPEG", FAIL,
                                           by_oiio(base, "jpg", "--compression",
                                                   "jpeg:5")), ("as linear light", PASS,
                                                                exr(light_of(a))), ("as linear light, twice as bright",
                                                                                    FAIL, exr(2 * light_of(a)))):
        yield Case(name, verdict, base, b)
    grey = a[..., :1]
    yield Case("grey as one channel and as three", PASS, png(grey), png(numpy.repeat(grey, 3, 2)))
    yield Case("grey and alpha as two channels and as four", PASS, png(codes_of(seed, 4)[..., [0, 3]]),
               png(codes_of(seed, 4)[..., [0, 0, 0, 3]]))


def of_alpha(seed):
    """8 bits with alpha."""
    a = codes_of(seed, 4)
    hidden = a.copy()
    hidden[..., :3] = numpy.where(a[..., 3:] == 0, 255 - a[..., :3], a[..., :3])
    black = changed(a, (*PATCH, slice(0, 3)), lambda v: 0 * v)
    exact = a / 255
    exact[..., :3] *= exact[..., 3:]
    times = a.copy()
    times[..., :3] = numpy.rint(255 * exact[..., :3])
    base = png(a)
    for name, verdict, one, b in (
        ("with alpha, the same", PASS, base, base),
        ("another colour under alpha 0", PASS, base, png(hidden)),
        ("alpha left out", FAIL, base, png(a[..., :3])),
        ("alpha opaque", FAIL, base, png(changed(a, (..., 3), lambda v: 0 * v + 255))),
        ("alpha turned", FAIL, base, png(changed(a, (..., 3), lambda v: 255 - v))),
        ("alpha of black alone", FAIL, png(black), png(changed(black, (*PATCH, 3), lambda v: 255 - v))),
        ("alpha one code off", PASS, base, png(changed(a, (..., 3), lambda v: numpy.clip(v + 1, 0, 255)))),
        ("alpha 16 codes off", FAIL, base, png(changed(a, (..., 3), lambda v: numpy.clip(v + 16, 0, 255)))),
        ("colour beside alpha", FAIL, base, png(changed(a, (slice(None), slice(30, 50), slice(0, 3)),
                                                        lambda v: 255 - v))),
        ("with alpha, 16 bits", PASS, base, png(a * 257, depth=16)),
        ("red and blue swapped, with alpha", FAIL, base, png(a[..., [2, 1, 0, 3]])),
        ("with alpha, as TGA", PASS, base,
         by_oiio(exr(exact), "tga")),  # from PNG, oiiotool 2.5 multiplies in linear light and divides codes
        ("straight and multiplied", PASS,
         by_oiio(exr(a / 255), "tif", "-d", "uint8", "--attrib", "oiio:UnassociatedAlpha",
                 "1"), by_oiio(exr(times / 255), "tif", "-d", "uint8")),
        ("multiplied twice", FAIL, base, png(times))):
        yield Case(name, verdict, one, b)


def of_light(seed):
    """Linear light as OpenEXR."""
    a, over = light_of(codes_of(seed)), bright_of(seed)
    base, high = exr(a), exr(over)
    wide = numpy.pad(a, ((4, 4), (6, 6), (0, 0)), "edge")
    ids = {"id": numpy.arange(HEIGHT * WIDTH, dtype="u4").reshape(HEIGHT, WIDTH)}
    for name, verdict, one, b in (
        ("half", PASS, base, exr(a, "f2")),
        ("data cropped", PASS, base,
         exr(a[5:30, 7:50], at=(7, 5),
             shown=(0, 0, WIDTH,
                    HEIGHT))), ("data cropped, and another colour there", FAIL, base,
                                exr(1 - a[5:30, 7:50], at=(7, 5),
                                    shown=(0, 0, WIDTH,
                                           HEIGHT))),
        ("data moved", FAIL, base,
         exr(a, at=(5, 3), shown=(0, 0, WIDTH, HEIGHT))), ("both windows moved", PASS, base, exr(
             a,
             at=(-20, 30))), ("overscan", PASS, base,
                              exr(wide, at=(-6, -4),
                                  shown=(0, 0, WIDTH,
                                         HEIGHT))), ("padded", FAIL, base,
                                                     exr(wide)),
        ("a larger display window", FAIL, base,
         exr(a,
             shown=(0, 0, WIDTH + 8, HEIGHT))),
        ("no pixel shown by both", FAIL, exr(a[:, :20], shown=(0, 0, WIDTH, HEIGHT)),
         exr(a[:, 30:], at=(30, 0),
             shown=(0, 0, WIDTH,
                    HEIGHT))), *((f"as {kind}", PASS, base, by_oiio(exr(a, "f2"), "exr", "--compression", kind))
                                 for kind in ("rle", "zip", "zips", "piz", "pxr24")),
            *((f"lossy, as {kind}", EITHER, base, by_oiio(exr(a, "f2"), "exr", "--compression", kind))
              for kind in ("b44", "b44a", "dwaa:100", "dwab:100")), ("tiles", PASS, base,
                                                                     by_oiio(base, "exr", "--tile", "16", "16")),
        ("tiles, piz, numbers", PASS, exr(a, more=ids),
         by_oiio(exr(a, more=ids), "exr", "--tile", "32", "32", "--compression",
                 "piz")), ("grey as Y", PASS, exr(numpy.repeat(a[..., :1], 3, 2)),
                           lambda path: write_exr(path.with_suffix(".exr"), {"Y": a[..., 0].astype("f4")})),
        ("an opaque alpha", PASS, base, exr(numpy.concatenate(
            (a, numpy.ones((HEIGHT, WIDTH, 1))),
            2))), ("alpha of a half", FAIL, base, exr(numpy.concatenate(
                (a, numpy.full((HEIGHT, WIDTH, 1), 0.5)),
                2))), ("a layer more", PASS,
                       base, exr(a, more=planes_of(1 - a,
                                                   prefix="other."))), ("red and blue swapped", FAIL, base,
                                                                        exr(a[..., ::-1])), ("black and a little below",
                                                                                             PASS, base, exr(a - 1e-4)),
        ("far below black", FAIL, exr(changed(a, PATCH, lambda v: 0 * v)),
         exr(changed(a, PATCH,
                     lambda v: 0 * v - 3))), ("over white, the same", PASS, high,
                                              high), ("over white, half", PASS, high,
                                                      exr(over, "f2")), ("over white, ten times", FAIL, high,
                                                                         exr(numpy.where(over > 1, 10 * over, over))),
        ("over white, a tenth", FAIL,
         high, exr(numpy.where(over > 10, over / 10,
                               over))), ("over white, one per cent", PASS, high,
                                         exr(numpy.where(over > 1, 1.01 * over,
                                                         over))), ("over white, five per cent", FAIL, high,
                                                                   exr(numpy.where(over > 1, 1.05 * over,
                                                                                   over))), ("clamped", FAIL, high,
                                                                                             exr(numpy.minimum(over,
                                                                                                               1))),
        ("over white as display codes", PASS, high,
         png(
             numpy.rint(
                 255 *
                 numpy.clip(numpy.where(over > 0.0031308, 1.055 * over**(1 / 2.4) - 0.055, 12.92 * over), 0, 1)))),
        ("over white as Radiance", PASS, exr(numpy.repeat(over[..., :1], 3, 2)),
         by_oiio(exr(numpy.repeat(over[..., :1], 3, 2)),
                 "hdr")), ("over white, ten times, as Radiance", FAIL, high,
                           by_oiio(exr(10 * over),
                                   "hdr")), ("over white as TIFF", PASS, high, by_oiio(high, "tif", "-d", "float")),
        ("no number in a patch", FAIL, base,
         exr(changed(a, PATCH, lambda v: v * numpy.nan))), ("infinite in a patch", FAIL, base,
                                                            exr(changed(a, PATCH, lambda v: v + numpy.inf)))):
        yield Case(name, verdict, one, b)


def of_layers(seed):
    """Layers by name, and single channels: the option selects them, and pictures agree or differ only there."""
    a = light_of(codes_of(seed))
    other = {**planes_of(1 - a, prefix="view.diffuse."), **planes_of(2 * a - 1, prefix="N.", dtype="f4")}
    other = {
        name.replace("N.R", "N.X").replace("N.G", "N.Y").replace("N.B", "N.Z"): plane for name, plane in other.items()
    }
    other["Z"] = (100 * a[..., 0] + 1).astype("f4")

    def edited(*names):
        return exr(a, more={**other, **{name: 0.5 * other[name] + 0.2 for name in names}})

    for option, names, others in (("view.diffuse", ["view.diffuse.G"], ["N.X",
                                                                        "Z"]), ("N", ["N.Z"], ["view.diffuse.R"]),
                                  ("Z", ["Z"], ["N.X"]), ("view.diffuse.R", ["view.diffuse.R"],
                                                          ["view.diffuse.G"]), ("beauty", [], ["Z", "N.X"])):
        parts = by_oiio(edited(), "exr", "--attrib", "oiio:subimagename", "main", *EXTRA_PART, "--siappend")
        yield option, Case("a part more, of another data window", PASS, edited(), parts)
        yield option, Case("the others changed", PASS, edited(), edited(*others))
        if names:
            yield option, Case("it changed", FAIL, edited(), edited(*names))


def drawn(relations):
    """The cases of all seeds; those written by another program, which is slow, for one seed only."""
    return [
        case for seed in SEEDS for case in relations(seed)
        if seed == SEEDS[0] or not getattr(case.write_b, "is_slow", False)
    ]


def of_numbers(seed):
    """Unsigned integers, as used for draw numbers, by both readers."""
    ids = {"id": numpy.arange(HEIGHT * WIDTH, dtype="u4").reshape(HEIGHT, WIDTH)}
    base = exr(light_of(codes_of(seed)), more=ids)
    yield Case("in a tile", PASS, base, exr(light_of(codes_of(seed)), more=ids, in_tile=True))
    yield Case("twice as large", FAIL, base, exr(light_of(codes_of(seed)), more={"id": 2 * ids["id"]}))


class Relations(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.dir = pathlib.Path(folder.name)

    def judge(self, cases, *options):
        """All cases as frames of two sets, in both directions; returns the wrong verdicts."""
        folders, wrong = [self.dir / "a", self.dir / "b"], []
        for folder, writers in zip(folders, zip(*((case.write_a, case.write_b) for case in cases))):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            for frame, write in enumerate(writers):
                write(folder / f"f{frame:04}")
        for way in (folders, folders[::-1]):
            done = subprocess.run([RELUME, "diff", *options, "--json", "-", *way], capture_output=True, text=True,
                                  timeout=120)
            found = {f["frame"]: f["outcome"] for f in json.loads(done.stdout)["frames"]}
            wrong += [
                f"{case.name}{' (the other way round)' if way != folders else ''}: {found.get(frame)}"
                for frame, case in enumerate(cases)
                if found.get(frame) not in case.verdict
            ]
        self.assertEqual(wrong, [], f"wrong among {2 * len(cases)} verdicts with {options}")
        print(" ".join((f"{2 * len(cases)} verdicts", *options)) + ": 0 wrong")

    def test_codes(self):
        self.judge(drawn(of_codes))

    def test_alpha(self):
        self.judge(drawn(of_alpha))

    def test_light(self):
        self.judge(drawn(of_light))

    def test_alpha_left_out(self):
        """With --ignore-alpha, alpha does not matter, but the colours behind it do."""
        wanted = {
            "with alpha, the same": PASS, "another colour under alpha 0": FAIL, "alpha left out": PASS,
            "alpha opaque": PASS, "alpha turned": PASS, "alpha of black alone": PASS, "colour beside alpha": FAIL,
            "multiplied twice": FAIL
        }
        self.judge([case._replace(verdict=wanted[case.name]) for case in drawn(of_alpha) if case.name in wanted],
                   "--ignore-alpha")

    def test_layers(self):
        for option in ("view.diffuse", "N", "Z", "view.diffuse.R", "beauty"):
            self.judge(drawn(lambda seed: (case for name, case in of_layers(seed) if name == option)), "--channel",
                       option)
        self.judge(drawn(of_numbers), "--channel", "id")

    def test_runs(self):
        """Differences between runs, also in alpha or over white, are noise; faults common to all are not."""
        seed, wanted = SEEDS[0], {}
        pictures = ((png, codes_of(seed, 4), (3,), lambda v: 255 - v), (exr, bright_of(seed), (), lambda v: 2 * v))
        with tempfile.TemporaryDirectory() as folder:
            folders = [pathlib.Path(folder) / name for name in ("ref", "run0", "run1", "run2")]
            for frame, (kind, values, of, by) in enumerate(picture for picture in pictures for _ in range(2)):
                for n, run in enumerate(folders):
                    rows = slice(4 + 10 * n, 10 + 10 * n) if frame % 2 == 0 else slice(4, 24)
                    run.mkdir(exist_ok=True)
                    kind(changed(values, (rows, slice(2, 16), *of), by) if n else values)(run / f"f{frame:04}")
                wanted[str(frame)] = "regression" if frame % 2 else "flaky"
            done = subprocess.run([RELUME, "diff", *folders], capture_output=True, text=True, timeout=120)
        self.assertEqual(dict(re.findall(r"^ +(\d+) (flaky|regression)", done.stdout, re.M)), wanted,
                         done.stdout + done.stderr)


if __name__ == "__main__":
    program = unittest.main(exit=False, failfast="RELUME_FIRST_FAILURE" in os.environ)
    failed = len(program.result.failures) + len(program.result.errors)
    # counts in libcheck's format, for the runner
    print(f"{100 if not failed else 0}%: Checks: {program.result.testsRun}, Failures: {failed}, Errors: 0")
    sys.exit(failed != 0)
