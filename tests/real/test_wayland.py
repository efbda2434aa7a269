#!/usr/bin/python3
"""A program with a Wayland window, under headless Weston (corpus/wayland), also one that resizes it: every frame passes
every gate, and has its size, with or without reference frames."""
from exr import Image
from helpers import AS_SHOWN, RELUME, ROOT, SCRATCH, check, check_gates, corpus, diff, finish, must, render, run

FRAMES = 10


def record(trace, *options, program=()):
    return must(
        run(ROOT / "tests/wayland.sh", RELUME, "record", "-o", trace, *options, "--", corpus("wayland/blades"),
            "--frames", FRAMES, *program))


for name, program in (("blades", ()), ("resized", ("--resize",))):
    trace = SCRATCH / f"{name}.trace"
    sizes = record(trace, "--ref", "color,depth", program=program).stdout.split() or ["320x240"] * FRAMES
    check((len(set(sizes)) > 4) == bool(program), f"{name}: sizes {sizes}")
    render(trace, SCRATCH / name, *AS_SHOWN)
    _, score = diff(trace, SCRATCH / name)
    check_gates(score, FRAMES, name)
    alone = SCRATCH / f"{name}_alone.trace"
    record(alone, program=program)
    for frame, size, file in zip(score["frames"], sizes, render(alone, SCRATCH / alone.stem, *AS_SHOWN)):
        image = Image(file)
        found = f"{frame['width']}x{frame['height']}", f"{image.width}x{image.height}"
        check(found == (size, size), f"{name}: frame {frame['frame']}: {found}, shown {size}")
finish()
