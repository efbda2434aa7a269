#!/usr/bin/python3
"""The last lines of a run: on how many pixels tracing added each kind of light. They must match the channels, whether
the file contains these or not."""
import re

from exr import Image
from helpers import SCRATCH, check, corpus, finish, must, record, relume

PARTS = {"shadows": ("shadow", 1), "other light": ("relight", 0), "mirrors": ("reflect", 0), "glass": ("refract", 0)}
LINE = re.compile(r"^  tracing added (.*)$", re.M)


def shares(images):
    """Percentage of pixels where each kind contributes, from the channels."""
    counts, pixels = dict.fromkeys(PARTS, 0), 0
    for image in images:
        pixels += image.width * image.height
        for name, (group, nothing) in PARTS.items():
            planes = [[v for row in image.planes[f"{group}.{c}"] for v in row] for c in "RGB"]
            counts[name] += sum(any(v != nothing for v in values) for values in zip(*planes))
    return {name: 100 * n / pixels for name, n in counts.items() if n}


def said(text):
    line = LINE.search(text)
    shares = line and re.findall(r"(\w[\w ]*?) on ((?:under )?[\d.]+) %", line[1])
    return None if shares is None else dict(shares)


def render(trace, name, *options):
    return must(relume("render", trace, "-o", SCRATCH / name, *options)).stderr


for program, options in (("spheres", ()), ("still_life", ()), ("still_life", ("--relight",))):
    trace = SCRATCH / f"{program}.trace"
    if not trace.exists():
        record(trace, corpus(program), "--frames", "3", "--size", "160x120", options=())
    text = render(trace, f"{program}.####.exr", *options)
    wanted = {
        name: f"{share:.0f}" if share >= 1 else f"{share:.1g}" if share >= 0.01 else "under 0.01"
        for name, share in shares(map(Image, sorted(SCRATCH.glob(f"{program}.*.exr")))).items()
    }
    check(wanted and said(text) == wanted, f"{program} {options}: {said(text)}, by the channels {wanted}: {text}")
    check(said(render(trace, "x.####.png", *options)) == wanted, f"{program} {options}: display pictures: the same")
    check(
        said(render(trace, "x.####.exr", "--aov", "gl", "-j", 1, *options)) == wanted,
        f"{program} {options}: files without these channels: the same lines")
    check(
        said(render(trace, "x.####.exr", "--skip-existing", "--aov", "gl", *options)) is None,
        f"{program} {options}: nothing traced, no line")
    check("tracing added" not in render(trace, "x.####.exr", "--progress", "none", *options),
          f"{program} {options}: --progress none")
check("glass" in said(render(SCRATCH / "spheres.trace", "x.####.exr")), "spheres: glass is named")
check("other light" in wanted, f"lit at each pixel: {wanted}")
check("tracing added" not in render(trace, "x.####.exr", "--mode", "gl"), "mode gl never adds anything")
check("light from surface to surface on" in render(trace, "x.####.exr", "--mode", "path", "--samples", "2", "-f", 0),
      "mode path")
two = SCRATCH / "two.trace"
record(two, corpus("two_triangles"), "--frames", "1", "--size", "160x120", options=())
text = render(two, "two.####.png")
check("tracing added nothing" in text and "--look auto" in text and "--mode path" in text and "brighter" not in text,
      f"advice if nothing is added: {text}")

finish()
