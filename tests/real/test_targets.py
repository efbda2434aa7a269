#!/usr/bin/python3
"""What programs draw to beside a plain window: what tests/real/targets.c draws is traced as it was rasterized."""
from helpers import check_alone, check_gates, check_same_pictures, finish

FRAMES = ("stored alpha", "render to texture", "depth texture", "copies", "levels", "layers", "several colours",
          "floats", "scaled", "few bits", "not rendered")
trace, score = check_same_pictures("targets", FRAMES)
# flat panels over all of the window: R4 and R5 look for a background and for what stands before it
check_gates(score, len(FRAMES), "targets", skip=("R4", "R5"))
check_alone(trace, 2)  # needs what the frame before left in a texture
finish()
