#!/usr/bin/python3
"""tests/show/seek.py BUILD (as `make show-seek`): frame 9,000 of 10,000 starts as soon as frame 9; cost of the index;
processor load and memory of a long run.

Times are medians of alternating runs, so that other load affects both sides alike. They run from the command's start
until its first frame is handed to the device, including opening the device. Busy is processor time of the render
process itself (user and system) over wall time and cores, from its first finished frame to its last. Other load cannot
increase it, but reduces it. Therefore the share of cores that the process is ready to use (sampled every 5 ms,
min(ready, cores) / cores) is printed beside it, and is used if other load exceeds half a core.
"""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import threading
import time

from display import need_display

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ROUNDS = 9
FRAMES = 10000


def begin_s(build, trace, frame, folder):
    """Time from the command's start until its first frame is handed to the device."""
    out = subprocess.run(
        [build / "relume", "render", trace, "-f",
         str(frame), "-o", folder / "x.#.exr", "--progress", "json"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        text=True, check=True).stdout
    return next(e["seconds"] for e in map(json.loads, out.splitlines()) if e["event"] == "start")


def cpu_s(pid):
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def machine_s():
    """Processor time of all processes since boot."""
    fields = pathlib.Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:]
    return sum(int(fields[i]) for i in (0, 1, 2, 5, 6)) / os.sysconf("SC_CLK_TCK")


def sample_ready(pid, samples, over):
    while not over.wait(0.005):
        ready = 0
        for stat in pathlib.Path(f"/proc/{pid}/task").glob("*/stat"):
            try:
                ready += stat.read_text().rpartition(")")[2].split()[0] == "R"
            except OSError:
                pass  # the thread has ended
        samples.append((time.monotonic(), min(ready, os.cpu_count()) / os.cpu_count()))


def resident(pid):
    for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) * 1024
    return 0


def busy(build, trace, frames, folder, options=()):
    """Share of all cores that rendering uses after its first frame, share that it is ready to use, cores that other
    processes use; memory at a third of the run and at its end."""
    child = subprocess.Popen([
        build / "relume", "render", trace, "-f", f"0-{frames - 1}", "-o", folder / "b.#.exr", "--progress", "json",
        *options
    ], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    first = last = None
    early = late = 0
    samples, over = [], threading.Event()
    sampler = threading.Thread(target=sample_ready, args=(child.pid, samples, over))
    sampler.start()
    for line in child.stdout:
        event = json.loads(line)
        if event["event"] != "frame":
            continue
        now = (time.monotonic(), cpu_s(child.pid), machine_s())
        first = first or now
        last = now
        if event["done"] <= frames // 3:
            early = max(early, resident(child.pid))
        late = max(late, resident(child.pid))
        (folder / f"b.{event['frame']}.exr").unlink(missing_ok=True)
    over.set()
    sampler.join()
    assert child.wait() == 0
    wall, own = last[0] - first[0], last[1] - first[1]
    ready = statistics.mean(share for at, share in samples if first[0] <= at <= last[0])
    others = (last[2] - first[2] - own) / wall
    return own / wall / os.cpu_count(), ready, others, early, late


def main(build, long_frames):
    need_display()
    build = pathlib.Path(build).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        trace = folder / "gears.trace"
        subprocess.run([build / "relume", "record", "-o", trace, "--quit-after",
                        str(FRAMES), "--", "glxgears"], check=True, env=dict(os.environ, vblank_mode="0"),
                       stdout=subprocess.DEVNULL)
        index = json.loads(
            subprocess.run([build / "relume", "index", "--force", "--json", trace], check=True, text=True,
                           stdout=subprocess.PIPE).stdout)
        assert index["frames"] >= FRAMES - 1, index
        start = time.monotonic()
        subprocess.run([build / "relume", "info", trace], check=True, stdout=subprocess.DEVNULL)
        info_s = time.monotonic() - start
        near, far = [], []
        for _ in range(ROUNDS):
            near.append(begin_s(build, trace, 9, folder))
            far.append(begin_s(build, trace, 9000, folder))
        ratio = statistics.median(far) / statistics.median(near)
        share, ready, others, _, _ = busy(build, trace, 300, folder)
        counts = ready if others > 0.5 else share
        rows = [{
            "what": f"frame 9,000 of {FRAMES} begins, over frame 9 (warm index; medians "
                    f"{statistics.median(far) * 1e3:.0f} and "
            f"{statistics.median(near) * 1e3:.0f} ms)", "figure": f"{ratio:.2f}x", "bar": "1.2x", "peer": None,
            "passed": ratio <= 1.2
        }, {
            "what": f"index of {FRAMES} frames: share of the trace's bytes, made in "
            f"{index['build_us'] / 1e6:.2f} s ('relume info', which executes and builds all frames: {info_s:.2f} s)",
            "figure": f"{100 * index['bytes'] / index['trace_bytes']:.1f} %", "bar": None, "peer": None, "passed": True
        }, {
            "what": f"cores busy while 300 frames are rendered, after the first (used {100 * share:.0f} %, ready to "
                    f"use "
            f"{100 * ready:.0f} %; others used {others:.1f} cores)", "figure": f"{100 * counts:.0f} %", "bar": "95 %",
            "peer": None, "passed": counts >= 0.95
        }]
        if long_frames:
            _, _, _, early, late = busy(build, trace, long_frames, folder, ("--mode", "gl", "--aov", "gl"))
            rows.append({
                "what": f"peak memory over {long_frames} frames, relative to the first third ({early >> 20} MiB)",
                "figure": f"{late / early:.2f}x", "bar": "1.1x", "peer": None, "passed": late <= 1.1 * early
            })
    for row in rows:
        print(f"{row['what']}: {row['figure']} (bar {row['bar']})")
    (build / "show").mkdir(exist_ok=True)
    if long_frames >= 3000:
        (build / "show/seek.json").write_text(
            json.dumps({"name": "seek", "command": "make show-seek", "rows": rows}, indent=1))
    return 0 if all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 3000))
