#!/usr/bin/python3
"""tests/show/bisection.py BUILD [--only NAME] (as `make show-bisect`): ten pairs of recordings with one planted change,
each located at the exact call.

Six pairs are a recording of a real program and a copy with one argument changed in its second half. Four pairs are a
program of corpus/ and a build of it with one line changed, removed or added.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/show"))
from edit_trace import Trace  # noqa: E402
from table import Shown  # noqa: E402

SHARED, AT = ROOT.parent / "shared/traces", 0.6
EDITS = [("glxgears", "glRotatef", 0, 12.5), ("xss-queens", "glBlendFunc", 1, 1), ("neverball", "glBindTexture", 1, 3),
         ("billard-gl", "glColor4f", 0, 0.125), ("rss-lattice", "glVertex3f", 1, 0.75),
         ("iv-SceneViewer", "glRotatef", 0, 33.5)]
# A program, one of its lines, the replacement, and the calls that diverge.
BUILDS = [("spheres", "	glEnable(GL_LIGHT0);\n", "", "glEnable(cap = GL_LIGHT0)", None),
          ("courtyard", "glBlendFunc(GL_SRC_ALPHA, GL_ONE);", "glBlendFunc(GL_ONE, GL_ONE);",
           "glBlendFunc(sfactor = GL_SRC_ALPHA", "glBlendFunc(sfactor = GL_ONE,"),
          ("hall", "	glEnable(GL_CULL_FACE);\n", "	glEnable(GL_CULL_FACE);\n	glFrontFace(GL_CW);\n", None,
           "glFrontFace(mode = GL_CW)"),
          ("still_life", "glFogf(GL_FOG_END, 22);", "glFogf(GL_FOG_END, 9);", "glFogf(pname = GL_FOG_END, param = 22)",
           "glFogf(pname = GL_FOG_END, param = 9)")]
SIDE = re.compile(r"^    (good|bad) +(?:(\d+) )?(.*) \(frame (\d+)\)$", re.M)


def run(*args, codes=(0,), **more):
    done = subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False,
                          **more)
    if done.returncode not in codes:
        sys.exit(f"{' '.join(map(str, args))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def bisect(relume, good, bad):
    begin = time.monotonic()
    text = run(relume, "bisect", good, bad, codes=(1,))
    seconds = time.monotonic() - begin
    picture = re.search(r"^first picture.*?: frame (\d+)|^pictures: .*", text, re.M)
    return text, {
        side: (number, what, frame) for side, number, what, frame in SIDE.findall(text.split("\nthen at")[0])
    }, picture[0] if picture else "", seconds


def edited(relume, work, name, call, argument, value):
    trace = Trace(SHARED / f"{name}.trace")
    found = [
        i for i, (other, args) in enumerate(trace.calls)
        if other == call and args[argument].kind in ("number", "float",
                                                     "double") and abs(args[argument].value - value) > 0.01
    ]
    at = found[int(AT * len(found))]
    trace.change(trace.calls[at][1][argument], value)
    trace.save(work / "bad.trace")
    text, sides, picture, seconds = bisect(relume, SHARED / f"{name}.trace", work / "bad.trace")
    good = all(sides[side][0] == str(at) and sides[side][1].startswith(f"{call}(")
               for side in ("good", "bad")) and "then at" not in text
    return f"{name}: {call}, call {at} of {len(trace.calls)}", f"calls {sides['good'][0]} and {sides['bad'][0]}, {seconds:.1f} s; {picture}", good


def build(source, program):
    run("cc", "-std=c11", "-O2", "-I", ROOT / "corpus", "-o", program, source, "-lglut", "-lGLU", "-lGL", "-lm")


def built(relume, work, name, line, instead, was, now):
    source = (ROOT / "corpus" / f"{name}.c").read_text()
    if source.count(line) != 1:
        sys.exit(f"corpus/{name}.c: the line to change does not occur exactly once")
    for side, text in (("good", source), ("bad", source.replace(line, instead))):
        (work / f"{side}.c").write_text(text)
        build(work / f"{side}.c", work / side)
        run(ROOT / "tests/xvfb.sh", relume, "record", "-o", work / f"{side}.trace", "--", work / side, "--frames", 3)
    text, sides, picture, seconds = bisect(relume, work / "good.trace", work / "bad.trace")
    good = sides["good"][1].startswith(was or "nothing") and sides["bad"][1].startswith(
        now or "nothing") and "then at" not in text
    return f"{name}, built: {line.strip()} -> {instead.strip() or 'nothing'}", f"{sides['good'][1]} | {sides['bad'][1]}, {seconds:.1f} s; {picture}", good


def main(folder, only):
    relume, shown = (folder / "relume").resolve(), Shown(folder, "bisect")
    for kind, cases in ((edited, EDITS), (built, BUILDS)):
        for case in cases:
            if only and only not in case[0]:
                continue
            with tempfile.TemporaryDirectory() as scratch:
                what, figure, good = kind(relume, pathlib.Path(scratch), *case)
            shown.row(what, figure, "exactly this call", good)
    return shown.finish()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only")
    options = parser.parse_args()
    sys.exit(main(options.build, options.only))
