#!/usr/bin/python3
# limit: 200 s
"""Text by glXUseXFont, for which readers of a trace have no X server's font: glretrace's pictures and ours show what the program did."""
import re

from helpers import BUILD, SCRATCH, check, diff, finish, must, on_display, record, relume, render, run

FRAMES = 5
program = BUILD / "tests/trace/font"
must(on_display("env", f"TMPDIR={SCRATCH}", "tests/real/record_and_replay.sh", str(FRAMES), program))

trace = SCRATCH / "font.trace"
record(trace, program)
files = render(trace, SCRATCH / "frames", "--mode", "gl", "--encoding", "display")
check(len(files) == FRAMES, f"{len(files)} frames of {FRAMES}")
_, score = diff(trace, SCRATCH / "frames")
for frame in score["frames"]:
    check(frame["failing_pixels"] == 0, f"frame {frame['frame']}: {frame['failing_pixels']} pixels fail")
info = must(relume("info", trace)).stdout
check("every call is executed" in info, f"nothing of it is unhandled: {info}")
dump = run("apitrace", "dump", "--color=never", trace).stdout
check(re.search(r"glXUseXFont\(font = \d+, first = 0, count = 256, list = 1000\)", dump), "the call itself, as the program made it")
check(dump.count("glBitmap(") == 512, f"{dump.count('glBitmap(')} bitmaps of 512 characters")
finish()
