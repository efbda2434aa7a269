#!/usr/bin/python3
"""Pixmaps (tests/real/pixmaps.c): frames drawn to one have references; one that X draws to is recorded as a texture, of
both kinds, also if recording starts later. Frames that cannot have references are reported."""
import subprocess

from helpers import (
    AS_SHOWN, BUILD, SCRATCH, check, check_gates, diff, finish, must, on_display, record, relume, render, skip)

PROGRAM, FRAMES = BUILD / "tests/real/pixmaps", 3
REF = ("--ref", "color,depth")
UNREAD = "neither a window nor a pixmap"

if on_display(PROGRAM, "drawn").returncode == 77 or on_display(PROGRAM).returncode == 77:
    skip("the X server has no GLX pixmaps, or cannot use them as textures")


def check_shown(how, *arguments, options=(), frames=FRAMES):
    trace = SCRATCH / f"{how}.trace"
    said = record(trace, PROGRAM, *arguments, options=(*REF, *options)).stderr
    check(f" {frames} frames, " in said and "bytes of reference frames" in said and UNREAD not in said,
          f"{how}: record says: {said}")
    check(len(render(trace, SCRATCH / how, *AS_SHOWN)) == frames, f"{how}: {frames} frames rendered")
    check_gates(diff(trace, SCRATCH / how)[1], frames, how)
    info = must(relume("info", "--all", trace)).stdout
    check("every call is executed" in info, f"{how}: info says: {info}")
    return info


check_shown("drawn", "drawn", options=("--frame-end", "finish"))
for how in "texture", "rectangle":
    check("glXBindTexImageEXT" in check_shown(how, how), f"{how}: nothing was bound")
check_shown("later", options=("--frames", "1-2"), frames=FRAMES - 1)

trace = SCRATCH / "surfaceless.trace"
if subprocess.run([BUILD / "tests/trace/offscreen", "surfaceless"], stderr=subprocess.DEVNULL,
                  check=False).returncode != 77:
    said = record(trace, BUILD / "tests/trace/offscreen", "surfaceless", options=(*REF, "--frame-end", "finish")).stderr
    check(
        said.count(UNREAD) == 1 and "bytes of reference frames" not in said,
        f"frames without a drawable: record says: {said}")
finish()
