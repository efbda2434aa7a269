#!/usr/bin/python3
"""rtBuildKdTreeEXT: from the frame with the call on, the program's meshes get kd-trees, unless --accel selects others;
no pixel changes.

The kinds of trees built are read from the cache (binned trees are stored only for larger meshes).
"""
from helpers import BUILD, SCRATCH, check, finish, record, render

TRACE = SCRATCH / "kdtree.trace"
KD = 2 # enum accel_kind


def kinds(name, *options):
    """Render; returns the frames' bytes and the kinds of the cached trees."""
    folder = SCRATCH / f"{name}.trees"
    frames = [f.read_bytes() for f in render(TRACE, SCRATCH / name, "--cache", folder, "-j", "1", *options)]
    return frames, sorted(int(f.stem.split("-")[1]) for f in folder.glob("*.tree"))


record(TRACE, BUILD / "tests/real/kdtree", options=())
row, kept = kinds("row")
check(len(row) == 4, f"{len(row)} frames")
check(kept == [KD, KD], f"both bowls of frame 1, and only static meshes after it: {kept}")
for frame, options, want in ((0, (), []), (1, (), [KD, KD]), (3, (), [KD, KD]), (1, ("--accel", "bvh"), []),
                             (0, ("--accel", "kd"), [KD, KD]), (1, ("--accel", "sbvh"), [1, 1])):
    alone, kept = kinds("-".join(("alone", str(frame), *options)), "-f", frame, *options)
    check(kept == want, f"frame {frame} {options}: trees {kept}, expected {want}")
    check(alone[0] == row[frame], f"frame {frame} {options}: the file differs")
finish()
