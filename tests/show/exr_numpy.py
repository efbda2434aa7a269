"""Read and write single-part scan-line OpenEXR files as numpy planes, preserving types and attributes; write PNG."""
import pathlib
import struct
import sys
import zlib

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import LINES_PER_CHUNK, _channels, _string  # noqa: E402

DTYPES = {1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}
COMPRESSIONS = {"none": 0, "zips": 2}


def _unzip(packed):
    raw = numpy.frombuffer(zlib.decompress(packed), "u1").astype("u1")
    raw = numpy.cumsum(raw - numpy.uint8(128), dtype="u1") + numpy.uint8(128)
    out = numpy.empty_like(raw)
    half = (len(raw) + 1) // 2
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return out.tobytes()


def _zip(raw):
    data = numpy.frombuffer(raw, "u1")
    data = numpy.concatenate((data[0::2], data[1::2]))
    steps = data.copy()
    steps[1:] = data[1:] - data[:-1] + numpy.uint8(128)
    packed = zlib.compress(steps.tobytes(), 4)
    return packed if len(packed) < len(raw) else raw


class Image:
    def __init__(self, path):
        self.path = pathlib.Path(path)
        data = self.path.read_bytes()
        magic, version = struct.unpack_from("<II", data)
        if magic != 20000630 or version & 0x1a00:
            raise ValueError("not an EXR file of one scan-line part")
        at, self.header = 8, {}
        while data[at]:
            name, at = _string(data, at)
            kind, at = _string(data, at)
            size, = struct.unpack_from("<i", data, at)
            self.header[name] = (kind, data[at + 4:at + 4 + size])
            at += 4 + size
        at += 1
        x0, y0, x1, y1 = struct.unpack("<4i", self.header["dataWindow"][1])
        width, height = x1 - x0 + 1, y1 - y0 + 1
        channels = _channels(self.header["channels"][1])
        self.planes = {name: numpy.zeros((height, width), DTYPES[kind]) for name, kind in channels}
        compression = self.header["compression"][1][0]
        if compression not in LINES_PER_CHUNK:
            raise ValueError("unsupported compression")
        per_chunk = LINES_PER_CHUNK[compression]
        for offset in struct.unpack_from(f"<{-(-height // per_chunk)}Q", data, at):
            y, size = struct.unpack_from("<ii", data, offset)
            lines = min(per_chunk, height - (y - y0))
            chunk = data[offset + 8:offset + 8 + size]
            raw_size = lines * sum(width * DTYPES[kind].itemsize for _, kind in channels)
            chunk, p = (chunk if size == raw_size else _unzip(chunk)), 0
            for line in range(y - y0, y - y0 + lines):
                for name, kind in channels:
                    n = width * DTYPES[kind].itemsize
                    self.planes[name][line] = numpy.frombuffer(chunk[p:p + n], DTYPES[kind])
                    p += n


def write(path, image, compression="none"):
    names = sorted(image.planes)
    height, width = image.planes[names[0]].shape
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    chlist = b"".join(
        n.encode() + b"\0" + struct.pack("<iB3xii", 1 if image.planes[n].dtype == DTYPES[1] else 2, 0, 1, 1)
        for n in names) + b"\0"
    header = dict(image.header, channels=("chlist", chlist), dataWindow=("box2i", window),
                  displayWindow=("box2i", window), compression=("compression", bytes([COMPRESSIONS[compression]])))
    out = bytearray(struct.pack("<II", 20000630, 2))
    for name, (kind, value) in header.items():
        out += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    out += b"\0"
    at, chunks, table = len(out) + 8 * height, [], []
    for y in range(height):
        raw = b"".join(numpy.ascontiguousarray(image.planes[n][y]).tobytes() for n in names)
        packed = _zip(raw) if compression == "zips" else raw
        table.append(at)
        chunks.append(struct.pack("<ii", y, len(packed)) + packed)
        at += len(chunks[-1])
    pathlib.Path(path).write_bytes(bytes(out) + struct.pack(f"<{height}Q", *table) + b"".join(chunks))


def write_png(path, codes):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width, _ = codes.shape
    rows = b"".join(b"\0" + numpy.ascontiguousarray(row).tobytes() for row in codes)
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" +
                                   chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                                   chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b""))
