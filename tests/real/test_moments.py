#!/usr/bin/python3
"""`relume render --fps`: pictures between recorded frames equal the program's own at these times. Compares
tests/real/moments.c at 15 frames per second with itself at 60.

limit: 300 s
"""
import json

import numpy

import exr
from helpers import BUILD, SCRATCH, check, finish, must, record, relume, render

SLOW, FAST, COUNT = 15, 60, 61
MOST_FLIP = 0.02
CUT = range(29, 32)  # between the frames on both sides of half a second
BARS = (slice(220, 240), slice(0, 110))  # the digits over the picture: rows, columns

traces = {fps: SCRATCH / f"{fps}.trace" for fps in (SLOW, FAST)}
for fps, trace in traces.items():
    record(trace, BUILD / "tests/real/moments", fps)
FILM = ("--fps", FAST, "--recorded-fps", SLOW)


def flips(reference, pictures):
    """Mean FLIP of each frame."""
    done = relume("diff", reference, pictures, "--channel", "beauty", "--json", "-", timeout=300)
    return [frame["gates"]["P"]["figures"][0]["value"] for frame in json.loads(done.stdout)["frames"]]


def planes_of(file, names=("R", "G", "B", "gl.R", "gl.G", "gl.B", "Z", "shadow.R", "id")):
    image = exr.Image(file, names)
    return {name: numpy.asarray(image.planes[name]) for name in names}


def text_of(file, name):
    text = exr.attribute(file, name)
    return text if text is None else text.decode()


render(traces[FAST], SCRATCH / "shown")
files = render(traces[SLOW], SCRATCH / "film", *FILM)
plain = render(traces[SLOW], SCRATCH / "plain")
figures = flips(SCRATCH / "shown", SCRATCH / "film")
check(len(figures) == COUNT, f"{len(figures)} pictures of a second: {COUNT}")
worst = max((value, number) for number, value in enumerate(figures) if number not in CUT)
check(worst[0] <= MOST_FLIP, f"FLIP against the program's picture: {worst[0]:.4f} in picture {worst[1]}")
check(all(value == 0 for value in figures[::FAST // SLOW]), "at recorded times, pictures equal the frames")
check(sum(figures[k] > 0 for k in range(COUNT) if k % 4) > 30, "other pictures are interpolated, not recorded")

check([text_of(files[k], "relume:between") for k in CUT] == ["cut"] * 3, "the cut is detected")
check(not any(text_of(file, "relume:between") == "cut" for k, file in enumerate(files) if k not in CUT),
      "no other cut is detected")
check(all(text_of(file, "relume:moment") == f"{k // 4} + {k % 4 / 4:.6f}" for k, file in enumerate(files)),
      "files record their moments")
shown = [int(text_of(file, "relume:time")) for file in files]
check(all(abs(b - a - 1e9 / FAST) < 2 for a, b in zip(shown, shown[1:])),
      "files record their times, from the given rates")
for k in (0, 24, 60):
    made, own = planes_of(files[k]), planes_of(plain[k // 4])
    check(all((made[name] == own[name]).all() for name in made), f"picture {k} is frame {k // 4}, in all planes")
for k in (5, 6, 30):
    made, own = (planes_of(file, ("gl.R", ))["gl.R"][BARS] == 1 for file in (files[k], plain[(k + 2) // 4]))
    check(made.any() and (made == own).all(), f"picture {k} has the text of the nearer frame")

done = relume("render", traces[SLOW], *FILM, "--skip-existing", "-o", SCRATCH / "film" / f"{SLOW}.####.exr")
check(done.returncode == 0 and f"{COUNT} were there already" in done.stderr, "existing pictures are kept")
part = render(traces[SLOW], SCRATCH / "part", *FILM, "--chunk", "2/3")
check([file.name for file in part] == [file.name for file in files[20:40]], "part of the pictures")
check(all((planes_of(file)["R"] == planes_of(files[20 + k])["R"]).all() for k, file in enumerate(part)),
      "any part has the same pictures")
some = render(traces[SLOW], SCRATCH / "some", *FILM, "-f", "3-5")
check(len(some) == 9 and (planes_of(some[1])["R"] == planes_of(files[13])["R"]).all(), "between the frames that -f names")
began, ended = (int(text_of(plain[k], "relume:time")) for k in (0, 4))
clock = render(traces[SLOW], SCRATCH / "clock", "--fps", 4.5e9 / (ended - began), "-f", "0-4")
check(len(clock) == 5 and text_of(clock[0], "relume:moment") == "0 + 0.000000", "by the recorded clock")
times = [int(text_of(file, "relume:time")) for file in clock]
check(all(abs(4.5 * (time - began) / (ended - began) - k) < 0.01 for k, time in enumerate(times)),
      "evenly, by the recorded clock")

torn = SCRATCH / "torn.trace"
whole = traces[SLOW].read_bytes()
torn.write_bytes(whole[:-6000] + bytes(500) + whole[-5500:])
(SCRATCH / "torn").mkdir()
done = relume("render", torn, *FILM, "-o", SCRATCH / "torn" / f"{SLOW}.####.exr")
saved = sorted((SCRATCH / "torn").glob("*.exr"))
check(done.returncode == 3 and 4 < len(saved) < COUNT and len(saved) % 4 == 1, f"up to the damage: {len(saved)} pictures")
check(all(text_of(file, "relume:moment") == f"{k // 4} + {k % 4 / 4:.6f}" for k, file in enumerate(saved)),
      "the saved pictures are the same moments")

done = relume("diff", traces[SLOW], SCRATCH / "film")
check(done.returncode != 0 and "made with --fps" in done.stdout, "recorded frames cannot score moments")
for options, words in ((("--recorded-fps", 15), "--recorded-fps is for --fps"),
                       ((*FILM, "-f", "1-9x2"), "from one frame to another")):
    done = relume("render", traces[SLOW], *options, "-o", SCRATCH / "x.####.exr")
    check(done.returncode == 2 and words in done.stderr, f"{' '.join(map(str, options))}: {done.stderr.strip()}")

files = render(traces[SLOW], SCRATCH / "single", *FILM, "-f", "0-15")
farm = SCRATCH / "farm"
farm.mkdir()
must(relume("farm", "submit", "--local", traces[SLOW], "-f", "0-15", "--chunk", 25, "-o", farm / f"{SLOW}.####.exr",
            "--", *FILM))
made = sorted(farm.glob("*.exr"))
check([file.read_bytes() for file in made] == [file.read_bytes() for file in files], "a farm makes the same pictures")
made[40].unlink()
done = relume("farm", "status", farm / f"{SLOW}.farm")
check(done.returncode == 1 and f"frames {COUNT - 1} of {COUNT} whole" in done.stdout and "frame 40\n" in done.stdout,
      f"status lists the missing picture: {done.stdout}")
done = relume("farm", "retry", farm / f"{SLOW}.farm")
check(done.returncode == 0 and made[40].read_bytes() == files[40].read_bytes(),
      f"retry renders the missing picture: {done.stderr}")
script = must(relume("farm", "script", "--for", "make", traces[SLOW], "-f", "0-15", "--chunk", 25, "-o",
                     farm / f"{SLOW}.####.exr", "--", *FILM)).stdout
check("seq 1 3" in script and "--chunk $*/3" in script and "diff" not in script, f"three tasks: {script}")
done = relume("render", traces[SLOW], *FILM, "-f", "1-15", "--skip-existing", "--dry-run", "-o",
              SCRATCH / "film" / f"{SLOW}.####.exr")
check("leave" not in done.stdout, "numbering from another frame is refused")
finish()
