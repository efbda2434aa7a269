#!/usr/bin/python3
"""tests/show/farm_limits.py BUILD TRACE [FRAMES]: what limits a farm of 10,000 nodes? A simulation based on
measurements made here.

Measured on one core with the given trace: starting a task, skipping a frame, rendering a frame, checking whether a
frame is complete, and the sizes of trace and frame. Assumed, because one machine cannot show it: the throughput of a
file server and of Slurm's controller (ASSUMED below). The simulation runs FRAMES frames (default 1,000,000) on 10 to
10,000 nodes.

Every shared resource is a server with one queue. A node takes a task, reads the trace, seeks, renders, writes, and
takes the next task. "useful" is the share of the nodes' time spent rendering.
"""
import heapq
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

ASSUMED = {
    "file server, bytes/s": 5e9,
    "file server, opens, creations and renames a second": 20e3,
    "controller, tasks a second": 100,
}
NODES = (10, 100, 1000, 10000)
CHUNKS = (10, 50, 250)
OPS_PER_FRAME, OPS_PER_TASK = 3, 200  # create, rename, check; libraries, kernels and the lock


def timed(*command):
    """Seconds of processor time, which do not depend on other load."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(c) for c in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   stdin=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(relume, trace):
    """Seconds and bytes for this trace on one core."""
    def render(frames, *more):
        return timed("taskset", "-c", "0", relume, "render", trace, "-f", frames, "-o", folder / "x.####.exr",
                     "--threads", "1", *more)

    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        dump = subprocess.run([relume, "render", trace, "-o", folder / "x.####.exr", "--dry-run"], check=True,
                              stdout=subprocess.PIPE, text=True).stdout
        last = dump.count("\n") - 1
        render("0-1")  # compiles the kernels for all later runs
        first, many, late = render("0"), render("0-20"), render(str(last))
        empty, blank = render("0-20", "--skip-existing", "--dry-run"), render("0-20", "--dry-run")
        size = (folder / "x.0005.exr").stat().st_size
    frame = max((many - first) / 20, 1e-4)
    return {
        "start": max(first - frame, 0), "frame": frame, "skip": max(late - first, 0) / last,
        "look": max(empty - blank, 0) / 21, "trace": os.path.getsize(trace), "bytes": size, "frames": last + 1
    }


class Server:
    """A server that handles requests in order of arrival."""

    def __init__(self, rate):
        self.rate, self.free, self.busy = rate, 0.0, 0.0

    def take(self, now, amount):
        spent = amount / self.rate
        self.free = max(self.free, now) + spent
        self.busy += spent
        return self.free


def simulate(m, frames, nodes, chunk, seek):
    """Returns total seconds, the useful share, and the load of each server. seek(frame): seconds to reach a frame."""
    servers = {name: Server(rate) for name, rate in ASSUMED.items()}
    files, ops, controller = servers.values()

    def task(first):
        count = min(chunk, frames - first)
        return ((controller,
                 1), (ops, OPS_PER_TASK), (files, m["trace"]), (None, m["start"] + seek(first) + count * m["frame"]),
                (ops, OPS_PER_FRAME * count), (files, m["bytes"] * count))

    tasks = (task(first) for first in range(0, frames, chunk))
    # Events in order of time: a node and the steps it has completed.
    events = [(0.0, node, ()) for node in range(nodes)]
    end = 0.0
    while events:
        now, node, steps = heapq.heappop(events)
        steps = steps or next(tasks, ())
        if not steps:
            end = max(end, now)
            continue
        server, amount = steps[0]
        heapq.heappush(events, (server.take(now, amount) if server else now + amount, node, steps[1:]))
    return end, frames * m["frame"] / (end * nodes), {name: s.busy / end for name, s in servers.items()}


def main(build, trace, frames=1_000_000):
    relume = pathlib.Path(build, "relume").resolve()
    os.environ.setdefault("POCL_CACHE_DIR", str(pathlib.Path(build, "show", "pocl-cache").resolve()))
    m = measure(relume, trace)
    frames = int(frames)
    # Scale the recording to the length of the film.
    m["trace"] *= frames / m["frames"]
    print(
        f"measured: start {m['start']:.2f} s, {m['frame']:.3f} s/frame, {1e3 * m['skip']:.3f} ms to skip a frame, "
        f"{1e3 * m['look']:.2f} ms to check one, {m['bytes'] / 1e6:.2f} MB/frame; trace of {frames:,} frames "
        f"{m['trace'] / 1e9:.2f} GB"
    )
    print("assumed:  " + ", ".join(f"{name} {rate:g}" for name, rate in ASSUMED.items()))
    print(f"status and retry check every frame: {m['look'] * frames:.0f} s\n")
    ways = {
        "every task reads from the start of the trace": (m["trace"], lambda first: first * m["skip"]),
        "index: a task reads its own part": (None, lambda first: m["skip"]),
    }
    print(f"{'':46}{'nodes':>7}{'chunk':>7}{'hours':>9}{'useful':>8}   busiest")
    for what, (whole, seek) in ways.items():
        for nodes in NODES:
            for chunk in CHUNKS:
                part = dict(m, trace=whole if whole else m["trace"] * chunk / frames)
                end, useful, busy = simulate(part, frames, nodes, chunk, seek)
                name = max(busy, key=busy.get)
                print(f"{what:46}{nodes:7}{chunk:7}{end / 3600:9.2f}{100 * useful:7.1f}%   {name.split(',')[0]} "
                      f"({name.split(', ')[1]}) {100 * busy[name]:.0f} %")
                what = ""


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
