#!/usr/bin/python3
# limit: 300 s
"""Cached compiled kernels: damaged, truncated, empty, from another driver, a folder in their place, no writable place.
The frame is always the same to the byte, and the file is rebuilt or a line says why not. Because PoCL has a cache of
its own, it gets another name here."""
import os
import random
import shutil

import exr
from helpers import BUILD, SCRATCH, check, finish, must, record, relume

trace = SCRATCH / "kept.trace"
record(trace, BUILD / "tests/real/shapes", options=())
seed = random.randrange(1 << 32)
chance = random.Random(seed)


def render(folder, **more):
    """The frame's bytes and the output, with a kernel cache folder."""
    env = dict(os.environ, LD_PRELOAD=str(BUILD / "tests/real/failing_cl.so"), AS_PLATFORM="another", **more)
    out = SCRATCH / "frame.0.exr"
    out.unlink(missing_ok=True)
    done = must(
        relume("render", trace, "-f", "0", "-o", SCRATCH / "frame.#.exr", "--mode", "gl", "--cache", folder,
               "--progress", "none", "-j", "1", env=env, timeout=250))
    return out.read_bytes(), done.stderr


def kept(folder):
    return {f.name: f.stat().st_ino for f in folder.glob("*.program")}


cache = SCRATCH / "programs"
want, said = render(cache)
whole = {f.name: f.read_bytes() for f in cache.glob("*.program")}
before, planes = kept(cache), exr.Image(SCRATCH / "frame.0.exr").planes
check(len(whole) > 1 and not said, f"kept: {list(whole)} {said}")
check(render(cache) == (want, "") and kept(cache) == before, "a run that finds its kernels")


def damage(name, data):
    """Damage a file and render; the file must be replaced by a valid one."""
    path = cache / name
    inode = path.stat().st_ino
    path.write_bytes(data)
    frame, words = render(cache)
    check(frame == want and not words, f"seed {seed}: {name}: the frame differs, or messages: {words}")
    check(path.stat().st_ino != inode and path.stat().st_size > 1000, f"seed {seed}: {name} is not rebuilt")


name, data = max(whole.items(), key=lambda item: len(item[1]))
for at in [chance.randrange(len(data)) for _ in range(4)] + [20]:
    damage(name, data[:at] + bytes([data[at] ^ (1 << chance.randrange(8))]) + data[at + 1:])
for length in (0, 47, len(data) // 2):
    damage(name, data[:length])
damage(name, data + b"more")
damage(name, next(other for n, other in whole.items() if n != name))
check(render(cache) == (want, ""), f"seed {seed}: the rebuilt file")

# Another driver: the file's name is the same, but its dependencies differ.
before = kept(cache)
_, said = render(cache, AS_DRIVER="99")
check(not said and exr.Image(SCRATCH / "frame.0.exr").planes == planes,
      f"another driver: the picture differs, or messages: {said}")
after = kept(cache)
check(after.keys() == before.keys() and all(after[n] != before[n] for n in before),
      "another driver takes the kernels of this one")

# A folder in place of a file; places that cannot be written.
path = cache / name
path.unlink()
path.mkdir()
frame, said = render(cache)
check(frame == want and said.count("\n") == 1 and path.name in said, f"a folder in its place: {said!r}")
shutil.rmtree(path)
for place in ("/proc/self/fdinfo", "/dev/null/programs"):
    frame, said = render(place)
    check(frame == want and place in said and said.count("\n") <= 2, f"{place}: {said!r}")
finish()
