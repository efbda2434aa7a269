#!/usr/bin/python3
"""The reference of a window with four samples per pixel is the picture that the X server shows: the mean of the
samples.
"""
from helpers import BUILD, RELUME, SCRATCH, check, finish, on_display, skip
from replayed import reference_depths, reference_frames

WIDTH, HEIGHT, FRAMES = 64, 48, 4
PROGRAM = BUILD / "tests/real/multisampled"

bare = on_display(PROGRAM, SCRATCH / "bare")
if bare.returncode == 77:
    skip("this GL has no visual with four samples per pixel")
check(bare.returncode == 0, f"the program runs: {bare.stderr}")
done = on_display(RELUME, "record", "-o", SCRATCH / "m.trace", "--ref", "color,depth", "--", PROGRAM,
                  SCRATCH / "recorded")
check(done.returncode == 0, f"the recorded program runs: {done.stderr}")
shown = (SCRATCH / "bare").read_bytes()
check((SCRATCH / "recorded").read_bytes() == shown, "the window shows the same while it is recorded")
frames = reference_frames(SCRATCH / "m.ref")
check(sorted(frames) == list(range(FRAMES)), f"a picture of each frame: {sorted(frames)}")
size = WIDTH * HEIGHT * 3
colors = []
for frame, (width, height, rgb) in sorted(frames.items()):
    want = shown[frame * size:(frame + 1) * size]
    colors.append(len({want[i:i + 3] for i in range(0, size, 3)}))
    differ = sum(rgb[i:i + 3] != want[i:i + 3] for i in range(0, size, 3))
    check((width, height) == (WIDTH, HEIGHT) and differ == 0, f"frame {frame}: {differ} pixels differ from the window")
check(len(colors) == FRAMES and min(colors[0], colors[2], colors[3]) > 2 * colors[1],
      f"edges are smooth if multisampling is on: {colors} colours")
check(len(reference_depths(SCRATCH / "m.ref")) == FRAMES, "depths of each frame")
finish()
