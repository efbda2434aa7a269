#!/usr/bin/python3
"""Windows programs under Wine (`make windows`): their recordings pass every gate, three corpus programs show exactly
the pixels of their Linux builds, and WGL's text, shared lists and pbuffers are as displayed. Also the same as 32-bit
programs, started by programs of either class, if `make i386` has built a recorder for them. limit: 500 s
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
    skip("'make windows' has not been run: no Windows programs")

both = wine.loader(BUILD)
os.environ.update(wine.environment(BUILD, SCRATCH / "wine"))
must(on_display(both, "wineboot", "-i"))


def check_recording(trace, name):
    """Every call is supported, and every frame passes every gate."""
    info = json.loads(must(relume("info", "--json", trace)).stdout)
    check(info["frames"] == FRAMES, f"{trace.name}: {info['frames']} frames")
    check(not info["unsupported"], f"{trace.name}: unsupported: {info['unsupported']}")
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
    of_32_bits = SCRATCH / f"{name}.32.trace"
    if both != "wine":
        record(of_32_bits, both, BUILD / f"windows32/{name}.exe", *options, *frames)
        check_recording(of_32_bits, f"{name} of 32 bits")
    if not options:
        continue
    of_linux = SCRATCH / f"{name}.linux.trace"
    record(of_linux, corpus(name), *options, *frames)
    check(len(shown(trace)) == FRAMES and shown(trace) == shown(of_linux), f"{name}: pixels equal those of Linux")
    if both != "wine":
        record(of_linux, BUILD / "i386/sse" / name, *options, *frames)
        check(shown(of_32_bits) == shown(of_linux), f"{name} as a 32-bit program: pixels equal those of Linux")

# Each class starts the other, using Wine's loaders for 32 and 64 bits in turn.
if both != "wine":
    for shell, folder, alone in (("system32", "windows32", "tricks.32"), ("syswow64", "windows", "tricks")):
        trace = SCRATCH / f"{shell}.trace"
        options = ("tricks.exe", *wine.PROGRAMS["tricks"], "--frames", str(FRAMES))
        must(
            on_display(RELUME, "record", "-o", trace, "--ref", "color", "--", both, f"C:\\windows\\{shell}\\cmd.exe",
                       "/c", *options, cwd=BUILD / folder))
        check(
            shown(trace) == shown(SCRATCH / f"{alone}.trace"),
            f"{folder} started from {shell}: pixels equal those of the program alone")
else:
    print("not tested: 32-bit programs ('make i386 windows' has not been run)")
run("wineserver", "-k")
finish()
