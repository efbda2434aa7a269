#!/usr/bin/python3
"""Frames that need no earlier ones are rendered alone, and those that do are reported: tests/real/parts.c. Frames that
start with an existing picture are the same whether drawn layer by layer (packets) or segment by segment."""
from exr import Image
from helpers import AS_SHOWN, SCRATCH, check, check_alone, check_same_pictures, finish, must, relume, render

FRAMES = ("two views", "two views again", "a corner copied", "a corner copied again", "tiles", "tiles again",
          "blended tiles", "blended tiles again", "two views and a gap", "less of a corner copied",
          "tiles that let something through")
trace, _ = check_same_pictures("parts", FRAMES)
for frame in range(1, len(FRAMES)):
    done = must(relume("render", trace, "-f", frame, "-o", SCRATCH / "one.####.exr", *AS_SHOWN))
    reported = f"frame {frame} needs the pixels of frames before it" in done.stderr
    check(reported == (frame >= 8), f"{FRAMES[frame]}: reported as needing earlier frames: {reported}: {done.stderr}")
    check_alone(trace, frame)

# Frames that the world's rules name are replayed first: later frames can use their drawing and copies.
rules = SCRATCH / "unseen.look.yaml"
for frame in range(8, len(FRAMES)):
    rules.write_text(
        f"world:\n  - mesh: 00\n    at: [{', '.join('1' if i % 5 == 0 else '0' for i in range(16))}]\nunseen:\n  - "
        f"frame: {frame - 1}\n    draws: 0\n"
    )
    plain, ruled = (Image(
        render(trace, SCRATCH / name, "-f", frame, "--aov", "gl", *look)[0], ["gl.R", "gl.G", "gl.B"]).planes
                    for name, look in (("plain", ()), ("ruled", ("--look", rules))))
    check(plain == ruled, f"{FRAMES[frame]}: rules that name the frame before change OpenGL's picture")
for device in ((), ("--device", "reference")):
    ways = []
    for kernels in ("packets", "binary"):
        folder = SCRATCH / f"{kernels}{len(device)}"
        must(
            relume("render", trace, "-f", f"0-{len(FRAMES) - 1}", "-o", folder / "####.exr", "--kernels", kernels,
                   *device))
        ways.append([file.read_bytes() for file in sorted(folder.iterdir())])
    check(len(ways[0]) == len(FRAMES) and ways[0] == ways[1], f"{device}: packets' files differ from those of binary")
finish()
