#!/usr/bin/python3
"""tests/show/replay.py BUILD: speed of replay without rendering, compared with apitrace's dump and glretrace.

Figures are processor time (user and system) of whole processes, medians of alternating runs. Other load and the X
server's share do not count, so glretrace is spared its server's work. Ours is `relume index --force`: every call is
replayed and checkpoints are written, but no frame's scene is built.
"""
import json
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ROUNDS = 3
BARS = {"dump": 10, "glretrace": 2}
SHARED = ROOT.parent / "shared/traces"
# "Large": recordings of hundreds of thousands of calls.
PROGRAMS = {
    "superquadrics": ["timeout", "6", "/usr/libexec/xscreensaver/superquadrics", "-geometry", "320x240"],
    "glxgears": ["timeout", "6", "glxgears", "-geometry", "100x100"],
    "molecule": ["timeout", "6", "/usr/libexec/xscreensaver/molecule", "-geometry", "320x240"],
}


def cpu_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(build, trace):
    tools = {
        "relume": [build / "relume", "index", "--force", trace], "dump": ["apitrace", "dump", "--color=never", trace],
        "glretrace": ["glretrace", "-b", trace]
    }
    times = {name: [] for name in tools}
    for _ in range(ROUNDS):
        for name, command in tools.items():
            times[name].append(cpu_seconds(command))
    return {name: statistics.median(values) for name, values in times.items()}


def recordings(build):
    folder = build / "show" / "replay"
    folder.mkdir(parents=True, exist_ok=True)
    for name, program in PROGRAMS.items():
        trace = folder / f"{name}.trace"
        if not trace.exists():
            subprocess.run([build / "relume", "record", "-o", trace, "--", *program], check=False,
                           env=dict(os.environ, vblank_mode="0"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        yield trace
    for name in ("neverball", "billard-gl", "rss-lattice"):
        if (SHARED / f"{name}.trace").exists():
            # Copied to a writable folder, so that the index is beside the recording in all cases.
            yield shutil.copy(SHARED / f"{name}.trace", folder)


def main(build):
    rows = []
    version = subprocess.run(["apitrace", "version"], capture_output=True, text=True).stdout.strip()
    for trace in map(pathlib.Path, recordings(build)):
        info = json.loads(
            subprocess.run([build / "relume", "info", "--json", trace], capture_output=True, text=True).stdout)
        times = measure(build, trace)
        for peer, bar in BARS.items():
            ratio = times[peer] / times["relume"]
            rows.append({
                "what": f"{trace.stem}, {info['frames']} frames, {info['calls']} calls: replay against {peer}",
                "figure": f"{ratio:.1f} times as fast", "bar": f"{bar}", "peer": version, "passed": ratio >= bar
            })
            print(f"{rows[-1]['what']}: {rows[-1]['figure']} (bar {bar})", flush=True)
    (build / "show" / "replay.json").write_text(
        json.dumps({"name": "replay", "command": "make show-replay", "rows": rows}, indent=1))
    return 0 if all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).absolute()))
