#!/usr/bin/python3
"""Cryptomatte of draws, meshes and textures: numbers and manifest as specified, mattes compared with channel id."""
import json
import struct

from exr import Image
from helpers import SCRATCH, check, corpus, finish, must, record, relume


def murmur(text):
    """MurmurHash3_x86_32, seed 0, after A. Appleby."""
    data, h, mask = text.encode(), 0, 0xffffffff

    def rotate(x, bits):
        return (x << bits | x >> (32 - bits)) & mask

    def mix(k):
        return rotate(k * 0xcc9e2d51 & mask, 15) * 0x1b873593 & mask
    whole = len(data) // 4 * 4
    for i in range(0, whole, 4):
        h = (rotate(h ^ mix(int.from_bytes(data[i:i + 4], "little")), 13) * 5 + 0xe6546b64) & mask
    if data[whole:]:
        h ^= mix(int.from_bytes(data[whole:], "little"))
    h ^= len(data)
    h = (h ^ h >> 16) * 0x85ebca6b & mask
    h = (h ^ h >> 13) * 0xc2b2ae35 & mask
    return h ^ h >> 16


def number(name):
    """The specification's adjustment of a hash to a finite float."""
    h = murmur(name)
    return h ^ 1 << 23 if h >> 23 & 255 in (0, 255) else h


def bits(value):
    return struct.unpack("<I", struct.pack("<f", value))[0]


check([murmur(t) for t in ("", "hello", "hello, world", "The quick brown fox jumps over the lazy dog")] ==
      [0, 0x248bfa47, 0x149bbb7f, 0x2e4ff723], "known hashes")

trace = SCRATCH / "still.trace"
record(trace, corpus("still_life"), "--frames", "1", options=())
must(relume("render", trace, "-o", SCRATCH / "all.####.exr", "--aov", "cryptomatte"))
must(relume("render", trace, "-o", SCRATCH / "few.####.exr", "--aov", "gl,cryptomatte"))
must(relume("render", trace, "-o", SCRATCH / "plain.####.exr"))
image, few, plain = (Image(SCRATCH / f"{name}.0000.exr") for name in ("all", "few", "plain"))
added = {f"{layer}00.{c}" for layer in ("CryptoDraw", "CryptoMesh", "CryptoTexture") for c in "RGBA"}
check(set(image.names) == set(plain.names) | added, f"with all other channels: {set(image.names) ^ set(plain.names)}")
check(added | {"id", "gl.R", "R"} <= set(few.names) and "N.X" not in few.names, f"beyond those requested: {few.names}")
check(all(image.planes[name] == plain.planes[name] for name in plain.names), "the requested ones are the same")

scene = json.loads(must(relume("scene", trace, "--json", "--frame", "0")).stdout)
hashes = {kind: {thing["hash"] for thing in scene[kind]} for kind in ("meshes", "textures")}
seen = {}
for layer, known in (("CryptoDraw", None), ("CryptoMesh", hashes["meshes"]), ("CryptoTexture",
                                                                              hashes["textures"] | {"untextured"})):
    key = f"cryptomatte/{murmur(layer):08x}"[:-1]
    text = {
        word: image.attributes.get(f"{key}/{word}", b"").decode() for word in ("name", "hash", "conversion", "manifest")
    }
    check((text["name"], text["hash"], text["conversion"]) == (layer, "MurmurHash3_32", "uint32_to_float32"),
          f"{layer}: {text}")
    manifest = json.loads(text["manifest"])
    check(manifest and all(int(h, 16) == number(name) for name, h in manifest.items()),
          f"{layer}: names and their numbers")
    check(known is None or set(manifest) <= known, f"{layer}: {set(manifest) - (known or set())} are in no scene")
    names = {int(h, 16): name for name, h in manifest.items()}
    wrong = pixels = 0
    for ids, numbers, covered in zip(image.planes["id"], image.planes[f"{layer}00.R"], image.planes[f"{layer}00.G"]):
        for i, h, g in zip(ids, numbers, covered):
            pixels += i != 0
            if i == 0:
                wrong += h != 0 or g != 0
            else:
                name = names.get(bits(h))
                wrong += g != 1 or name is None or seen.setdefault(
                    (layer, i), name) != name or (known is None and name != f"draw {int(i)}")
    check(wrong == 0 and pixels > 10000, f"{layer}: {wrong} pixels wrong of {pixels}")
    check({name for (of, _), name in seen.items() if of == layer} == set(manifest),
          f"{layer}: the manifest names visible objects")
check(len({name for (layer, _), name in seen.items() if layer == "CryptoMesh"}) > 2, "several meshes")
check(
    relume("render", trace, "-o", SCRATCH / "x.####.exr", "--aov", "cryptomate").returncode == 2,
    "an unknown word is refused")
check(relume("render", trace, "-o", SCRATCH / "x.####.png", "--aov", "cryptomatte").returncode == 2, "a PNG holds none")
finish()
