#!/usr/bin/python3
"""Small GL programs, recorded, dumped by apitrace, and compared with the expected calls.

NAME.c beside this file is the program, NAME.ref.txt its calls as `apitrace dump` prints them, without call numbers.
Each of its lines must occur in this order; <name> matches anything, <=name> a number that is the same in all places,
"..." any number of lines. Run with --print NAME [OPTIONS of relume record] to see a dump.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BUILD = pathlib.Path(os.environ.get("RELUME_BUILD", ROOT / "build"))
RELUME = os.environ.get("RELUME", BUILD / "relume")


def run(*command):
    done = subprocess.run([ROOT / "tests" / "xvfb.sh", *command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def dump(name, *options):
    """The recorded calls of a program, as a list of lines without numbers. Its own output must be the same as without a
    recorder.
    """
    program = BUILD / "tests" / "trace" / name
    with tempfile.TemporaryDirectory() as folder:
        trace = pathlib.Path(folder, "x.trace")
        printed = run(RELUME, "record", "-o", trace, *options, "--", program)
        assert printed == run(program), printed
        read = subprocess.run(["apitrace", "dump", "--color=never", "--verbose", trace], capture_output=True, text=True,
                              check=True)
        assert not read.stderr, read.stderr
    lines = [re.sub(r"^\d+ ", "", line) for line in read.stdout.splitlines()]
    return [line for line in lines if line and not line.startswith("//")]


def matcher(line, numbers):
    """@param numbers  {name: its value so far}"""
    text = ""
    for part in re.split(r"(<=?\w+>)", line):
        name = part[2:-1] if part.startswith("<=") else None
        if name and name not in numbers and f"(?P<{name}>" not in text:
            text += rf"(?P<{name}>\d+)"
        elif name:
            text += numbers.get(name, f"(?P={name})")
        else:
            text += ".*" if re.fullmatch(r"<\w+>", part) else re.escape(part)
    return re.compile(text)


class Dumps(unittest.TestCase):
    def compare(self, name, *options):
        got = dump(name, *options)
        at, anywhere, numbers = 0, True, {}
        for number, line in enumerate((HERE / f"{name}.ref.txt").read_text().splitlines(), 1):
            if line == "...":
                anywhere = True
                continue
            pattern = matcher(line, numbers)
            here = at
            while anywhere and here < len(got) and not pattern.fullmatch(got[here]):
                here += 1
            self.assertTrue(
                here < len(got) and pattern.fullmatch(got[here]),
                f"{name}.ref.txt:{number}: {line}\nnot found; the dump continues with\n" + "\n".join(got[at:at + 5]))
            numbers |= pattern.fullmatch(got[here]).groupdict()
            at, anywhere = here + 1, False

    def test_arrays(self):
        self.compare("arrays")

    def test_ranges_of_elements(self):
        self.compare("ranges")

    def test_mappings_that_end(self):
        self.compare("mapped")

    def test_pixels(self):
        self.compare("pixels")

    def test_pixels_while_read_back(self):
        self.compare("pixels", "--ref", "color,depth")

    def test_loaded_by_hand(self):
        if subprocess.run([BUILD / "tests/trace/loaded"], check=False).returncode == 77:
            self.skipTest("Mesa 26 has no OSMesa")
        self.compare("loaded")

    def test_refused(self):
        self.compare("refused")

    def test_readback(self):
        self.compare("readback", "--frame-end", "readpixels", "--ref", "color,depth")

    def test_frames_end_where_asked(self):
        """The terminator comes directly before a clear or a read, and directly after a flush or a finish."""
        for end, call, frames in (("clear", "glClear(", 1), ("readpixels", "glReadPixels(", 2),
                                  ("flush", "glFlush(", 2), ("finish", "glFinish(", 2)):
            got = [line for line in dump("readback", "--frame-end", end) if not line.startswith("glStringMarker")]
            at = [i for i, line in enumerate(got) if line.startswith("glFrameTerminatorGREMEDY() // fake")]
            self.assertEqual(len(at), frames, end)
            for i in at:
                self.assertTrue(got[i - 1 if end.startswith("f") else i + 1].startswith(call), got[i - 2:i + 3])
        got = dump("readback", "--frame-end", "swap")
        self.assertFalse([line for line in got if "Terminator" in line])

    def test_runs(self):
        self.compare("runs")

    def test_what_frames_that_are_left_out_leave(self):
        got = dump("runs", "--frames", "2-2")
        fan = ["glBegin(mode = GL_TRIANGLE_FAN)", "glColor3f(red = 0.25, green = 0.9166667, blue = 0)",
               "glEnd()"]  # the last of twelve colours
        at = got.index(fan[0])
        self.assertEqual(got[at:at + 3], fan)

    def test_threads(self):
        """Two threads draw at once: the trace contains every call of both completely, in each thread's order."""
        got = dump("threads")
        calls = [re.sub(r"^@\d+ ", "", line) for line in got]
        self.assertEqual(sum(c.startswith("glXSwapBuffers") for c in calls), 2 * 20)
        self.assertEqual(sum(c.startswith("glBegin") for c in calls), 2 * 20 * 200)
        for shade in ("0.25", "0.75"):
            self.assertEqual(sum(c == f"glColor3f(red = {shade}, green = 0, blue = 0)" for c in calls), 20 * 200)
        self.assertFalse([c for c in calls if "incomplete" in c])


if __name__ == "__main__":
    if len(sys.argv) >= 3 and sys.argv[1] == "--print":
        print(*dump(*sys.argv[2:]), sep="\n")
    else:
        unittest.main(failfast="RELUME_FIRST_FAILURE" in os.environ)
