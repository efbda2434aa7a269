#!/usr/bin/python3
# limit: 300 s
"""relume film: the pictures that it passes to ffmpeg, their durations, and the page that plays the film.

A fake ffmpeg keeps the pictures, decoded by the real one; `make show-film` makes whole films.
"""
import json
import os
import shutil

import numpy

from codes import whole_codes
from helpers import SCRATCH, check, corpus, finish, must, record, relume, run

bin_dir = SCRATCH / "bin"
bin_dir.mkdir()
(bin_dir / "ffmpeg").write_text(f"""#!/usr/bin/python3
import subprocess, sys
if "broken" in sys.argv[-1]:
    sys.exit("no such encoder")
kind, rate = (sys.argv[sys.argv.index(option) + 1] for option in ("-f", "-r"))
shown = subprocess.run([{shutil.which("ffmpeg")!r}, "-loglevel", "error", "-f", kind, "-r", rate, "-i", "pipe:0",
                        "-f", "image2pipe", "-c:v", "ppm", "pipe:1"], stdout=subprocess.PIPE, check=True).stdout
size = shown.split(b"\\n", 2)[1]
head = b"P6\\n" + size + b"\\n255\\n"
width, height = map(int, size.split())
length = len(head) + 3 * width * height
with open(sys.argv[-1], "wb") as out:
    out.write(b"%dx%d %s\\n" % (width, height, rate.encode()))
    for at in range(0, len(shown), length):
        out.write(shown[at + len(head):at + length])
""")
(bin_dir / "ffmpeg").chmod(0o755)
fake = dict(os.environ, PATH=f"{bin_dir}:{os.environ['PATH']}")

trace = SCRATCH / "still.trace"
frames, chunks, pngs = SCRATCH / "frames", SCRATCH / "chunks", SCRATCH / "pngs"
record(trace, corpus("still_life"), "--frames", "4", options=("--ref", "color"))
must(relume("render", trace, "-o", frames / "s.####.exr"))
must(relume("render", trace, "-o", pngs / "s.####.png"))
for i in (1, 2, 3, 4):
    must(relume("render", trace, "-o", chunks / "s.####.exr", "--chunk", f"{i}/4"))


def film(name, *options, of=frames, code=0, env=fake):
    """Make a film; returns its pictures and their rate."""
    done = relume("film", of, "-o", SCRATCH / name, *options, env=env)
    check(done.returncode == code,
          f"film {name} {options}: exit code {done.returncode}, expected {code}: {done.stderr}")
    if code:
        left = [p.name for p in SCRATCH.glob(f"{name}*")]
        check(not left, f"a failed film leaves nothing: {left}")
        return done.stderr
    head, data = (SCRATCH / name).read_bytes().split(b"\n", 1)
    size, rate = head.decode().split()
    width, height = map(int, size.split("x"))
    return numpy.frombuffer(data, numpy.uint8).reshape(-1, height, width, 3), int(rate)


# Side by side: the program's picture, and the display picture made by render.
must(relume("raster", trace, "-f", "1", "-o", SCRATCH / "raster.####.png"))
shown, traced = whole_codes(SCRATCH / "raster.0001.png"), whole_codes(pngs / "s.0001.png")
height, width, _ = shown.shape
pictures, rate = film("plain.webm", "--fps", "25", "--no-labels")
check(rate == 25 and pictures.shape == (4, height, 2 * width + 4, 3),
      f"four pictures at 25 a second: {rate}, {pictures.shape}")
check((pictures[1, :, :width] != shown).mean() < 0.001, "on the left the program's picture")
check((pictures[1, :, width + 4:] == traced).all(), "on the right render's picture")
check((pictures[:, :, width:width + 4] == 0).all(), "a gap between them")
again, _ = film("chunks.webm", "--fps", "25", "--no-labels", of=chunks)
check((again == pictures).all(), "frames rendered in four chunks give the same film")

# One picture alone, for some frames; both in turn; a moving divider.
pictures, _ = film("traced.mp4", "--fps", "10", "--no-labels", "--layout", "traced", "-f", "1-2")
check(len(pictures) == 2 and (pictures[0] == traced).all(), "traced alone")
pictures, _ = film("raster.mkv", "--fps", "10", "--no-labels", "--layout", "raster", "--raster", trace, of=pngs)
check(len(pictures) == 4 and (pictures[1] == shown).mean() > 0.999, "PNG frames, with the recorded reference")
pictures, _ = film("turns.webm", "--fps", "1", "--no-labels", "--layout", "alternate")
kinds = [(numpy.abs(p.astype(int) - shown).mean() < numpy.abs(p.astype(int) - traced).mean()) for p in pictures]
check(set(kinds) == {True, False}, f"alternating: {kinds}")
pictures, _ = film("wipe.webm", "--fps", "4", "--no-labels", "--layout", "wipe")
lines = [int((p == 255).all(axis=(0, 2)).argmax()) for p in pictures]
check(len(set(lines)) == 4 and abs(lines[0] - width // 2) < 4, f"the divider moves from the middle: {lines}")

# Labels are in a strip below the pictures.
pictures, _ = film("labels.webm", "--fps", "25", "--caption", "a still life")
strip = pictures[0, height:]
check(pictures.shape[1] > height and strip[:, :200].max() > 200 and strip[:, width + 4:width + 200].max() > 200,
      "labels")
check((pictures[1, :height, width + 4:] == traced).all(), "labels cover no picture")
check((SCRATCH / "labels.jpg").stat().st_size > 10000, "a poster")

# White level: taken from the frames, but at least 1. The program's picture is not scaled, and is white at 1 and above.
said = {}
for name, change in (("four", ("--sattrib", "relume:white", "4")), ("quarter", ("--sattrib", "relume:white", "0.25")),
                     ("bright", ("--mulc", "2"))):
    (SCRATCH / name).mkdir()
    must(run("oiiotool", frames / "s.0001.exr", *change, "-d", "float", "-o", SCRATCH / name / "s.0001.exr"))
    said[name] = film(f"{name}.webm", "--fps", "25", "--no-labels", of=SCRATCH / name)[0][0]
asked = film("asked.webm", "--fps", "25", "--no-labels", "-f", "1", "--white", "4")[0][0]
check((said["four"] == asked).all() and (asked[:, width + 4:] != traced).any(),
      "frames that record white as 4 look like --white 4")
check((said["quarter"][:, width + 4:] == traced).all(), "a white level of a quarter is refused")
for what, was, now in (("the program's picture", shown, said["bright"][:, :width]), ("the frame", traced,
                                                                                       said["bright"][:, width + 4:])):
    above = was >= 190  # above half of white, which doubling makes white
    check(above.any() and (now[above] == 255).all(), f"values beyond white are white in {what}")

# Without --fps, a frame is shown as long as the program showed it, according to the recording's times.
pictures, rate = film("times.webm", "--no-labels", "--layout", "raster")
times = [
    int(line.split()[1])
    for p in sorted(frames.glob("*.exr"))
    for line in must(run("oiiotool", "--info", "-v", p)).stdout.replace('"', "").splitlines()
    if "relume:time" in line
]
gaps = [min(b - a, 2e9) / 1e9 for a, b in zip(times, times[1:])]
check(
    len(times) == 4 and rate == (60 if sum(gap < 1 / 45 for gap in gaps) > 1.5 else 30),
    f"times are known: {gaps}, {rate}")
check(
    abs(len(pictures) - rate * sum(max(gap, 1 / rate) for gap in [*gaps, gaps[-1]])) <= 1,
    f"{len(pictures)} pictures at {rate} for {gaps}")


def timed(name, *milliseconds):
    """The same four frames with other durations."""
    (SCRATCH / name).mkdir()
    now = 10 ** 12
    for i, ms in enumerate((0, *milliseconds)):
        now += int(ms * 1e6)
        must(
            run("oiiotool", frames / f"s.{i:04}.exr", "--sattrib", "relume:time", now, "-d", "float", "-o",
                SCRATCH / name / f"s.{i:04}.exr"))
    done = relume("film", SCRATCH / name, "-o", SCRATCH / f"{name}.webm", "--layout", "traced", "--no-labels", env=fake)
    head, data = (SCRATCH / f"{name}.webm").read_bytes().split(b"\n", 1)
    return int(head.split()[1]), len(data) // (3 * width * height), "faster than films go" in done.stderr


# Every frame is shown, however fast the program was; programs that dropped none are shown as before.
check(timed("unbound", 2, 2, 2) == (60, 4, True), "500 frames a second: each of four frames is one picture")
check(timed("monitor", 16.7, 16.7, 16.7) == (60, 4, False), "60 frames a second: no frame is dropped")
check(timed("slow", 100, 100, 100) == (30, 12, False), "10 frames a second: three pictures each")
check(timed("once", 100, 2, 100) == (30, 10, True), "a frame of no duration is shown, too")

# Panoramas and stereo pictures are marked as such.
for name, projection, eyes, seen in (("around", "panorama", None, ("Spherical Mapping", None)),
                                     ("omni", "panorama", "left above right", ("Spherical Mapping", "top and bottom")),
                                     ("stereo", "stereo", "side by side", (None, "side by side")),
                                     ("cube", "cube", None, (None, None))):
    (SCRATCH / name).mkdir()
    eyes = ("--sattrib", "relume:eyes", eyes) if eyes else ()
    must(run("oiiotool", frames / "s.0001.exr", "--sattrib", "relume:projection", projection, *eyes, "-d", "float",
             "-o", SCRATCH / name / "s.0001.exr"))
    for ending in ("mp4", "webm", "mkv"):
        path = SCRATCH / f"{name}.{ending}"
        must(relume("film", SCRATCH / name, "--layout", "traced", "--fps", "25", "-o", path))
        probed = must(run("ffprobe", "-v", "error", "-show_streams", "-of", "json", path)).stdout
        stream = json.loads(probed)["streams"][0]
        sides = {side["side_data_type"]: side for side in stream.get("side_data_list", ())}
        check(("Spherical Mapping" if "Spherical Mapping" in sides else None) == seen[0], f"{path.name}: {list(sides)}")
        eyes_told = sides.get("Stereo 3D", {}).get("type")
        if ending == "mp4":  # an extra box beside that of Spherical Video V2 confuses ffprobe 7
            box = path.read_bytes().partition(b"st3d")[2]
            eyes_told = (None, "top and bottom", "side by side")[box[4] if box else 0]
        check(eyes_told == seen[1], f"{path.name}: eyes {eyes_told}, expected {seen[1]}")
        check((stream["height"] == height) == (name != "cube"), f"{path.name}: no labels in panoramas")
done = relume("film", SCRATCH / "around", "--fps", "25", "-o", SCRATCH / "beside.webm")
check(done.returncode == 0 and "will not show the film as a panorama" in done.stderr, f"beside: {done.stderr}")

# Invalid requests.
check("ffmpeg" in film("none.webm", code=5, env=dict(fake, PATH="/nowhere")), "without ffmpeg: its package is named")
check("ffmpeg" in film("broken.webm", code=5), "an ffmpeg that fails")
said = film("film.avi", code=2)
check(all(kind in said for kind in (".webm", ".mp4", ".mkv")), f"the known endings are listed: {said}")
check("--raster" in film("gl.webm", of=pngs, code=3), "PNG frames contain no raster picture")
check("none of the frames" in film("far.webm", "-f", "77", code=3), "no such frame")

# The report plays the film.
done = relume("diff", trace, frames, "--report", SCRATCH / "report", "--film", SCRATCH / "plain.webm")
page = (SCRATCH / "report/index.html").read_text()
check(done.returncode == 0 and page.count('id="film">"data:video/webm;base64,') == 1,
      f"a page with a film: {done.stderr}")
check(
    relume("diff", trace, frames, "--film", SCRATCH / "plain.webm").returncode == 2, "without a page there is no film")
check(
    relume("diff", trace, frames, "--report", SCRATCH / "none", "--film", SCRATCH / "none.webm").returncode == 3,
    "no such film")
finish()
