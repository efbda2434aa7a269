#!/usr/bin/python3
"""Triangles that leave the view volume: what tests/real/leaving.c draws has the rasterized depth to the last bit, in buffers of 24
and 32 bits."""
import exr
from helpers import BUILD, SCRATCH, check, check_gates, diff, finish, record, render
from replayed import reference_depths

N_FRAMES = 12


def differing(image, reference):
    """Pixels whose depth is more than half a step of 24 bits from the reference's."""
    width, height, depths = reference
    n = 0
    for y in range(height):
        row = image.planes["gl.depth"][height - 1 - y]
        n += sum(abs(row[x] - depths[y * width + x]) > 2 ** -25 for x in range(width))
    return n


for bits in (24, 32):
    trace = SCRATCH / f"leaving{bits}.trace"
    record(trace, BUILD / "tests/real/leaving", bits)
    files = render(trace, SCRATCH / f"frames{bits}", "--mode", "gl", "--encoding", "display")
    _, score = diff(trace, SCRATCH / f"frames{bits}")
    check_gates(score, N_FRAMES, f"{bits} bits", skip=("R2", "R4", "P"))
    references = reference_depths(trace.with_suffix(".ref"))
    check(len(files) == len(references) == N_FRAMES, f"{len(files)} frames, {len(references)} references")
    for file, (frame, reference) in zip(files, sorted(references.items())):
        found = differing(exr.Image(file, {"gl.depth"}), reference)
        check(found == 0, f"{bits} bits, frame {frame}: depth differs at {found} pixels")
    for frame in score["frames"]:
        check(frame["failing_pixels"] == 0, f"{bits} bits, frame {frame['frame']}: {frame['failing_pixels']} pixels fail")
finish()
