#!/usr/bin/python3
# limit: 500 s
"""Bad input to every verb: one clear line, the right exit code, and no file under a final name."""
import pathlib
import random
import re
import resource
import signal
import struct
import zlib

from helpers import RELUME, SCRATCH, check, corpus, finish, record, relume, render, run

USAGE, INPUT, SYSTEM = 2, 3, 5
WORK = SCRATCH / "out"
PROGRESS = re.compile(r"(rendered|scored|rasterized) frame \d+")


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(path):
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(b"\0\xff\0\0")) + chunk(b"IEND", b""))


def left_behind():
    return [str(p) for p in WORK.rglob("*") if p.is_file()]


def refused(done, code, what):
    """Require one line on standard error, the exit code, and no new file."""
    lines = [line for line in done.stderr.splitlines() if not PROGRESS.match(line)]
    check(done.returncode == code, f"{what}: exit code {done.returncode}, expected {code}: {done.stderr}")
    check(len(lines) == 1 and lines[0].startswith("relume: "), f"{what}: one line that begins with 'relume: ': {lines}")
    check(not left_behind(), f"{what}: left behind {left_behind()}")


def limit_file_size():
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))


WORK.mkdir()
good = SCRATCH / "good.trace"
record(good, corpus("two_triangles"), "--frames", "3")
frames = SCRATCH / "frames"
render(good, frames)

# Each verb that reads a trace, with the trace's name as a parameter.
READERS = {
    "info": lambda t: ["info", t],
    "dump": lambda t: ["dump", t],
    "scene": lambda t: ["scene", t, "-f", "0"],
    "pick": lambda t: ["pick", t, "-f", "0", "9,9"],
    "render": lambda t: ["render", t, "-o", WORK / "x.####.exr"],
    "raster": lambda t: ["raster", t, "-o", WORK / "x.####.png"],
    "diff": lambda t: ["diff", t, frames, "--report", WORK / "report"],
}

cut = SCRATCH / "cut.trace"
missing, empty, picture = SCRATCH / "missing.trace", SCRATCH / "empty.trace", SCRATCH / "picture.trace"
empty.touch()
write_png(picture)
for verb, arguments in READERS.items():
    for kind, path in (("missing file", missing), ("directory", SCRATCH), ("empty file", empty), ("PNG", picture)):
        refused(relume(*arguments(path)), INPUT, f"{verb} of a {kind}")
    check(relume(verb).returncode == USAGE, f"{verb} of nothing")

for verb in ("scene", "pick", "render"):
    arguments = READERS[verb](good)
    arguments = [a for a in arguments if a not in ("-f", "0")]
    done = relume(*arguments, "-f", "7")
    refused(done, USAGE, f"{verb} of a frame outside the trace")
    check(done.stderr.endswith(f"{good}: there is no frame 7; the trace has 3 frames (0 to 2)\n"),
          f"{verb} says which frames there are: {done.stderr}")
    refused(relume(*arguments, "-f", "1-x"), USAGE, f"{verb} of a range that is none")

refused(relume("farm", "script", "--for", "make", good, "-f", "1-", "-o", WORK / "x.####.exr"), USAGE,
        "a farm's job without an end")
listed = relume("render", good, "-f", "1-", "-o", WORK / "x.####.exr", "--dry-run")
check(listed.returncode == 0 and [line.split(":")[0] for line in listed.stdout.splitlines()] == ["frame 1", "frame 2"],
      f"from 1 to the end: {listed.stdout}")
refused(relume("render", good, "-f", "9-", "-o", WORK / "x.####.exr"), USAGE, "a range that begins behind the end")

# A plain file instead of a folder: not even root can write below it.
blocked = SCRATCH / "good.trace"
refused(relume("render", good, "-o", blocked / "x.####.exr"), SYSTEM, "render into a file")
refused(relume("diff", good, frames, "--report", blocked / "report"), SYSTEM, "diff's report into a file")
refused(run(RELUME, "record", "-o", blocked / "x.trace", "--", "true"), SYSTEM, "record into a file")
refused(run(RELUME, "record", "-o", WORK / "x.trace", "--", "no-such-program"), SYSTEM, "record of a missing program")
refused(run(RELUME, "render", good, "-o", WORK / "x.####.exr", "--device", "reference",
            preexec_fn=limit_file_size), SYSTEM, "render to a full disk")

done = relume("render", good, "-o", WORK / "x.exr")
refused(done, USAGE, "render of several frames into one name")
check("3 frames: write " in done.stderr and f"{WORK}/x.####.exr, or name one frame with -f" in done.stderr,
      f"says how many frames, and what to do: {done.stderr}")
refused(relume("render", missing, "-o", WORK / "x.exr"), INPUT, "a missing trace is reported before the name")
refused(relume("render", good, "-o", WORK / ".png"), USAGE, "an ending without a name")
refused(relume("render", good, "-o", WORK / "x.####.exr", "-j", "0"), USAGE, "no frame in flight")
for words, text in ((("render", good), "but -o is missing"),
                    (("render", good, cut, "-o", "x.####.exr"), f"and '{cut}' is one too many"),
                    (("farm",), "takes submit, script"), (("farm", "--nosuch"), "no option '--nosuch'"),
                    (("dump", "-c", "x", good), "'x' is not a range of calls"),
                    (("dump", "-c", "99999-", good), "there is no call 99999; the trace has ")):
    done = relume(*words)
    refused(done, USAGE, " ".join(map(str, words)))
    check(text in done.stderr, f"{' '.join(map(str, words))}: {done.stderr}")
refused(relume("render", good, "-o", WORK / "x.####.exr", "--device", "no such device"), USAGE, "render on no device")
refused(relume("diff", good, SCRATCH / "no-frames"), INPUT, "diff with a missing folder")
empty_folder = SCRATCH / "none"
empty_folder.mkdir()
refused(relume("diff", good, empty_folder), INPUT, "diff with a folder without frames")

# Reference frames that are cut short, and a layer that no frame has.
references, part = good.with_suffix(".ref").read_bytes(), SCRATCH / "part.ref"
part.write_bytes(references[:-1])
done = relume("diff", part, frames)
check(done.returncode == 0 and done.stderr.count(f"warning: {part}: is cut short in frame 2; ") == 1,
      f"without the last frame's depth: {done.returncode}, {done.stderr}")
part.write_bytes(references[:len(references) // 2])
done = relume("diff", part, frames)
check(done.returncode == INPUT and done.stderr.count(f"warning: {part}: is cut short ") == 1
      and "unreadable" in done.stdout, f"without later frames: {done.returncode}, {done.stderr}{done.stdout}")
done = relume("diff", good, frames, "--channel", "foo")
refused(done, USAGE, "a layer that no frame has")
check(f"{frames}: there is no layer 'foo'; --channel may be beauty, " in done.stderr and ", gl, " in done.stderr,
      f"the layers: {done.stderr}")
check(relume("diff", good, frames, "--channel", "gl").returncode == 0, "the layer gl, against recorded frames")

# A trace cut at any point is read up to its last whole call, or refused.
data = good.read_bytes()
rng = random.Random(1)
for size in sorted({1, 2, 3, 6, 7, len(data) - 1, *(rng.randrange(len(data)) for _ in range(200))}):
    cut.write_bytes(data[:size])
    done = relume("info", cut)
    check(done.returncode in (0, INPUT) and len(done.stderr.splitlines()) <= 1,
          f"info of the first {size} bytes: exit code {done.returncode}, {done.stderr}")
cut.write_bytes(data[:len(data) // 8])
done = relume("scene", cut)
said = done.stderr.splitlines()
check(done.returncode == INPUT and "relume repair" in said[0] and said[-1].endswith("holds no whole frame"),
      f"a recording without a frame: {said}")
cut.write_bytes(data[:-1])
for when in ("first", "then from its index"):
    done = relume("render", cut, "-f", "1", "-o", WORK / "cut.png", "--device", "reference")
    check(done.returncode == 0 and done.stderr.count("the file is cut short after call") == 1,
          f"a recording that lacks its last byte, {when}: exit code {done.returncode}: {done.stderr}")
for path in map(pathlib.Path, left_behind()):
    path.unlink()
for size in (2, len(data) // 3, len(data) // 2, len(data) - 1):
    cut.write_bytes(data[:size])
    for verb, arguments in READERS.items():
        done = relume(*arguments(cut))
        check(done.returncode in (0, 1, USAGE, INPUT), f"{verb} of the first {size} bytes: exit code {done.returncode}")
        for path in map(pathlib.Path, left_behind()):
            path.unlink()
finish()
