#!/usr/bin/python3
"""tests/show/crashes.py BUILD (as `make show-crashes`): two games that crash apitrace are recorded while they are
played.

xdotool drives extremetuxracer into its race and plays foobillardplus. Each game must end normally on SIGTERM, apitrace
must read its trace to the end, and every fiftieth frame, replayed by apitrace, must equal the picture that the game
showed (the last of them show the race and the shot). Needs a display: run under tests/xvfb.sh.
"""
import json
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "real"))
from replayed import reference_frames, with_visual  # noqa: E402

EVERY = 50
PICTURE = re.compile(rb"P6\n(?:#[^\n]*\n)*(\d+) (\d+)\n255\n")
GAMES = {  # program, variables, [(seconds to wait, key pressed before)]
    "extremetuxracer": (["etr"], [], [(10, None)] + [(3, "Return")] * 6 + [(15, None)]),
    "foobillardplus": (["foobillardplus"], ["USER=player"], [(8, None)] + [(3, "Return")] * 6),
}


def play(relume, name, trace):
    program, variables, script = GAMES[name]
    command = [relume, "record", "-o", trace, "--ref", "color", "--ref-every", EVERY]
    for variable in variables:
        command += ["--env", variable]
    child = subprocess.Popen([str(c) for c in command + ["--", *program]], stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    for wait, key in script:
        if key:
            subprocess.run(["xdotool", "mousemove", "500", "400", "key", key], check=False)
        time.sleep(wait)
    alive = child.poll() is None
    child.terminate()
    try:
        out, _ = child.communicate(timeout=60)
    except subprocess.TimeoutExpired:
        child.kill()
        out, _ = child.communicate()
        alive = False
    said = re.findall(r"^relume: .*: (\d+) frames?, (\d+) calls?, .*", out, re.M)
    return alive and child.returncode in (0, 143), [int(n) for n in said[0]] if said else [0, 0]


def compare(trace, build):
    """(frames compared, frames that differ) over every fiftieth frame but the first; glretrace uses a visual like the
    game's."""
    said = subprocess.run(["apitrace", "dump", "--color=never", "--grep=StringMarker", trace], capture_output=True,
                          text=True, check=True)
    bits = re.findall(r"relume:bits ([\d ]+)", said.stdout)
    ends = subprocess.run(["apitrace", "dump", "--color=never", "--calls=frame", trace], capture_output=True, text=True,
                          check=True)
    calls = [line.split()[0] for line in ends.stdout.splitlines() if "SwapBuffers" in line]
    shown = {n: picture for n, picture in reference_frames(trace.with_suffix(".ref")).items() if n and n < len(calls)}
    chosen = sorted(shown)
    run = subprocess.run(
        ["apitrace", "replay", "--headless", "-S", ",".join(calls[n] for n in chosen), "-s", "-", trace],
        env=with_visual(bits[-1] if bits else "",
                        build), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    at, differ = 0, 0
    for n in chosen:
        head = PICTURE.search(run.stdout, at)
        if not head:
            return len(chosen), len(chosen)
        width, height = int(head.group(1)), int(head.group(2))
        at = head.end() + 3 * width * height
        differ += (width, height, run.stdout[head.end():at]) != shown[n]
    return len(chosen), differ


def main(build):
    build = pathlib.Path(build).resolve()
    work = build / "show" / "crashes"
    work.mkdir(parents=True, exist_ok=True)
    rows = []
    for name in GAMES:
        trace = work / f"{name}.trace"
        ended, (frames, calls) = play(build / "relume", name, trace)
        compared, differ = compare(trace, build) if frames else (0, 0)
        passed = ended and compared > 2 and not differ
        rows.append({
            "what": f"{name}, played", "bar": "records, replays, 0 pictures differ", "peer": "apitrace trace crashes",
            "figure": f"{frames} frames, {calls} calls; {differ} of {compared} pictures differ" +
            ("" if ended else "; it crashed"), "passed": passed
        })
        print(f"{'holds' if passed else 'FAILS'}  {name}: {rows[-1]['figure']}", flush=True)
    (build / "show" / "crashes.json"
     ).write_text(json.dumps({"name": "crashes", "command": "make show-crashes", "rows": rows}, indent=1) + "\n")
    return 0 if all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
