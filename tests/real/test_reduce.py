#!/usr/bin/python3
"""relume reduce: the reduced recording still fails like the whole one, and no further call can be removed."""
import sys
import tempfile

from helpers import RELUME, ROOT, SCRATCH, check, corpus, diff, finish, must, pathlib, record, relume, render, run

sys.path.insert(0, str(ROOT / "tests/show"))
from edit_trace import Trace  # noqa: E402

ERROR = f"'{RELUME}' info --json \"$TRACE\" >info.json || exit 9; ! grep -q INVALID_ENUM info.json"
PART = f"'{RELUME}' scene \"$TRACE\" -f 0 >scene.txt || exit 9; ! {{ grep -q 'glDrawElements' scene.txt && '{RELUME}' dump \"$TRACE\" | grep -q 'glTexImage2D'; }}"
TWO = f"'{RELUME}' scene \"$TRACE\" -f 0 >scene.txt || exit 9; ! grep -q '2 triangles of mesh' scene.txt"


def names(trace):
    return [line.split(" ", 1)[1].split("(")[0] for line in must(relume("dump", trace)).stdout.splitlines()]


def reduce(trace, new, command, *options):
    done = must(relume("reduce", trace, "-o", new, "--when", command, *options, timeout=300))
    check(
        len(names(new)) == int(done.stdout.split(": ")[1].split(" of ")[0]),
        f"reports the number of remaining calls: {done.stdout}")
    check(not run("apitrace", "dump", new).stderr, f"apitrace reads {new.name}")
    return names(new)


with tempfile.TemporaryDirectory(dir=SCRATCH) as folder:
    out = pathlib.Path(folder)
    record(out / "whole.trace", corpus("still_life"), "--frames", 3)
    trace = Trace(out / "whole.trace")
    trace.change(trace.find("glEnable")[20][0], 0x1234)
    trace.save(out / "error.trace")
    calls = reduce(out / "error.trace", out / "small.trace", ERROR)
    check(calls.count("glEnable") == 1 and len(calls) <= 3, f"the calls for an error: {calls}")
    reduce(out / "error.trace", out / "alone.trace", ERROR, "--jobs", 1)
    check((out / "small.trace").read_bytes() == (out / "alone.trace").read_bytes(),
          "the same for any number of parallel runs")

    done = reduce(out / "whole.trace", out / "part.trace", PART)
    dump = must(relume("dump", out / "part.trace")).stdout
    check(
        done.count("glDrawElements") == 1 and "count = 3," in dump and "indices = blob(6)" in dump,
        f"one triangle out of twelve: {dump}")
    check(done.count("glTexImage2D") == 1 and "pixels = NULL" in dump, f"an image without its texels: {dump}")

    record(out / "pair.trace", corpus("two_triangles"), "--frames", 2)
    calls = reduce(out / "pair.trace", out / "triangles.trace", TWO)
    check(calls.count("glVertex2f") == 6 and len(calls) <= 12, f"the calls for two triangles: {calls}")

    # A frame: one colour differs from the unchanged program's reference frames.
    trace = Trace(out / "pair.trace")
    colors = trace.find("glColor3f")
    trace.change(colors[-1][1], 0.5)
    trace.save(out / "colour.trace")
    by_frame = ("reduce", out / "colour.trace", "-o", out / "frame.trace", "-f", 1, "--ref", out / "pair.ref")
    done = must(relume(*by_frame, timeout=100))
    calls = must(relume("dump", out / "frame.trace")).stdout
    check("is still there" in done.stdout and "glBegin" in done.stderr,
          f"reports the fault: {done.stdout} {done.stderr}")
    check(
        calls.count("glVertex2f") == 3 and calls.count("glColor3f") == 1 and calls.count("0.5") >= 1,
        f"the calls for a wrong colour: {calls}")
    frame_files = render(out / "frame.trace", out / "frame", "--mode", "gl", "--aov", "gl,id")
    check(len(frame_files) == 1, f"one frame is left: {frame_files}")
    code, score = diff(out / "pair.ref", frame_files[0], "-f", 0)
    check(code == 1 and score["frames"][0]["blame"], f"the frame still fails: {score['frames'][0]['outcome']}")
    for wrong, why in (((*by_frame, "--when", "false"), "both"), (by_frame[:4], "neither"),
                       ((*by_frame[:5], 7, *by_frame[6:]), "no such frame"), (("reduce", out / "pair.trace",
                                                                               *by_frame[2:6]), "a frame that passes")):
        check(relume(*wrong).returncode == 2, why)

    done = relume("reduce", out / "whole.trace", "-o", out / "none.trace", "--when", ERROR)
    check(done.returncode == 2 and "nothing to look for" in done.stderr, f"a command that passes: {done.stderr}")
    done = relume("reduce", out / "whole.trace", "-o", out / "none.trace", "--when",
                  "[ -e '%s/second' ] && exit 4; touch '%s/second'; exit 3" % (out, out))
    check(done.returncode == 2 and "with 3, then" not in done.stderr and "code 3 and then with 4" in done.stderr,
          f"a fickle command: {done.stderr}")
    check(
        relume("reduce", out / "missing.trace", "-o", out / "none.trace", "--when", "false").returncode == 3,
        "no such recording")
    check(not (out / "none.trace").exists(), "no file is written if nothing was found")
finish()
