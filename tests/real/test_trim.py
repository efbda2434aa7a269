#!/usr/bin/python3
"""A trimmed recording shows the pictures of the whole one: exactly in our renderer, in apitrace, and with its
references.

limit: 300 s
"""
import json
import re
import shutil
import sys

import exr
from helpers import BUILD, ROOT, SCRATCH, check, corpus, diff, finish, must, on_display, record, relume, render, run

sys.path.insert(0, str(ROOT / "tests" / "real"))
from replayed import replayed_frames  # noqa: E402

TRACES = ROOT.parent / "shared" / "traces"
SAID = re.compile(r": frames (\d+)-(\d+) as 0-(\d+), (\d+) of (\d+) calls, (\d+) of (\d+) bytes\n(.*)", re.S)


def trimmed(trace, first, last, begins):
    """The trimmed recording, which must start with the given frame."""
    new = SCRATCH / f"{trace.stem}-cut.trace"
    done = must(relume("trim", "-f", f"{first}-{last}", "-o", new, trace))
    said = SAID.search(done.stdout)
    check(said and int(said[1]) == begins and int(said[2]) == last,
          f"{trace.stem}: starts with frame {begins}: {done.stdout}")
    check(said and bool(said[8]) == (begins < first),
          f"{trace.stem}: reports an earlier start: {done.stdout}")
    check(begins == 0 or said and int(said[4]) < int(said[5]), f"{trace.stem}: calls were omitted: {done.stdout}")
    info = relume("info", "--json", new)
    facts = json.loads(info.stdout or "{}")
    check(info.returncode == 0 and not info.stderr and facts["frames"] == last - begins + 1,
          f"{trace.stem}: has the requested frames: {info.stderr}")
    check(facts["gl_errors"] == [], f"{trace.stem}: no call of it is an error: {facts['gl_errors']}")
    check(not run("apitrace", "dump", new).stderr, f"{trace.stem}: apitrace reads it to the end")
    return new


def same_renders(trace, new, first, last, *options):
    whole = render(trace, SCRATCH / f"{trace.stem}.whole", "-f", f"{first}-{last}", *options)
    cut = render(new, SCRATCH / f"{trace.stem}.cut", *options)
    check(len(whole) == len(cut) == last - first + 1, f"{trace.stem}: as many pictures")
    for a, b in zip(whole, cut):
        check(exr.Image(a).planes == exr.Image(b).planes, f"{trace.stem}: {a.name} and {b.name} have the same channels")


def same_replays(trace, new, first, begin):
    """From frame `begin` on: apitrace draws the first frame of its own recordings unreliably."""
    done = on_display(sys.executable, __file__, "--replay", trace, new, first, begin, timeout=200)
    check(done.returncode == 0, f"{trace.stem}: apitrace shows the same: {done.stdout}{done.stderr}")


def compare_replays(trace, new, first, begin):
    whole, cut = replayed_frames(trace)[first:], replayed_frames(new)
    differ = [i for i in range(begin, len(cut)) if i >= len(whole) or whole[i] != cut[i]]
    errors = run("glretrace", "-b", new).stderr
    print(f"{len(cut)} pictures, different: {differ}; {errors if 'error' in errors else ''}")
    sys.exit(len(cut) < 2 or bool(differ) or "error" in errors)


if "--replay" in sys.argv:
    compare_replays(sys.argv[2], sys.argv[3], int(sys.argv[4]), int(sys.argv[5]))

live = {name: SCRATCH / f"{name}.trace" for name in ("glxgears", "state", "viewer")}
record(live["glxgears"], "glxgears", "-geometry", "100x100", options=("--ref", "color,depth", "--quit-after", "8"))
record(live["state"], BUILD / "tests/trace/state")
record(live["viewer"], corpus("viewer"), "--frames", "6")
for name, trace in live.items():
    new = trimmed(trace, 3, 4, 3)
    same_renders(trace, new, 3, 4, *(["--mode", "gl"] if name == "viewer" else []))
    if name == "viewer":
        continue
    same_replays(trace, new, 3, 0)
    # The references are trimmed, too: frames of the trimmed recording get the same scores as those of the whole one.
    _, score = diff(new, SCRATCH / f"{name}.cut")
    _, whole = diff(trace, SCRATCH / f"{name}.whole", "-f", "3-4")
    check([f["gates"] for f in score["frames"]] == [f["gates"] for f in whole["frames"]] and len(score["frames"]) == 2,
          f"{name}: scored like the whole one")

# In apitrace's recordings, client arrays precede each draw.
for program, options in ((BUILD / "tests/trace/state", ()), (BUILD / "tests/bench/static_scene", ("changing", "6"))):
    trace = SCRATCH / f"apitrace-{program.name}.trace"
    must(on_display("apitrace", "trace", "-o", trace, program, *options))
    new = trimmed(trace, 4, 5, 4)
    same_renders(trace, new, 4, 5, "--mode", "gl")
    same_replays(trace, new, 4, 1)
    check(not options or new.stat().st_size < 0.4 * trace.stat().st_size,
          "arrays of omitted draws are omitted")
    check(not new.with_suffix(".ref").exists(), f"{trace.stem}: no references")

# Programs of the shared recordings; xss-noof draws over its earlier picture.
for name, first, begins in (("xss-queens", 70, 70), ("xss-noof", 1, 0)):
    trace = SCRATCH / f"shared-{name}.trace"
    if (TRACES / f"{name}.trace").exists():
        shutil.copy(TRACES / f"{name}.trace", trace)
        (SCRATCH / f"{trace.stem}-cut.ref").write_bytes(b"from an older recording")
        new = trimmed(trace, first, first + 1, begins)
        same_renders(trace, new, begins, first + 1, "--mode", "gl")
        facts = json.loads(relume("info", "--json", new).stdout)
        check(facts["show_earlier"] == ([] if begins == first else [[1, first + 1]]),
              f"{name}: info says which frames show others: {facts['show_earlier']}")
        check(not new.with_suffix(".ref").exists(), f"{name}: no references, and none of an older recording")

# Missing frames, and wrong usage: the code, one line, and no file.
trace, new = live["viewer"], SCRATCH / "none.trace"
for options in (("-f", "3-40"), ("-f", "40"), ("-f", "1,5"), ("-f", "1-5x2"), ("-f", "x"), ()):
    done = relume("trim", *options, "-o", new, trace)
    check(done.returncode == 2 and len(done.stderr.splitlines()) == 1 and not new.exists(),
          f"{options}: usage: {done.stderr}")
check(
    relume("trim", "-f", "1", "-o", trace, trace).returncode == 2 and trace.stat().st_size > 1000,
    "the recording is not overwritten")
check(relume("trim", "-f", "1", "-o", "/dev/full/x", trace).returncode == 5, "a place that cannot be written")
check(relume("trim", "-f", "1", "-o", new, corpus("viewer")).returncode == 3 and not new.exists(), "not a trace")
check(not list(SCRATCH.glob("*.part")), "no partial file is left")
finish()
