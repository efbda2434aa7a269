#!/usr/bin/python3
"""A frame that no device can render is one bad frame: the others are rendered, and the exit code reports it
(tests/real/empty.c). Many frames with the same fault are reported once, with their range."""
from helpers import AS_SHOWN, BUILD, SCRATCH, check, finish, record, relume

trace = SCRATCH / "empty.trace"
record(trace, BUILD / "tests/real/empty", options=())
done = relume("render", trace, "-o", SCRATCH / "out/e.####.exr", *AS_SHOWN)
files = sorted(f.name for f in (SCRATCH / "out").glob("*.exr"))
check(files == ["e.0000.exr", "e.0002.exr"], f"files: {files}")
check(done.returncode == 5, f"exit code {done.returncode}")
check(done.stderr.count("cannot be rendered") == 1 and "frame 1: 0 x 0 pixels" in done.stderr, f"says: {done.stderr}")
check("another device" not in done.stderr, f"blames the device: {done.stderr}")

trace = SCRATCH / "many.trace"
record(trace, BUILD / "tests/real/empty", "20", options=())
done = relume("render", trace, "-o", SCRATCH / "many/e.####.exr", "-f", "0-12,14-21", *AS_SHOWN)
check(done.returncode == 5 and len(list((SCRATCH / "many").glob("*.exr"))) == 2,
      f"many bad frames: exit code {done.returncode}")
reported = [line for line in done.stderr.splitlines() if "cannot be rendered" in line]
check(
    len(reported) == 2 and reported[1] == "relume: frames 1-12, 14-20: 0 x 0 pixels cannot be rendered",
    f"many bad frames: {reported}")
finish()
