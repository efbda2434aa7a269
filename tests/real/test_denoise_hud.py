#!/usr/bin/python3
"""Denoising leaves a HUD unchanged: its albedo differs from that of the surface behind it, and light mistaken for its
own would smear in boxes."""
from exr import Image
from helpers import SCRATCH, check, corpus, finish, must, record, relume

trace = SCRATCH / "courtyard.trace"
record(trace, corpus("courtyard"), "--frames", "2", "--size", "160x120", options=())
must(relume("render", trace, "-f", 1, "-o", SCRATCH / "noisy.####.exr", "--mode", "path", "--samples", "2",
            timeout=300))
must(relume("denoise", SCRATCH / "noisy.####.exr", "-o", SCRATCH / "clean.####.exr"))
noisy, clean = Image(SCRATCH / "noisy.0001.exr"), Image(SCRATCH / "clean.0001.exr")
pixels = [(x, y) for y in range(noisy.height) for x in range(noisy.width)]
changed = {p for p in pixels if any(noisy.at(c, *p) != clean.at(c, *p) for c in "RGB")}
hud = {p for p in pixels if noisy.at("id", *p) and not noisy.at("Z", *p) > 0}
surfaces = {p for p in pixels if noisy.at("Z", *p) > 0}
check(len(hud) == 240, f"the HUD's bar has {len(hud)} pixels")
check(not hud & changed, f"{len(hud & changed)} pixels of the HUD are filtered")
check(
    len(surfaces & changed) > 0.5 * len(surfaces),
    f"{len(surfaces & changed)} of {len(surfaces)} other pixels are filtered")
finish()
