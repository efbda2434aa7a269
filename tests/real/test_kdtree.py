#!/usr/bin/python3
"""rtBuildKdTreeEXT: from the frame on in which a program calls it, its meshes become kd-trees, unless --accel asks for
others; no pixel changes.

Which trees were built is told by what is kept of them (binned ones only of larger meshes).
"""
from helpers import BUILD, SCRATCH, check, finish, record, render

TRACE = SCRATCH / "kdtree.trace"
KD = 2 # enum accel_kind


def kinds(name, *options):
    """Render; return the frames' bytes and the kinds of the trees that were kept."""
    folder = SCRATCH / f"{name}.trees"
    frames = [f.read_bytes() for f in render(TRACE, SCRATCH / name, "--cache", folder, "-j", "1", *options)]
    return frames, sorted(int(f.stem.split("-")[1]) for f in folder.glob("*.tree"))


record(TRACE, BUILD / "tests/real/kdtree", options=())
row, kept = kinds("row")
check(len(row) == 4, f"{len(row)} frames")
check(kept == [KD, KD], f"both bowls of frame 1, and what moves no more after it: {kept}")
for frame, options, want in ((0, (), []), (1, (), [KD, KD]), (3, (), [KD, KD]), (1, ("--accel", "bvh"), []),
                             (0, ("--accel", "kd"), [KD, KD]), (1, ("--accel", "sbvh"), [1, 1])):
    alone, kept = kinds("-".join(("alone", str(frame), *options)), "-f", frame, *options)
    check(kept == want, f"frame {frame} {options}: trees {kept}, not {want}")
    check(alone[0] == row[frame], f"frame {frame} {options}: another file")
finish()
