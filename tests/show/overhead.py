#!/usr/bin/python3
"""tests/show/overhead.py BUILD (as `make show-overhead`): what recording costs, side by side with `apitrace trace`.

Runs tests/bench/static_scene in its four ways bare, under our recorder and under apitrace, in turn, several times; takes the
best time of each, so that other work on the machine counts as little as possible.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ROUNDS = 3
TIME_BARS = {"immediate": 1.5, "arrays": 1.1, "elements": 1.1, "changing": None}
STATIC_BYTES_BAR = 50  # apitrace's trace is at least so many times as large


def frame_ms(command, environment):
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    return float(run.stdout.split()[-1])


def measure(build, how, folder):
    program = [str(build / "tests/bench/static_scene"), how]
    ours, theirs = folder / "ours.trace", folder / "theirs.trace"
    times = {"bare": [], "ours": [], "apitrace": []}
    for _ in range(ROUNDS):
        theirs.unlink(missing_ok=True)
        times["bare"].append(frame_ms(program, os.environ))
        times["ours"].append(frame_ms([str(build / "relume"), "record", "-o", str(ours), "--", *program], os.environ))
        times["apitrace"].append(frame_ms(["apitrace", "trace", "-o", str(theirs), *program], os.environ))
    best = {who: min(values) for who, values in times.items()}
    ratio, peer = best["ours"] / best["bare"], best["apitrace"] / best["bare"]
    times_smaller = theirs.stat().st_size / ours.stat().st_size
    bar = TIME_BARS[how] or peer
    static = how in ("arrays", "elements", "immediate")
    size_bar = STATIC_BYTES_BAR if static else 1
    yield {"what": f"10,000 triangles, {how}: frame time over bare", "figure": f"{ratio:.2f}x", "bar": f"{bar:.2f}x",
           "peer": f"apitrace {peer:.2f}x", "passed": ratio <= bar}
    yield {"what": f"10,000 triangles, {how}: trace", "figure": f"1/{times_smaller:.1f} of the peer's", "bar": f"1/{size_bar}",
           "peer": f"apitrace {theirs.stat().st_size} bytes", "passed": times_smaller >= size_bar}


def main(build):
    if "DISPLAY_IS_OURS" not in os.environ:
        os.environ["DISPLAY_IS_OURS"] = "1"
        return subprocess.run([ROOT / "tests/xvfb.sh", sys.executable, __file__, build], check=False).returncode
    build = pathlib.Path(build).resolve()
    with tempfile.TemporaryDirectory() as folder:
        rows = [row for how in TIME_BARS for row in measure(build, how, pathlib.Path(folder))]
    (build / "show").mkdir(exist_ok=True)
    (build / "show/overhead.json").write_text(json.dumps({"name": "overhead", "command": "make show-overhead", "rows": rows}, indent=1))
    for row in rows:
        print(f"{row['what']}: {row['figure']} (bar {row['bar']}; {row['peer']})")
    return 0 if all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
