#!/usr/bin/python3
"""32-bit programs (`make i386`) are recorded by the recorder of their class, whether they are started directly or by a
64-bit program; so is a 64-bit program started by them. Every picture is as the program showed it, even if computed in
x87 registers.
"""
import wine
from helpers import AS_SHOWN, BUILD, SCRATCH, check, check_gates, diff, finish, must, record, render, run, skip

FRAMES = 10
PROGRAM = BUILD / "i386/windows"
GEARS = "glxgears.i386-linux-gnu"

if not (BUILD / "lib/i386-linux-gnu/librelume.so").exists() or not PROGRAM.exists():
    skip("'make i386' has not been run: no recorder for 32-bit programs")

source, parent = SCRATCH / "parent.c", SCRATCH / "parent"
source.write_text("#include <unistd.h>\nint main(int n, char **v) { return n > 1 ? execv(v[1], v + 1) : 1; }\n")
must(run("cc", "-m32", "-o", parent, source))
for name, command in (("alone", [PROGRAM]), ("child", ["/bin/sh", "-c", f"{PROGRAM}; true"]),
                      ("child of 64 bits", [parent, BUILD / "tests/real/windows"])):
    trace = SCRATCH / f"{name}.trace"
    said = record(trace, *command).stderr
    check("cannot be preloaded" not in said, f"{name}: {said}")
    render(trace, SCRATCH / name, *AS_SHOWN)
    _, score = diff(trace, SCRATCH / name)
    failing = [f["failing_pixels"] for f in score["frames"]]
    check(failing == [0] * FRAMES, f"{name}: failing pixels: {failing}")
    sizes = [(f["width"], f["height"]) for f in score["frames"]]
    check(sizes == [(48, 48), (80, 80)] * 5, f"{name}: sizes: {sizes}")
    check(all(f["gates"]["R5"]["state"] == "passed" for f in score["frames"]), f"{name}: depth")
for name, options in wine.PROGRAMS.items():
    trace = SCRATCH / f"{name}.trace"
    record(trace, BUILD / "i386" / name, *options, "--frames", FRAMES)
    render(trace, SCRATCH / name, *AS_SHOWN)
    check_gates(diff(trace, SCRATCH / name)[1], FRAMES, name)
# A Debian program.
trace = SCRATCH / "glxgears.trace"
record(trace, GEARS, options=("--ref", "color,depth", "--quit-after", str(FRAMES)))
render(trace, SCRATCH / "glxgears", *AS_SHOWN)
check_gates(diff(trace, SCRATCH / "glxgears")[1], FRAMES, "glxgears")
finish()
