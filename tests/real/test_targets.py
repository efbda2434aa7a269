#!/usr/bin/python3
"""What programs draw to beside a plain window: what tests/real/targets.c draws is traced as it was rasterized."""
from helpers import BUILD, SCRATCH, check, check_gates, diff, finish, record, render

FRAMES = ("stored alpha", "render to texture", "depth texture", "copies", "levels", "layers", "sums", "more sums")
trace = SCRATCH / "targets.trace"
record(trace, BUILD / "tests/real/targets")
files = render(trace, SCRATCH / "frames", "--mode", "gl", "--encoding", "display")
check(len(files) == len(FRAMES), f"{len(files)} frames of {len(FRAMES)}")
_, score = diff(trace, SCRATCH / "frames")
for frame, name in zip(score["frames"], FRAMES):
    check(frame["failing_pixels"] == 0, f"{name}: {frame['failing_pixels']} pixels fail")
# flat panels over all of the window: R4 and R5 look for a background and for what stands before it
check_gates(score, len(FRAMES), "targets", skip=("R4", "R5"))
# these need what the frame before left in a texture and in the accumulation buffer
for frame in (2, 7):
    name = f"targets.{frame:04}.exr"
    render(trace, SCRATCH / f"alone{frame}", "--mode", "gl", "--encoding", "display", "-f", str(frame))
    check((SCRATCH / f"alone{frame}" / name).read_bytes() == (SCRATCH / "frames" / name).read_bytes(),
          f"frame {frame} is the same whether earlier ones were asked for or not")
finish()
