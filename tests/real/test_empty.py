#!/usr/bin/python3
"""A frame that no device can render is one bad frame: the others are rendered, and the exit code says so (tests/real/empty.c)."""
from helpers import AS_SHOWN, BUILD, SCRATCH, check, finish, record, relume

trace = SCRATCH / "empty.trace"
record(trace, BUILD / "tests/real/empty", options=())
done = relume("render", trace, "-o", SCRATCH / "out/e.####.exr", *AS_SHOWN)
files = sorted(f.name for f in (SCRATCH / "out").glob("*.exr"))
check(files == ["e.0000.exr", "e.0002.exr"], f"files: {files}")
check(done.returncode == 5, f"exit code {done.returncode}")
check(done.stderr.count("cannot be rendered") == 1 and "frame 1: 0 x 0 pixels" in done.stderr, f"says: {done.stderr}")
check("another device" not in done.stderr, f"blames the device: {done.stderr}")
finish()
