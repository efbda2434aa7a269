#!/usr/bin/python3
"""llvmpipe's fast rasterizer: neither `record --ref-exact` nor `raster` may use it: tests/real/linear.c."""
import json
import os
import tempfile

from helpers import AS_SHOWN, BUILD, RELUME, SCRATCH, check, finish, must, on_display, pathlib, record, relume, render

os.environ.pop("LP_PERF", None)
PROGRAM = BUILD / "tests/real/linear"


def compare(trace, *references):
    """The largest difference in any frame, in codes, and diff's exit code."""
    done = relume("diff", trace, *references, "--json", out / "score.json")
    score = json.loads((out / "score.json").read_text())
    return max(f["worst_code"] for f in score["frames"]), done.returncode


with tempfile.TemporaryDirectory(dir=SCRATCH) as folder:
    out = pathlib.Path(folder)
    record(out / "quick.trace", PROGRAM)
    record(out / "exact.trace", PROGRAM, options=("--ref", "color,depth", "--ref-exact"))
    codes, code = {}, {}
    for name in ("quick", "exact"):
        render(out / f"{name}.trace", out / name, *AS_SHOWN)
        codes[name], code[name] = compare(out / f"{name}.trace", out / name)
    check(code["exact"] == 0, f"exit codes of diff: {code}")
    check(codes["exact"] < codes["quick"] or codes["quick"] == 0,
          f"largest differences: {codes}")  # 0: Mesa 25 does not use the fast path for these
    check(codes["exact"] <= 1, f"largest difference with --ref-exact: {codes}")
    must(on_display(RELUME, "raster", out / "quick.trace", "-o", out / "raster/r.####.png"))
    done = relume("diff", out / "exact.trace", out / "raster")
    check(done.returncode == 0, f"raster against --ref-exact: {done.stdout}")
    record(out / "single.trace", PROGRAM, "single", options=("--frame-end", "flush"))
    done = on_display(RELUME, "raster", out / "single.trace", "-f", 0, "-o", out / "single/r.####.png")
    check("draws to a single-buffered window" in done.stderr, f"raster of one buffer: {done.stderr}")
    check("buffers     one" in relume("info", out / "single.trace").stdout, "info of one buffer")
    print(f"largest differences: {codes}, exit codes of diff: {code}")
    check(relume("record", "--ref-exact", "--", "true").returncode == 2, "--ref-exact without --ref")
finish()
