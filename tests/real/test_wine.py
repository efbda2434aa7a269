#!/usr/bin/python3
"""Programs of Windows under Wine (`make windows`): what they record passes every gate, three corpus programs show the
very pixels of their Linux builds, and text, shared lists and a pbuffer by WGL are as they were shown. The same three of
32 bits, where `make i386` made a recorder for them, started by programs of either class. limit: 500 s
"""
import json
import os
import shutil

import replayed
import wine
from helpers import (
    AS_SHOWN, BUILD, RELUME, SCRATCH, check, check_gates, corpus, diff, finish, frames_of, must, on_display, record,
    relume, render, run, skip)

FRAMES = 10

if not (BUILD / "windows/wgl.exe").exists() or not shutil.which("wine"):
    skip("'make windows' has not been run: no programs of Windows")

both = wine.loader(BUILD)
os.environ.update(wine.environment(SCRATCH / "wine"))
must(on_display(both, "wineboot", "-i"))


def check_recording(trace, name):
    """Nothing is undone, and every frame passes every gate."""
    info = json.loads(must(relume("info", "--json", trace)).stdout)
    check(info["frames"] == FRAMES, f"{trace.name}: {info['frames']} frames")
    check(not info["unsupported"], f"{trace.name}: not done: {info['unsupported']}")
    render(trace, frames_of(trace), *AS_SHOWN)
    _, score = diff(trace, frames_of(trace))
    check_gates(score, FRAMES, name)
    for file in frames_of(trace).glob("*.exr"):
        file.unlink()


def shown(trace):
    return list(replayed.records(trace.with_suffix(".ref"), replayed.REF_COLOR))


for name, options in {**wine.PROGRAMS, "wgl": ()}.items():
    trace, frames = SCRATCH / f"{name}.trace", ("--frames", FRAMES) if options else ()
    record(trace, "wine", BUILD / f"windows/{name}.exe", *options, *frames)
    check_recording(trace, name)
    if not options:
        continue
    of_linux = SCRATCH / f"{name}.linux.trace"
    record(of_linux, corpus(name), *options, *frames)
    check(len(shown(trace)) == FRAMES and shown(trace) == shown(of_linux), f"{name}: pixels are those of Linux")
    if both != "wine":
        of_32_bits = SCRATCH / f"{name}.32.trace"
        record(of_32_bits, both, BUILD / f"windows32/{name}.exe", *options, *frames)
        check_recording(of_32_bits, f"{name} of 32 bits")
        record(of_linux, BUILD / "i386/sse" / name, *options, *frames)
        check(shown(of_32_bits) == shown(of_linux), f"{name} of 32 bits: pixels are those of Linux")

# Each class starts the other: Wine's loaders of 32 and 64 bits take turns.
if both != "wine":
    for shell, folder, alone in (("system32", "windows32", "tricks.32"), ("syswow64", "windows", "tricks")):
        trace = SCRATCH / f"{shell}.trace"
        options = ("tricks.exe", *wine.PROGRAMS["tricks"], "--frames", str(FRAMES))
        must(
            on_display(RELUME, "record", "-o", trace, "--ref", "color", "--", both, f"C:\\windows\\{shell}\\cmd.exe",
                       "/c", *options, cwd=BUILD / folder))
        check(
            shown(trace) == shown(SCRATCH / f"{alone}.trace"),
            f"{folder} started from {shell}: pixels are those of the program alone")
else:
    print("not tried: programs of 32 bits ('make i386 windows' has not been run)")
run("wineserver", "-k")
finish()
