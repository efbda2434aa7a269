#!/usr/bin/python3
"""tests/show/farm_limits.py BUILD TRACE [FRAMES]: what limits a farm of 10,000 nodes? A simulation fed with
measurements made here.

Measured on one core of this machine with the trace given: starting a task, reading past one frame, rendering one,
looking whether a frame is whole, the sizes of trace and frame. Assumed, because one machine cannot show them: what a
file server and Slurm's controller deliver (ASSUMED below). The simulation then runs FRAMES frames (default 1,000,000)
on 10 to 10,000 nodes.

Every shared thing is a server with one queue; a node takes a task, reads the trace, seeks, renders, writes, and takes
the next. "useful" is the share of the nodes' time that is spent rendering.
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
OPS_PER_FRAME, OPS_PER_TASK = 3, 200  # create, rename, look; libraries, kernels and the lock


def timed(*command):
    """Seconds of processor time: what a quiet core would take, whoever else works here."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(c) for c in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   stdin=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(relume, trace):
    """Seconds and bytes of this trace on one core."""
    def render(frames, *more):
        return timed("taskset", "-c", "0", relume, "render", trace, "-f", frames, "-o", folder / "x.####.exr",
                     "--threads", "1", *more)

    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        dump = subprocess.run([relume, "render", trace, "-o", folder / "x.####.exr", "--dry-run"], check=True,
                              stdout=subprocess.PIPE, text=True).stdout
        last = dump.count("\n") - 1
        render("0-1")  # compiles the kernels, once for all
        first, many, late = render("0"), render("0-20"), render(str(last))
        empty, blank = render("0-20", "--skip-existing", "--dry-run"), render("0-20", "--dry-run")
        size = (folder / "x.0005.exr").stat().st_size
    frame = max((many - first) / 20, 1e-4)
    return {
        "start": max(first - frame, 0), "frame": frame, "skip": max(late - first, 0) / last,
        "look": max(empty - blank, 0) / 21, "trace": os.path.getsize(trace), "bytes": size, "frames": last + 1
    }


class Server:
    """Serves one after the other, in the order of their coming."""

    def __init__(self, rate):
        self.rate, self.free, self.busy = rate, 0.0, 0.0

    def take(self, now, amount):
        spent = amount / self.rate
        self.free = max(self.free, now) + spent
        self.busy += spent
        return self.free


def simulate(m, frames, nodes, chunk, seek):
    """seek(frame): seconds to get to a frame. Returns seconds in all, the useful share, how busy each server was."""
    servers = {name: Server(rate) for name, rate in ASSUMED.items()}
    files, ops, controller = servers.values()

    def task(first):
        count = min(chunk, frames - first)
        return ((controller,
                 1), (ops, OPS_PER_TASK), (files, m["trace"]), (None, m["start"] + seek(first) + count * m["frame"]),
                (ops, OPS_PER_FRAME * count), (files, m["bytes"] * count))

    tasks = (task(first) for first in range(0, frames, chunk))
    # Events in the order of time: a node has come so far with its steps.
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
    # A recording as long as the film: the trace grows with it.
    m["trace"] *= frames / m["frames"]
    print(
        f"measured: start {m['start']:.2f} s, {m['frame']:.3f} s/frame, {1e3 * m['skip']:.3f} ms to read past a frame, "
        f"{1e3 * m['look']:.2f} ms to look at one, {m['bytes'] / 1e6:.2f} MB/frame; trace of {frames:,} frames "
        f"{m['trace'] / 1e9:.2f} GB"
    )
    print("assumed:  " + ", ".join(f"{name} {rate:g}" for name, rate in ASSUMED.items()))
    print(f"status and retry look at every frame: {m['look'] * frames:.0f} s\n")
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
