#!/usr/bin/python3
"""Triangles that leave the view volume: tests/real/leaving.c must have exactly the raster depth, in buffers of 24 and
32 bits, and its colours, including those between two 8-bit codes; only a smooth line may be off by one code."""
import exr
from helpers import BUILD, SCRATCH, check, check_gates, diff, finish, record, render
from replayed import reference_depths, reference_frames

N_FRAMES = 12


def differing(image, depth, color):
    """Pixels whose depth is more than half a 24-bit step from the reference, and pixels whose colours differ."""
    width, height, depths = depth
    far = off = 0
    for y in range(height):
        row = image.planes["gl.depth"][y]
        from_bottom = (height - 1 - y) * width
        far += sum(abs(row[x] - depths[from_bottom + x]) > 2 ** -25 for x in range(width))
        for x in range(width):
            at = 3 * (y * width + x)
            off += any(
                round(255 * display(image.at(f"gl.{name}", x, y))) != color[2][at + c] for c, name in enumerate("RGB"))
    return far, off


def display(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


for bits in (24, 32):
    trace = SCRATCH / f"leaving{bits}.trace"
    if not record(trace, BUILD / "tests/real/leaving", bits, optional=bits == 32):
        continue
    files = render(trace, SCRATCH / f"frames{bits}", "--mode", "gl")
    _, score = diff(trace, SCRATCH / f"frames{bits}")
    check_gates(score, N_FRAMES, f"{bits} bits", skip=("R2", "R4", "P"))
    depths, colors = (read(trace.with_suffix(".ref")) for read in (reference_depths, reference_frames))
    check(len(files) == len(depths) == N_FRAMES, f"{len(files)} frames, {len(depths)} references")
    for file, frame in zip(files, sorted(depths)):
        far, off = differing(exr.Image(file, {"gl.R", "gl.G", "gl.B", "gl.depth"}), depths[frame], colors[frame])
        check(far == 0, f"{bits} bits, frame {frame}: depth differs at {far} pixels")
        check(off <= 40, f"{bits} bits, frame {frame}: colours differ at {off} pixels")
    for frame in score["frames"]:
        check(frame["failing_pixels"] == 0,
              f"{bits} bits, frame {frame['frame']}: {frame['failing_pixels']} pixels fail")
finish()
