"""Shared by the end-to-end tests: running the command, recording programs, counting checks like libcheck."""
import json
import os
import pathlib
import subprocess
import sys

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("RELUME_BUILD", ROOT / "build"))
RELUME = os.environ.get("RELUME", str(BUILD / "relume"))
SCRATCH = pathlib.Path(os.environ.get("TMPDIR", "/tmp"))
SCHEMA = json.loads((ROOT / "diff/score/score.schema.json").read_text())
AS_SHOWN = ("--mode", "gl", "--encoding", "display")
GATES = ("V", "R1", "R2", "R3", "R4", "R5", "E1", "E2", "P")

_results = []


def check(good, what):
    """Count one check; report a failure, and exit at once if RELUME_FIRST_FAILURE is set."""
    _results.append(bool(good))
    if not good:
        print(f"wrong: {what}", flush=True)
        if "RELUME_FIRST_FAILURE" in os.environ:
            finish()
    return bool(good)


def finish():
    """Print the count and exit."""
    failed = _results.count(False)
    share = 100 * (len(_results) - failed) // max(len(_results), 1)
    print(f"{share}%: Checks: {len(_results)}, Failures: {failed}, Errors: 0")
    sys.exit(bool(failed) or not _results)


def skip(why):
    print(why)
    sys.exit(77)


def run(*args, timeout=100, **more):
    """Run a program; returns its code, stdout and stderr as text."""
    return subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, errors="replace", timeout=timeout, **more)


def relume(*args, **more):
    return run(RELUME, *args, **more)


def must(done):
    """Run a command that the rest of the test depends on."""
    if done.returncode != 0:
        print(f"{' '.join(done.args)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        check(False, "required step")
        finish()
    return done


def on_display(*args, **more):
    return run(ROOT / "tests/xvfb.sh", *args, **more)


def record(trace, *program, options=("--ref", "color,depth"), optional=False):
    """Record a program on a private display. If it reports that this machine's GL cannot run it (exit code 77), the
    test is skipped, or None is returned if `optional` is set."""
    done = on_display(RELUME, "record", "-o", trace, *options, "--", *program)
    if done.returncode == 77 and (optional or False not in _results):
        why = next((line for line in done.stderr.splitlines() if line.startswith("skipped: ")),
                   "the program cannot run here")
        if not optional:
            skip(why.removeprefix("skipped: "))
        print(f"{trace.name}: {why}")
        return None
    return must(done)


def corpus(name):
    return BUILD / "corpus" / name


def render(trace, folder, *options):
    """Render frames as NAME.0000.exr into a folder; returns the files in order."""
    folder.mkdir(exist_ok=True)
    must(relume("render", trace, "-o", folder / f"{trace.stem}.####.exr", *options, timeout=300))
    return sorted(folder.glob("*.exr"))


def diff(trace, folder, *options):
    """Score; returns the exit code and the --json output."""
    done = relume("diff", trace, folder, "--json", "-", *options, timeout=300)
    try:
        score = json.loads(done.stdout)
    except ValueError:
        print(f"relume diff: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        check(False, "relume diff --json - prints JSON")
        finish()
    errors = [e.message for e in jsonschema.Draft202012Validator(SCHEMA).iter_errors(score)]
    check(not errors, f"relume diff --json - follows its schema: {errors[:3]}")
    return done.returncode, score


def check_gates(score, n_frames, what, skip=()):
    """Require that every frame is scored, and passes every gate except those to skip."""
    check(len(score["frames"]) == n_frames, f"{what}: {len(score['frames'])} frames scored of {n_frames}")
    for frame in score["frames"]:
        for gate in GATES:
            if gate not in skip:
                found = frame["gates"].get(gate)
                check(found and found["state"] == "passed", f"{what}: frame {frame['frame']}: gate {gate}: {found}")


def frames_of(trace):
    return trace.with_suffix(".frames")


def check_same_pictures(name, frames, *options):
    """Record tests/real/NAME with options of `record`, trace it in mode gl, and require that no pixel of any frame
    fails; `frames` describes each frame. Returns the trace and diff's output.
    """
    trace = SCRATCH / f"{pathlib.Path(name).name}.trace"
    record(trace, BUILD / "tests/real" / name, options=("--ref", "color,depth", *options))
    files = render(trace, frames_of(trace), *AS_SHOWN)
    check(len(files) == len(frames), f"{name}: {len(files)} frames of {len(frames)}")
    _, score = diff(trace, frames_of(trace))
    for frame, what in zip(score["frames"], frames):
        known = sum(b["pixels"]
                    for b in frame.get("blame", ())
                    if "known" in b)  # departures of this version of Mesa: replay/draw_names.c
        check(frame["failing_pixels"] == known,
              f"{name}: {what}: {frame['failing_pixels']} pixels fail, {known} of them known")
    return trace, score


def check_replayed(trace, first):
    """apitrace must read a trace to its end, and glretrace must draw every frame, from the given one on, as the program
    did."""
    dump = must(run("apitrace", "dump", "--color=never", trace))
    check(not dump.stderr and "// incomplete" not in dump.stdout,
          f"{trace.name}: apitrace reads all of it: {dump.stderr}")
    done = on_display(sys.executable, ROOT / "tests/real/replayed.py", trace.with_suffix(""), first)
    check(done.returncode == 0, f"{trace.name} replayed by glretrace: {done.stdout}")


def check_alone(trace, *numbers):
    """Frames that show the contents of earlier ones must be the same if they alone are requested. Call after
    check_same_pictures.
    """
    folder = SCRATCH / f"alone{numbers[0]}"
    render(trace, folder, *AS_SHOWN, "-f", ",".join(map(str, numbers)))
    for number in numbers:
        name = f"{trace.stem}.{number:04}.exr"
        check((folder / name).read_bytes() == (frames_of(trace) / name).read_bytes(),
              f"frame {number} is the same with and without earlier ones")
