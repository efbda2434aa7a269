#!/usr/bin/python3
"""relume render --noise, --time, --preview, --denoise: when sampling stops, the preview shown meanwhile, and
independence of the options.

limit: 300 s
"""
import signal
import subprocess
import time

from exr import Image
from helpers import RELUME, SCRATCH, check, corpus, finish, must, record, relume

trace = SCRATCH / "box.trace"
record(trace, corpus("cornell"), "--frames", "2", "--size", "64x48", options=())


def render(name, *options):
    return relume("render", trace, "-f", "1", "-o", SCRATCH / name, "--mode", "path", *options, timeout=600)


def planes(name):
    return Image(SCRATCH / name).planes


def samples(name):
    return int(Image(SCRATCH / name).attributes.get("relume:samples", b"0"))


def error(name, truth):
    """Root mean square error relative to the mean, of green."""
    here, there = ([v for row in p["G"] for v in row] for p in (planes(name), truth))
    return (sum((a - b) ** 2 for a, b in zip(here, there)) / len(there)) ** 0.5 / (sum(there) / len(there))


def off(name, truth):
    """Mean difference over the nine tenths of pixels that differ least, which excludes edges."""
    here, there = ([v for row in p["G"] for v in row] for p in (planes(name), truth))
    return sum(sorted(abs(a - b) for a, b in zip(here, there))[:len(there) * 9 // 10])


must(render("all.exr", "--samples", "16"))
must(render("shown.exr", "--samples", "16", "--preview", SCRATCH / "shown.png"))
check((SCRATCH / "all.exr").read_bytes() == (SCRATCH / "shown.exr").read_bytes(), "a preview changes nothing")
check((SCRATCH / "shown.png").read_bytes()[:4] == b"\x89PNG", "the preview is a PNG file")

# Noise: repeatable bytes, more samples for a lower bound, and a noise within the requested one.
must(render("coarse.exr", "--noise", "0.2"))
must(render("fine.exr", "--noise", "0.06"))
must(render("again.exr", "--noise", "0.06", "--jobs", "1", "--threads", "1"))
must(render("truth.exr", "--samples", "512"))
check((SCRATCH / "fine.exr").read_bytes() == (SCRATCH / "again.exr").read_bytes(),
      "--noise: the same input gives the same bytes")
check(0 < samples("coarse.exr") < samples("fine.exr") < 512,
      f"samples: {samples('coarse.exr')} and {samples('fine.exr')}")
truth = planes("truth.exr")
for name, bar in (("coarse.exr", 0.2), ("fine.exr", 0.06)):
    check(bar / 6 < error(name, truth) < bar, f"{name}: noise {error(name, truth):.4f}, requested {bar}")
must(render("most.exr", "--noise", "0.000001", "--samples", "8"))
must(render("eight.exr", "--samples", "8"))
check(planes("most.exr") == planes("eight.exr"), "--samples is the maximum")

# Time: there is always at least one sample.
must(render("short.exr", "--time", "0.000001"))
check(samples("short.exr") == 2, f"no time: {samples('short.exr')} samples")
must(render("long.exr", "--time", "1000", "--samples", "8"))
check(planes("long.exr") == planes("eight.exr"), "ample time: as many samples as requested")

# A preview is a complete file at all times, and improves.
preview = SCRATCH / "growing" / "1.exr"
child = subprocess.Popen([
    RELUME, "render", trace, "-f", "1", "-o", SCRATCH / "killed.exr", "--mode", "path", "--samples", "65536", "--aov",
    "gl", "--preview", preview
], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
seen = []
begin = time.monotonic()
while len(seen) < 6 and time.monotonic() - begin < 90 and child.poll() is None:
    if preview.exists():
        picture = Image(preview)
        if not seen or picture.planes["G"] != seen[-1]:
            seen.append(picture.planes["G"])
    time.sleep(0.05)
child.send_signal(signal.SIGTERM)
check(child.wait(60) == 143, "SIGTERM ends it")
check(len(seen) == 6, f"{len(seen)} previews were seen")
first, last = (error("truth.exr", {"G": picture}) for picture in (seen[0], seen[-1]))
check(last < 0.3 and last < max(first, 0.1),
      f"they show the frame, and improve down to truth.exr's own noise: off by {first:.3f}, then {last:.3f}")
check(not list(preview.parent.glob("*.part")), "no partial file is left")

# Denoised: less noise; display pictures are denoised, too; relume denoise gives the same bytes without neighbouring
# frames.
must(render("noisy.exr", "--samples", "4"))
must(render("clean.exr", "--samples", "4", "--denoise"))
check(
    off("clean.exr", truth) < 0.6 * off("noisy.exr", truth),
    f"noise {off('noisy.exr', truth):.4f} becomes {off('clean.exr', truth):.4f}")
must(relume("denoise", SCRATCH / "noisy.exr", "-o", SCRATCH / "later.exr"))
check(planes("later.exr") == planes("clean.exr"), "relume denoise gives the same bytes")
must(render("clean.png", "--samples", "4", "--denoise"))
must(render("noisy.png", "--samples", "4"))
check((SCRATCH / "clean.png").read_bytes() != (SCRATCH / "noisy.png").read_bytes(), "PNG files are denoised")

for options, word in ((("--denoise", "--aov", "gl,N,Z"), "reflect"), (("--denoise", "--mode", "gl"), "mode gl"),
                      (("--preview", "x.tif"), ".png"), (("--preview", SCRATCH / "bad.exr"), "own name"),
                      (("--time", "0"), "seconds"), (("--noise", "-1"), "--noise")):
    bad = render("bad.exr", *options)
    check(bad.returncode == 2 and word in bad.stderr and len(bad.stderr.strip().splitlines()) == 1,
          f"{options}: {bad.returncode} {bad.stderr}")
finish()
