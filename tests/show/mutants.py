#!/usr/bin/python3
"""tests/show/mutants.py BUILD (as `make show-mutants`): damaged files cause no crash or hang, and memory stays bounded.

20,000 mutants of recordings made here (our programs, glxgears and two screen savers) go through all verbs that read a
recording: most in one process (tests/fuzz/drive.c), some through the command itself (tests/fuzz/mutate.py, exit code 0
or 3). 5,000 mutants of every other kind of file that Relume reads, derived from files that it and other tools write
(tests/fuzz/seeds.py). Failing inputs are kept in BUILD/show/mutants/.
"""
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
HEAD = 100_000  # bytes of the unpacked stream: at least one frame of each
TRACES, COMMANDS, OTHERS = 20_000, 1_000, 5_000
SEED = 1
AT_ONCE = 10   # damaged pictures
LONGEST_S = 10

PROGRAMS = {
    "two_triangles": ["corpus/two_triangles", "--frames", "6"],
    "cornell": ["corpus/cornell", "--frames", "3", "--vbo"],
    "glxgears": ["timeout", "2", "glxgears"],
    "queens": ["timeout", "3", "/usr/libexec/xscreensaver/queens", "-geometry", "200x200"],
    "molecule": ["timeout", "3", "/usr/libexec/xscreensaver/molecule", "-geometry", "200x200"],
}


def record(build, folder):
    for name, command in PROGRAMS.items():
        program = [str(build / command[0]) if "/" in command[0] and command[0][0] != "/" else command[0], *command[1:]]
        trace = folder / f"{name}.trace"
        if not trace.exists():
            # A program stopped by `timeout` has been recorded up to then; unpacking checks that.
            subprocess.run([ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", trace, "--", *program],
                           check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return sorted(folder.glob("*.trace"))


def drive(build, folder, target, count, parts):
    """The number of `count` mutants that break the target."""
    pack = folder / f"{target}.pack"
    pack.write_bytes(b"".join(len(part).to_bytes(4, "little") + part for part in parts))
    os.symlink(ROOT / "tests", folder /
               "tests") if not (folder / "tests").exists() else None  # targets read the golden recordings
    work = folder / "tmp"
    work.mkdir(exist_ok=True)
    done = subprocess.run([build / "tests/fuzz/drive", "mutate", target,
                           str(count), str(SEED), pack], capture_output=True, text=True, check=False, cwd=folder,
                          env=dict(os.environ, TMPDIR=str(work)))
    print(done.stdout.strip(), flush=True)
    return done.stdout.count(": input ") if done.returncode in (0, 1) else count


def compare_once(build, good, bad, mutate):
    """Exit code and seconds of one `relume diff`."""
    begin = time.monotonic()
    code = subprocess.run([build / "relume", "diff", good, bad], check=False, preexec_fn=mutate.limit_memory,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
    return code, time.monotonic() - begin


def compare(build, folder, count, parts, mutate):
    """The number of `count` damaged pictures that break `relume diff`, which reads each in a separate process. It must
    exit with 0 (undamaged), 1 or 3, within 10 s and 2 GiB, ten at once. The limit is wall time, since these processes
    appear in no other measurement; a second try distinguishes a hang from a busy machine.
    """
    endings = (ROOT / "tests/fuzz/fuzz_oiio.c").read_text().partition("endings[] = {")[2].partition("}")[0].replace(
        '"', "").replace(" ", "").split(",")
    by_ending = {
        ending: [part[1:] for part in parts if endings[part[0] % len(endings)] == ending] for ending in endings
    }
    by_ending = {ending: wholes for ending, wholes in by_ending.items() if wholes}
    good, bad = folder / "good", folder / "bad"
    rng = random.Random(SEED)
    broken = 0
    good.mkdir(exist_ok=True)
    for i in range(AT_ONCE):
        (good / f"x.{i:04}.png").write_bytes(by_ending["png"][0])
    for first in range(0, count, AT_ONCE):
        ending = list(by_ending)[first // AT_ONCE % len(by_ending)]
        shutil.rmtree(bad, ignore_errors=True)
        bad.mkdir()
        for i in range(AT_ONCE):
            (bad / f"x.{i:04}.{ending}").write_bytes(mutate.damage(rng.choice(by_ending[ending]), rng))
        code, seconds = compare_once(build, good, bad, mutate)
        if seconds > LONGEST_S:
            code, again = compare_once(build, good, bad, mutate)
            seconds = min(seconds, again)
        if code not in (0, 1, 3) or seconds > LONGEST_S:
            broken += 1
            print(f"{bad.rename(folder / f'pictures.crash-{first}')}: exit code {code}, {seconds:.1f} s", flush=True)
    return broken


def main(build):
    os.environ["RELUME"] = str(build / "relume")
    sys.path[:0] = [str(ROOT / "tests/fuzz"), str(ROOT / "tests/real")]
    sys.dont_write_bytecode = True
    import mutate
    import seeds
    folder = build / "show" / "mutants"
    folder.mkdir(parents=True, exist_ok=True)
    rows = []

    def row(what, count, work):
        begin = time.monotonic()
        wrong = work()
        rows.append(
            {"what": what, "figure": f"{wrong} of {count} break a run", "bar": "0", "peer": None, "passed": wrong == 0})
        print(f"{'holds' if not wrong else 'FAILS'}  {what}: {rows[-1]['figure']} ({time.monotonic() - begin:.0f} s)",
              flush=True)

    traces = record(build, folder)
    streams = [bytes(mutate.unpack(trace.read_bytes(), HEAD)[:HEAD]) for trace in traces]
    share = COMMANDS // len(traces)
    for seed, trace in enumerate(traces):
        row(f"{trace.stem}, through the command's info and scene", share,
            lambda trace=trace, seed=seed: mutate.main(trace, share, seed, HEAD))
    count = TRACES - share * len(traces)
    parts = [bytes([seeds.STREAM | verb]) + stream for stream in streams for verb in range(seeds.VERBS)]
    row(f"{len(traces)} recordings, through {seeds.VERBS} verbs", count,
        lambda: drive(build, folder, "verbs", count, parts))
    seeds.make_seeds(build, build / "fuzz")
    for target in sorted(path.stem[5:] for path in (ROOT / "tests/fuzz").glob("fuzz_*.c")):
        parts = [path.read_bytes() for path in sorted((build / f"fuzz/seeds_{target}").glob("*"))] + seeds.read_pack(
            ROOT / f"tests/fuzz/kept_{target}")
        if target == "oiio":
            row("pictures, through the command's diff", OTHERS,
                lambda parts=parts: compare(build, folder, OTHERS, parts, mutate))
        elif target not in ("verbs", "replay", "calls"):
            row(target, OTHERS, lambda target=target, parts=parts: drive(build, folder, target, OTHERS, parts))
    (build / "show" / "mutants.json").write_text(
        json.dumps({"name": "mutants", "command": "make show-mutants", "rows": rows}, indent=1))
    return any(not row["passed"] for row in rows)


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
