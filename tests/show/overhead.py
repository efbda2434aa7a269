#!/usr/bin/python3
"""tests/show/overhead.py BUILD (as `make show-overhead`): the cost of recording, compared with `apitrace trace`.

Runs tests/bench/static_scene in its four modes and glxgears (without vertical sync), bare and under our recorder. Runs
form pairs whose order alternates; some pairs are accompanied by a run under apitrace. A figure is the median of the
ratios within pairs, because other load slows both runs of a pair alike. The processor time of the program and its
threads is given for information.
"""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from display import need_display

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ROUNDS, PEER_ROUNDS = 27, 9
GEARS_FRAMES = 1000
TIME_BARS = {"immediate": 1.5, "arrays": 1.1, "elements": 1.1, "changing": None, "glxgears": 1.1}  # None: no limit
STATIC_BYTES_BAR = 50  # minimum ratio of apitrace's trace size to ours
BYTES_BARS = {"immediate": STATIC_BYTES_BAR, "arrays": STATIC_BYTES_BAR, "elements": STATIC_BYTES_BAR, "changing": 1}


def frame_ms(command, environment):
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    clock, used = run.stdout.split()[-2:]
    return float(clock), float(used)


def command_of(build, how):
    if how != "glxgears":
        return [str(build / "tests/bench/static_scene"), how]
    script = 'LD_PRELOAD="$0:$LD_PRELOAD"; export LD_PRELOAD; exec glxgears'
    return ["sh", "-c", script, str(build / "tests/real/timer_shim.so")]


def measure(build, how, folder):
    program, environment = command_of(build, how), dict(os.environ, SHIM_FRAMES=str(GEARS_FRAMES))
    ours, theirs = folder / "ours.trace", folder / "theirs.trace"
    commands = {"bare": program, "ours": [str(build / "relume"), "record", "-o", str(ours), "--", *program],
                "apitrace": ["apitrace", "trace", "-o", str(theirs), *program]}
    ratios = {"ours": [], "apitrace": []}
    for n in range(ROUNDS):
        who = ["bare", "ours"] if n % 2 == 0 else ["ours", "bare"]
        if n < PEER_ROUNDS:
            theirs.unlink(missing_ok=True)
            who.append("apitrace")
        run = {name: frame_ms(commands[name], environment) for name in who}
        for name in run.keys() & ratios.keys():
            ratios[name].append([recorded / bare for recorded, bare in zip(run[name], run["bare"])])
    (ratio, used), (peer, peer_used) = ([statistics.median(column) for column in zip(*ratios[name])] for name in ratios)
    bar = TIME_BARS[how] or peer
    what = how if how == "glxgears" else f"10,000 triangles, {how}"
    yield {
        "what": f"{what}: frame time over bare", "figure": f"{ratio:.2f}x", "bar": f"{bar:.2f}x",
        "peer": f"apitrace {peer:.2f}x", "passed": ratio <= bar
    }
    yield {"what": f"{what}: processor time over bare", "figure": f"{used:.2f}x", "bar": None,
           "peer": f"apitrace {peer_used:.2f}x", "passed": None}
    if how in BYTES_BARS:
        times_smaller = theirs.stat().st_size / ours.stat().st_size
        yield {
            "what": f"{what}: trace", "figure": f"1/{times_smaller:.3f} of the peer's", "bar": f"1/{BYTES_BARS[how]}",
            "peer": f"apitrace {theirs.stat().st_size} bytes", "passed": times_smaller >= BYTES_BARS[how]
        }


def main(build):
    need_display()
    build = pathlib.Path(build).resolve()
    with tempfile.TemporaryDirectory() as folder:
        rows = [row for how in TIME_BARS for row in measure(build, how, pathlib.Path(folder))]
    (build / "show").mkdir(exist_ok=True)
    (build / "show/overhead.json").write_text(
        json.dumps({"name": "overhead", "command": "make show-overhead", "rows": rows}, indent=1))
    for row in rows:
        print(f"{row['what']}: {row['figure']} (bar {row['bar']}; {row['peer']})")
    return 1 if any(row["passed"] is False for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
