#!/usr/bin/python3
"""OpenGL ES 1 (corpus/es): recordings of three programs pass every gate that needs no depth, which OpenGL ES cannot
read back. There are no missing draws or errors, apitrace reads the recordings, and a frame rendered alone is the same.
"""
import json

from helpers import (
    AS_SHOWN, SCRATCH, check, check_alone, check_gates, corpus, diff, finish, frames_of, must, record, relume, render,
    run)

FRAMES = 10

for name in ("shapes", "fixed", "sprites"):
    trace = SCRATCH / f"{name}.trace"
    record(trace, corpus(f"es/{name}"), "--frames", FRAMES)
    info = json.loads(must(relume("info", "--json", trace)).stdout)
    check(info["frames"] == FRAMES, f"{name}: {info['frames']} frames")
    check(all("only a renderer" in u.get("why", "") for u in info["unsupported"]),
          f"{name}: unsupported: {info['unsupported']}")
    check(not info["gl_errors"], f"{name}: errors: {info['gl_errors']}")
    dump = must(run("apitrace", "dump", "--color=never", trace))
    check(not dump.stderr, f"{name}: apitrace reads all of it: {dump.stderr}")
    render(trace, frames_of(trace), *AS_SHOWN)
    check_alone(trace, 7)
    _, score = diff(trace, frames_of(trace))
    check_gates({"frames": score["frames"]}, FRAMES, name, skip=("R5",))
    for file in (frames_of(trace)).glob("*.exr"):
        file.unlink()
finish()
