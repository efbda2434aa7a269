#!/usr/bin/python3
"""replayed.py NAME [FIRST]: do a trace's pictures, replayed by apitrace, equal the program's own?

Compares every colour frame of NAME.ref, from frame FIRST on, pixel by pixel with `apitrace replay` of NAME.trace.
(FIRST is 2 for most programs: apitrace's first pictures are unreliable, because it resizes its window then.) Exits with
1 if a frame differs or there is none.
"""
import array
import ctypes
import os
import struct
import subprocess
import sys

REF_COLOR, REF_DEPTH, REF_CHANGED = 1, 2, 0x100
HEAD = struct.Struct("<IIIQQ")  # kind, width, height, frame, packed bytes: capture/format/ref.h


def unpack(packed, size):
    pixels = ctypes.create_string_buffer(size)
    got = ctypes.c_size_t(size)
    if ctypes.CDLL("libsnappy.so.1").snappy_uncompress(packed, ctypes.c_size_t(len(packed)), pixels, ctypes.byref(got)):
        sys.exit("a record of reference frames does not unpack")
    return pixels.raw


def changed(before, planes):
    """Pixels decoded from four planes of bytes, each stored as its change."""
    n = len(planes) // 4
    changes = bytearray(len(planes))
    for k in range(4):
        changes[k::4] = planes[k * n:(k + 1) * n]
    return (int.from_bytes(before, "little") ^ int.from_bytes(changes, "little")).to_bytes(len(planes), "little")


def records(path, wanted):
    """(frame, width, height, bytes with the bottom row first) of a .ref file's records of one kind."""
    with open(path, "rb") as stream:
        data = stream.read()
    at, last = 8, (0, b"")  # start of the last record of this kind, and its pixels
    while at + HEAD.size <= len(data):
        kind, width, height, frame, size = HEAD.unpack_from(data, at)
        begin, at = at, at + HEAD.size + size
        if kind & ~REF_CHANGED != wanted or at > len(data):
            continue
        block = data[begin + HEAD.size:at]
        if kind & REF_CHANGED:
            if int.from_bytes(block[:8], "little") != last[0]:
                sys.exit(f"frame {frame} of {path} is based on a record other than the last one of its kind")
            pixels = changed(last[1], unpack(block[8:], width * height * 4))
        else:
            pixels = unpack(block, width * height * 4)
        last = begin, pixels
        yield frame, width, height, pixels


def whole_record(kind, frame, width, height, pixels):
    """A record that contains all its pixels."""
    snappy = ctypes.CDLL("libsnappy.so.1")
    snappy.snappy_max_compressed_length.restype = ctypes.c_size_t
    size = ctypes.c_size_t(snappy.snappy_max_compressed_length(ctypes.c_size_t(len(pixels))))
    packed = ctypes.create_string_buffer(size.value)
    snappy.snappy_compress(pixels, ctypes.c_size_t(len(pixels)), packed, ctypes.byref(size))
    return HEAD.pack(kind, width, height, frame, size.value) + packed.raw[:size.value]


def reference_frames(path):
    """{frame: (width, height, RGB rows from the top)} of a .ref file."""
    frames = {}
    for frame, width, height, raw in records(path, REF_COLOR):
        rows = [raw[y * width * 4:(y + 1) * width * 4] for y in reversed(range(height))]
        rgb = bytearray(width * height * 3)
        flat = b"".join(rows)
        for channel in range(3):
            rgb[channel::3] = flat[channel::4]
        frames[frame] = (width, height, bytes(rgb))
    return frames


def reference_depths(path):
    """{frame: (width, height, window depths from the bottom)} of a .ref file."""
    return {frame: (width, height, array.array("f", raw)) for frame, width, height, raw in records(path, REF_DEPTH)}


def with_visual(bits, build):
    """Environment that gives glretrace a visual like the program's, from `bits` of the relume:bits marker: see
    verbs/recording/visual.c."""
    alpha, depth, stencil, _, samples = (bits.split() + ["0"] * 5)[:5]
    libraries = os.pathsep.join([str(build / "visual"), *filter(None, [os.environ.get("LD_LIBRARY_PATH")])])
    return dict(os.environ, LD_LIBRARY_PATH=libraries,
                RELUME_VISUAL=f"{alpha} {depth} {stencil} {samples}") if bits else dict(os.environ)


def replayed_frames(path):
    """The pictures of a trace, in order, as (width, height, RGB rows from the top)."""
    run = subprocess.run(["apitrace", "replay", "--headless", "-s", "-", path], stdout=subprocess.PIPE,
                         stderr=subprocess.DEVNULL, check=False)
    data, at, pictures = run.stdout, 0, []
    while True:
        start = data.find(b"P6\n", at)
        if start < 0:
            return pictures
        lines, at = [], start + 3
        while len(lines) < 2:  # size and largest value, with comments between
            end = data.index(b"\n", at)
            if not data[at:at + 1] == b"#":
                lines.append(data[at:end])
            at = end + 1
        width, height = map(int, lines[0].split())
        pictures.append((width, height, data[at:at + width * height * 3]))
        at += width * height * 3


def main(name, first):
    shown = reference_frames(name + ".ref")
    pictures = replayed_frames(name + ".trace")
    checked = bad = 0
    for frame, (width, height, rgb) in sorted(shown.items()):
        if frame < first:
            continue
        checked += 1
        if frame >= len(pictures):
            print(f"frame {frame}: not replayed")
            bad += 1
        elif pictures[frame] != (width, height, rgb):
            other = pictures[frame]
            differ = sum(other[2][i:i + 3] != rgb[i:i + 3]
                         for i in range(0, len(rgb), 3)) if other[:2] == (width, height) else "all"
            print(f"frame {frame}: {differ} of {width * height} pixels differ")
            bad += 1
    print(f"{checked} frames compared, {bad} differ")
    return 1 if bad or not checked else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 2))
