#!/usr/bin/python3
"""Damage a trace in many ways, and check that `relume info` and `relume scene` handle it.

usage: mutate.py TRACE [COUNT [SEED [BYTES]]]

Bytes of the unpacked stream are flipped, removed, doubled and spliced, and the file itself is cut. Each run must end
within 10 s, within 1 GiB of address space more than the whole trace needs, and with exit code 0 or 3. A mutant that
fails is kept beside the trace as NAME.crash-N.
"""
import os
import pathlib
import random
import resource
import struct
import subprocess
import sys

RELUME = os.environ.get("RELUME", "build/relume")
SANITIZED = "san" in RELUME  # sanitizers make address space meaningless


def uint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            return value, at


def unpack_block(block):
    """One raw Snappy block."""
    size, at = uint(block, 0)
    out = bytearray()
    while at < len(block):
        tag = block[at]
        at += 1
        if tag & 3 == 0:
            n = tag >> 2
            if n >= 60:
                extra = n - 59
                n = int.from_bytes(block[at:at + extra], "little")
                at += extra
            out += block[at:at + n + 1]
            at += n + 1
            continue
        if tag & 3 == 1:
            n, distance = (tag >> 2 & 7) + 4, (tag >> 5) << 8 | block[at]
            at += 1
        else:
            width = 2 if tag & 3 == 2 else 4
            n, distance = (tag >> 2) + 1, int.from_bytes(block[at:at + width], "little")
            at += width
        for _ in range(n if distance < n else 0):
            out.append(out[-distance])
        if distance >= n:
            out += out[len(out) - distance:len(out) - distance + n]
    assert len(out) == size, "a damaged block"
    return out


def unpack(data, limit=None):
    assert data[:2] == b"at"
    at, out = 2, bytearray()
    while at + 4 <= len(data) and (limit is None or len(out) < limit):
        n, = struct.unpack_from("<I", data, at)
        out += unpack_block(data[at + 4:at + 4 + n])
        at += 4 + n
    return out


def pack(stream):
    """Literals only."""
    out = bytearray(b"at")
    for at in range(0, len(stream), 1 << 16):
        part = stream[at:at + (1 << 16)]
        size = len(part)
        head = bytes([size & 0x7F | 0x80, size >> 7 & 0x7F | 0x80, size >> 14])
        out += struct.pack("<I", len(head) + 3 + size) + head + b"\xf4" + struct.pack("<H", size - 1) + part
    return out


def damage(whole, rng):
    data = bytearray(whole)
    for _ in range(rng.choice((1, 1, 2, 5, 40))):
        at, n = rng.randrange(len(data)), rng.choice((1, 2, 8, 100, 5000))
        other = rng.randrange(len(data))
        kind = rng.randrange(6)
        if kind == 0:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            data[at] = rng.choice((0, 1, 0x7F, 0x80, 0xFF, rng.randrange(256)))
        elif kind == 2:
            del data[at:at + n]
        elif kind == 3:
            data[at:at] = data[other:other + n]
        elif kind == 4:
            data[at:at + n] = data[other:other + n]
        else:
            data[at:at + 4] = rng.choice((b"\xff\xff\xff\x7f", b"\xff\xff\xff\xff", b"\0\0\0\0", b"\x80\x80\x80\x80"))
        if not data:
            data = bytearray(b"\0")
    return data


def mutate(stream, rng):
    packed = pack(damage(stream, rng))
    return packed[:rng.randrange(len(packed))] if rng.random() < 0.1 else packed


def limit_memory():
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))


def run(path):
    """The fault of the runs on a file, or ""."""
    for verb in (["info", "--json"], ["scene", "-f", "3", "--json"]):
        try:
            done = subprocess.run([RELUME, *verb, str(path)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                  timeout=10, preexec_fn=limit_memory, check=False)
        except subprocess.TimeoutExpired:
            return f"{verb[0]}: no end within 10 s"
        if done.returncode not in (0, 3) and not (verb[0] == "scene" and done.returncode == 2):
            return f"{verb[0]}: exit code {done.returncode}: {done.stderr[-600:].decode(errors='replace')}"
    return ""


def main(trace, count=200, seed=1, head=None):
    trace = pathlib.Path(trace)
    stream = unpack(trace.read_bytes(), head)[:head]
    rng = random.Random(seed)
    path = trace.with_suffix(f".mutant-{os.getpid()}")
    broken = 0
    for i in range(count):
        path.write_bytes(mutate(stream, rng))
        wrong = run(path)
        if wrong:
            broken += 1
            kept = trace.with_suffix(f".crash-{seed}-{i}")
            path.replace(kept)
            print(f"{kept}: {wrong}", flush=True)
    path.unlink(missing_ok=True)
    print(f"{100 * (count - broken) // count}%: Checks: {count}, Failures: {broken}, Errors: 0")
    return broken


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(bool(main(sys.argv[1], *map(int, sys.argv[2:5]))))
