"""A reader for the OpenEXR files that tests examine: one part, scan lines, ZIP or uncompressed, half or float.

Follows the file layout document of openexr.com. It shares nothing with Relume's own reader and writer, so it is an
independent check of their files.
"""
import array
import struct
import sys
import zlib

LINES_PER_CHUNK = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP


def _string(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def _attributes(data):
    magic, version = struct.unpack_from("<II", data)
    if magic != 20000630 or version & ~0x4ff != 0:
        raise ValueError("not an EXR file of one scan-line part")
    at, found = 8, {}
    while data[at]:
        name, at = _string(data, at)
        _, at = _string(data, at)
        size, = struct.unpack_from("<i", data, at)
        found[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return found, at + 1


def _channels(chlist):
    """Names and pixel types (1 half, 2 float), in the file's order."""
    at, found = 0, []
    while chlist[at]:
        name, at = _string(chlist, at)
        kind, = struct.unpack_from("<i", chlist, at)
        found.append((name, kind))
        at += 16
    return found


def _unzip(packed):
    """Undo OpenEXR's ZIP: deflate over bytes split into even and odd ones, each stored as the difference from its
    predecessor.
    """
    raw = bytearray(zlib.decompress(packed))
    for i in range(1, len(raw)):
        raw[i] = (raw[i - 1] + raw[i] - 128) & 255
    half = (len(raw) + 1) // 2
    out = bytearray(len(raw))
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return bytes(out)


def attribute(path, name):
    """An attribute's bytes, without the pixels; None if missing."""
    with open(path, "rb") as file:
        return _attributes(file.read())[0].get(name)


class Image:
    def __init__(self, path, wanted=None):
        """Read a file; `wanted`: only these channels (skipping the others saves time)."""
        with open(path, "rb") as file:
            data = file.read()
        self.attributes, at = _attributes(data)
        x0, y0, x1, y1 = struct.unpack("<4i", self.attributes["dataWindow"])
        self.width, self.height = x1 - x0 + 1, y1 - y0 + 1
        channels = _channels(self.attributes["channels"])
        self.names = [name for name, _ in channels]
        self.planes = {name: [None] * self.height for name, _ in channels if wanted is None or name in wanted}
        compression = self.attributes["compression"][0]
        per_chunk = LINES_PER_CHUNK[compression]
        n_chunks = -(-self.height // per_chunk)
        for offset in struct.unpack_from(f"<{n_chunks}Q", data, at):
            y, size = struct.unpack_from("<ii", data, offset)
            lines = min(per_chunk, self.height - (y - y0))
            raw_size = lines * sum(self.width * (2 if kind == 1 else 4) for _, kind in channels)
            chunk = data[offset + 8:offset + 8 + size]
            self._take(chunk if size == raw_size else _unzip(chunk), y - y0, lines, channels)

    def _take(self, chunk, y, lines, channels):
        at = 0
        for line in range(y, y + lines):
            for name, kind in channels:
                size = self.width * (2 if kind == 1 else 4)
                if name in self.planes:
                    self.planes[name][line] = self._values(chunk[at:at + size], kind)
                at += size

    def _values(self, raw, kind):
        if kind == 1:
            return struct.unpack(f"<{self.width}e", raw)
        values = array.array("f" if kind == 2 else "I", raw)
        if sys.byteorder == "big":
            values.byteswap()
        return values

    def at(self, name, x, y):
        """The value of a channel; y counts from the top."""
        return self.planes[name][y][x]
