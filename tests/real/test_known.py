#!/usr/bin/python3
"""A frame that Mesa draws differently from OpenGL fails, and the report marks this difference as known, for the
affected draws only: tests/real/panels/known.c.
"""
import re

from helpers import AS_SHOWN, BUILD, SCRATCH, check, diff, finish, frames_of, must, on_display, record, relume, render

MESA = tuple(map(int, re.search(r"Mesa (\d+)\.(\d+)", must(on_display("glxinfo", "-B")).stdout).groups()))
trace = SCRATCH / "known.trace"
record(trace, BUILD / "tests/real/panels/known")
render(trace, frames_of(trace), *AS_SHOWN)
_, score = diff(trace, frames_of(trace))
blame = score["frames"][0]["blame"]
if MESA >= (25, 0):
    check(not blame and score["frames"][0]["outcome"] == "passed", f"Mesa 25 draws them as OpenGL specifies: {blame}")
    finish()
check(blame and all("Mesa" in b.get("known", "") for b in blame), f"the failures are known: {blame}")
check(all(b["box"][2] < 5 * 20 for b in blame), f"the five two-sided panels do not fail: {blame}")
check("known: Mesa" in " ".join(relume("diff", trace, frames_of(trace)).stdout.split()), "the report marks it, too")
finish()
