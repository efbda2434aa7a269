#!/usr/bin/python3
# limit: 400 s
"""Every family of traversal kernels and their C twins write the same files, byte for byte: transparent surfaces, lines,
points, bitmaps, mirrors, shadows, several samples per pixel, all kinds of textures that packs support."""
from helpers import BUILD, SCRATCH, check, corpus, finish, record, relume, render

FAMILIES = ("packets", "binary", "compressed")
PROGRAMS = {
    "mirror": (corpus("cornell"), "--frames", "1", "--mesh", "--mirror"),
    "glass": (corpus("still_life"), "--frames", "1"),
    "spheres": (corpus("spheres"), "--frames", "1", "--size", "300x200"),
    "shapes": (BUILD / "tests/real/shapes",),
    "pixels": (BUILD / "tests/real/pixels",),
    "samples": (BUILD / "tests/real/samples",),
    "surfaces": (BUILD / "tests/real/surfaces",),
}

for name, program in PROGRAMS.items():
    trace = SCRATCH / f"{name}.trace"
    if not record(trace, *program, options=(), optional=name == "samples"):
        continue
    for device in ("0", "reference"):
        pictures = {
            family: render(trace, SCRATCH / f"{name}-{device}-{family}", "--device", device, "--kernels", family)
            for family in FAMILIES
        }
        for family in FAMILIES[1:]:
            check(pictures[family], f"{name}, device {device}, kernels {family}: no pictures")
            differ = [
                b.name
                for a, b in zip(pictures["packets"], pictures[family], strict=True)
                if a.read_bytes() != b.read_bytes()
            ]
            check(not differ, f"{name}, device {device}: kernels {family} leave other files than packets: {differ}")
bad = relume("render", trace, "-o", SCRATCH / "no.#.exr", "--kernels", "wide")
check(bad.returncode == 2 and "packets, binary or compressed" in bad.stderr and bad.stderr.count("\n") == 1,
      f"--kernels wide ends with {bad.returncode}: {bad.stderr}")
finish()
