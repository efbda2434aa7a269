#!/usr/bin/python3
"""Quads that are not flat: cut along the diagonal along which Mesa cuts them, in immediate mode with smooth shading."""
from helpers import BUILD, SCRATCH, check, diff, finish, record, render

FRAMES = 6
trace = SCRATCH / "loops.trace"
record(trace, BUILD / "tests/trace/loops")
check(len(render(trace, SCRATCH / "frames", "--mode", "gl", "--encoding", "display")) == FRAMES, "all frames are rendered")
code, score = diff(trace, SCRATCH / "frames")
check(code == 0, f"relume diff exits with {code}: {[f['failing_pixels'] for f in score['frames']]} pixels fail")
finish()
