#!/usr/bin/python3
"""tests/show/kill.py BUILD [RUNS [SEED]] (as `make show-kill`): programs killed by SIGKILL at random moments lose no
completed frame.

Each run records a program and kills it at a random time after its start, in every second run together with the
recording command. A counter outside the process (counter_shim.c) knows how many frames were completed. The trace must
hold at least that number of frames, and `apitrace dump` and `relume info` must read it to the end; the only complaint
allowed is apitrace's, that the trace ends inside a call of the frame in progress. A program killed before its first
call leaves a trace without calls.
"""
import json
import os
import pathlib
import random
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time

from display import need_display

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
MAX_WAIT_S = 0.5  # from the program's start to its death
PATIENCE_S = 60   # for the program to start
CUT = b"warning: unexpected end of file while reading trace\n"  # in the incomplete frame
FRAME_END = re.compile(rb"^[0-9]+ glXSwapBuffers\(", re.M)


def programs(build):
    scene = str(build / "tests/bench/static_scene")
    return [["glxgears"], [str(build / "corpus/cornell"), "--animate", "camera"], [scene, "changing", "1000000"],
            [scene, "immediate", "1000000"]]


def read_counter(path):
    return struct.unpack("<QQ", path.read_bytes())


def kill_once(build, program, delay, both, folder):
    """(frames completed, frames in the trace, complaint or None)."""
    trace, counter = folder / "x.trace", folder / "counter"
    trace.unlink(missing_ok=True)
    counter.write_bytes(bytes(16))
    script = 'LD_PRELOAD="$1:$LD_PRELOAD"; export LD_PRELOAD; shift; exec "$@"'
    command = [
        build / "relume", "record", "-o", trace, "--", "sh", "-c", script, "sh", build / "tests/real/counter_shim.so",
        *program
    ]
    recorder = subprocess.Popen(list(map(str, command)), env=dict(os.environ, KILL_COUNTER=str(counter)),
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    pid, deadline = 0, time.monotonic() + PATIENCE_S
    while not pid and time.monotonic() < deadline:
        time.sleep(0.002)
        pid = read_counter(counter)[0]
    time.sleep(delay)
    if both:
        recorder.kill()
    if pid:
        os.kill(pid, signal.SIGKILL)
    recorder.wait()
    if not pid:
        return 0, 0, "the program did not start"
    completed = read_counter(counter)[1]
    if not trace.exists():
        return completed, 0, "no trace" if completed else None
    dump = subprocess.run(["apitrace", "dump", "--color=never", trace], stdin=subprocess.DEVNULL, capture_output=True,
                          check=False)
    info = subprocess.run([build / "relume", "info", trace], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    complaint, begun = None, trace.stat().st_size and (completed or b"\n0 " in dump.stdout)
    if trace.stat().st_size and (dump.returncode or dump.stderr not in (b"", CUT)):
        complaint = f"apitrace dump: {dump.returncode} {dump.stderr.decode(errors='replace').strip()[:200]}"
    elif begun and info.returncode:
        complaint = f"relume info: {info.returncode} {info.stderr.decode(errors='replace').strip()[:200]}"
    return completed, len(FRAME_END.findall(dump.stdout)), complaint


def main(build, runs, seed):
    need_display()
    build, rng = pathlib.Path(build).resolve(), random.Random(seed)
    frames = lost = unreadable = 0
    with tempfile.TemporaryDirectory() as folder:
        for n in range(runs):
            program = programs(build)[n % 4]
            delay = rng.uniform(0, MAX_WAIT_S)
            completed, recorded, complaint = kill_once(build, program, delay, n // 4 % 2 == 1, pathlib.Path(folder))
            frames += completed
            lost += max(0, completed - recorded)
            unreadable += complaint is not None
            if complaint or recorded < completed:
                print(
                    f"run {n}, {program[0]} killed after {delay:.3f} s: {completed} frames completed, {recorded} in "
                    f"the trace"
                    f"{'; ' + complaint if complaint else ''}", flush=True)
    rows = [{
        "what": f"{runs} runs killed (seed {seed}), {frames} frames completed: lost", "figure": lost, "bar": 0,
        "peer": None, "passed": lost == 0 and frames > runs
    }, {
        "what": f"{runs} runs killed: traces that apitrace dump or relume info cannot read", "figure": unreadable,
        "bar": 0, "peer": None, "passed": unreadable == 0
    }]
    for row in rows:
        print(f"{row['what']}: {row['figure']} (bar {row['bar']})")
    (build / "show").mkdir(exist_ok=True)
    if runs >= 1000:
        (build / "show/kill.json").write_text(
            json.dumps({"name": "kill", "command": "make show-kill", "rows": rows}, indent=1))
    return 0 if all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(
        main(sys.argv[1],
             int(sys.argv[2]) if len(sys.argv) > 2 else 1000,
             int(sys.argv[3]) if len(sys.argv) > 3 else 1))
