#!/usr/bin/python3
"""
Programs of Windows under Wine (`make windows`): what they record passes every gate, three corpus programs show the very pixels of their Linux
builds, and text, shared lists and a pbuffer by WGL are as they were shown.
limit: 300 s
"""
import json
import os
import shutil

import replayed
import wine
from helpers import AS_SHOWN, BUILD, SCRATCH, check, check_gates, corpus, diff, finish, frames_of, must, on_display, record, relume, render, run, skip

FRAMES = 10

if not (BUILD / "windows/wgl.exe").exists() or not shutil.which("wine"):
    skip("'make windows' has not been run: no programs of Windows")

os.environ.update(wine.environment(SCRATCH / "wine"))
must(on_display("wineboot", "-i"))
for name, options in {**wine.PROGRAMS, "wgl": ()}.items():
    trace, frames = SCRATCH / f"{name}.trace", ("--frames", FRAMES) if options else ()
    record(trace, "wine", BUILD / f"windows/{name}.exe", *options, *frames)
    info = json.loads(must(relume("info", "--json", trace)).stdout)
    check(info["frames"] == FRAMES, f"{name}: {info['frames']} frames")
    check(not info["unsupported"], f"{name}: not done: {info['unsupported']}")
    render(trace, frames_of(trace), *AS_SHOWN)
    _, score = diff(trace, frames_of(trace))
    check_gates(score, FRAMES, name)
    for file in frames_of(trace).glob("*.exr"):
        file.unlink()
    if options:
        of_linux = SCRATCH / f"{name}.linux.trace"
        record(of_linux, corpus(name), *options, *frames)
        shown, of_linux = (list(replayed.records(t.with_suffix(".ref"), replayed.REF_COLOR)) for t in (trace, of_linux))
        check(len(shown) == FRAMES and shown == of_linux, f"{name}: pixels are those of Linux")
run("wineserver", "-k")
finish()
