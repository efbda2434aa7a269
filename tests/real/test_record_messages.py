#!/usr/bin/python3
"""Messages of relume record about a program that draws, each printed once: files that cannot be written, shaders, no
frames."""
from helpers import BUILD, RELUME, SCRATCH, check, finish, must, on_display

PROGRAM = BUILD / "tests/trace/frames"  # ten frames


def record(name, *program, options=(), code=0):
    done = on_display(RELUME, "record", "-o", SCRATCH / name, *options, "--", *program)
    check(done.returncode == code, f"{name}: exit code {done.returncode}, expected {code}: {done.stderr}")
    return done.stderr


def times(text, words, wanted, what):
    check(text.count(words) == wanted, f"{what}: \"{words}\" {text.count(words)} times, expected {wanted}, in: {text}")


said = record("plain.trace", PROGRAM)
times(said, "plain.trace: 10 frames, ", 1, "a program of ten frames")
times(said, "relume: ", 1, "one line")

# Reference frames cannot be written: the recording continues, the reason is printed once, and the exit code reports
# that they are missing.
(SCRATCH / "folder.ref").mkdir()
said = record("folder.trace", PROGRAM, options=("--ref", "color"), code=5)
times(said, "folder.trace: 10 frames, ", 1, "without reference frames")
times(said, "folder.ref: cannot open: Is a directory: no more reference frames; the recording goes on without them", 1,
      "a folder in its place")
times(said, "no more reference frames", 1, "said once")
times(said, "bytes of reference frames", 0, "there are none")

# The trace's folder is removed before the program's first call: the program draws as usual.
(SCRATCH / "gone").mkdir()
said = record("gone/x.trace", "sh", "-c", f"rmdir {SCRATCH}/gone && exec {PROGRAM}", code=5)
times(said, "cannot create: No such file or directory", 1, "a folder that went away")
check(not (SCRATCH / "gone").exists(), "no file is created")

said = record("programs.trace", BUILD / "tests/real/panels/program", options=("--max-frames", "1"))
times(said, "the program uses shaders", 1, "a program with programs")
said = record("fixed.trace", PROGRAM, options=("--max-frames", "1"))
times(said, "the program uses shaders", 0, "a program without programs")

said = record("none.trace", PROGRAM, options=("--frames", "50-60"))
times(said, "the program ended after 10 frames, before the first that was to be recorded", 1, "frames that do not come")
said = record("one.trace", PROGRAM, options=("--frames", "5"))
times(said, "one.trace: 1 frame, ", 1, "one frame")
must(on_display(PROGRAM))
finish()
