#!/usr/bin/python3
# limit: 400 s
"""A real program, end to end: glxgears recorded live, ray traced, scored; rendered again, the same bytes; and a trace
made by apitrace gets the same score."""
import hashlib
import shutil

from helpers import RELUME, SCRATCH, check, check_gates, diff, finish, must, on_display, record, render, run

FRAMES = 12


def digests(files):
    return [hashlib.sha256(f.read_bytes()).hexdigest() for f in files]


trace = SCRATCH / "gears.trace"
record(trace, "glxgears", options=("--ref", "color,depth", "--quit-after", str(FRAMES)))
files = render(trace, SCRATCH / "frames")
check(len(files) == FRAMES, f"{len(files)} frames of {FRAMES}")
code, score = diff(trace, SCRATCH / "frames", "--report", SCRATCH / "report")
check(code == 0, f"relume diff exits with {code}")
check_gates(score, FRAMES, "glxgears")
page = SCRATCH / "report" / "index.html"
check(page.exists() and page.stat().st_size > 10000, "the report is written")
check((SCRATCH / "report" / "sheet.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n", "the contact sheet is written")

first = digests(files)
for threads in ("1", "2"):
    again = render(trace, SCRATCH / f"again{threads}", "--threads", threads)
    check(digests(again) == first, f"rendered again with {threads} threads: the same bytes")

if shutil.which("apitrace"):
    theirs = SCRATCH / "theirs.trace"
    # apitrace stops only when the program does, and glxgears never exits on its own.
    on_display("timeout", "--signal=TERM", "4", "apitrace", "trace", "-o", theirs, "glxgears")
    references = SCRATCH / "references"
    must(on_display(RELUME, "raster", theirs, "-f", "5-8", "-o", references / "x.####.png"))
    files = render(theirs, SCRATCH / "theirs", "-f", "5-8")
    check(len(files) == 4, f"{len(files)} frames of apitrace's trace, of 4")
    code, score = diff(references, SCRATCH / "theirs", "-f", "5-8")
    check(code == 0, f"relume diff of apitrace's trace exits with {code}")
    check_gates(score, 4, "glxgears by apitrace", skip=("R5",))

    dump = run("apitrace", "dump", "--color=never", trace)
    check(dump.returncode == 0 and dump.stdout.count("glXSwapBuffers") == FRAMES and not dump.stderr,
          f"apitrace dump reads our trace to the end: exit code {dump.returncode}, {dump.stderr[:500]}")
finish()
