#!/usr/bin/python3
# limit: 400 s
"""
Small programs of single calls and rare uses are drawn as Mesa draws them, and nothing of them is left out: tests/real/small/, where each says
what it is about. Run with names of programs: those alone.
"""
import sys

from helpers import check, check_same_pictures, finish, must, relume

PROGRAMS = {
    "asks": ("framebuffers", "shader objects", "texture objects of EXT", "one deleted"),
    "open": ("a light that nothing attenuates", "a highlight without a power", "fog without length", "powers of programs", "logarithms",
             "powers of shaders", "places between pixels"),
}

for name in sys.argv[1:] or PROGRAMS:
    trace, _ = check_same_pictures(f"small/{name}", PROGRAMS[name])
    done = must(relume("info", trace))
    check("not done" not in done.stdout, f"{name}: nothing is left out: {done.stdout}")
finish()
