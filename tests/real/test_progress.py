#!/usr/bin/python3
"""A bar on a terminal, one plain line per frame elsewhere; if frames need earlier ones, the frames replayed, the
reason, and the time they are counted in."""
import json
import os
import pty
import re
import subprocess

from helpers import BUILD, RELUME, SCRATCH, check, corpus, finish, must, record, relume


def on_terminal(command):
    """Run with standard error on a terminal; returns the exit code and the text shown."""
    ours, theirs = pty.openpty()
    child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=theirs)
    os.close(theirs)
    shown = b""
    while True:
        try:
            piece = os.read(ours, 4096)
        except OSError:  # the other side has closed
            break
        if not piece:
            break
        shown += piece
    return child.wait(), shown.decode()


trace = SCRATCH / "two.trace"
record(trace, corpus("two_triangles"), "--frames", "3")
command = [RELUME, "render", str(trace), "-j", "1", "-f", "0-2", "-o", str(SCRATCH / "x.####.exr")]

plain = must(relume(*command[1:]))
lines = [line for line in plain.stderr.splitlines() if line.startswith("rendered frame")]
found = [re.match(r"rendered frame (\d+), (\d+) of (\d+): .", line) for line in lines]
# frames are reported when complete: two writers compress them, so a later one may come first
check(
    all(found) and sorted(m[1] for m in found) == ["0", "1", "2"]
    and [m.group(2, 3) for m in found] == [(n, "3") for n in "123"], f"one line per frame: {plain.stderr}")
check("\r" not in plain.stderr and "\x1b" not in plain.stderr, "no control characters outside a terminal")

for old in SCRATCH.glob("x.*.exr"):
    old.unlink()
code, shown = on_terminal(command)
check(code == 0, f"exit code {code} on a terminal")
check(re.search(r"\r\x1b\[Krendered \[#*\.*\] 3/3 .*frames/s.*left", shown), f"a bar on a terminal: {shown!r}")
check("rendered frame 0" not in shown, "no plain lines on a terminal")

# A frame that shows the drawing of earlier frames.
trace, frame = SCRATCH / "front.trace", 13
record(trace, BUILD / "tests/real/front", options=("--frame-end", "flush"))
command = [RELUME, "render", str(trace), "-f", str(frame), "-o", str(SCRATCH / "front.####.exr")]
why = r"their drawing is not cleared, and shows"
done = must(relume(*command[1:], "--progress", "json"))
check(
    re.search(
        rf"frame {frame} needs the pixels of frames before it \({why}, found at call \d+, .*playing them from frame 0",
        done.stderr), f"a line says why: {done.stderr}")
events = {event["event"]: event for event in map(json.loads, done.stdout.splitlines())}
check(events["frame"]["seconds"] > 0.5 * events["end"]["seconds"],
      f"the frame's time includes frames replayed for it: {events}")
code, shown = on_terminal(command)
check(
    code == 0 and re.search(
        rf"\r\x1b\[Krelume: warning: .*{why}.*\r\n\r\x1b\[Kreplaying \[#*\.*\] 1/{frame}  before frame {frame}: {why}",
        shown), f"a bar for replayed frames: {shown!r}")
finish()
