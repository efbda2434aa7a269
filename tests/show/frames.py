#!/usr/bin/python3
"""tests/show/frames.py BUILD [--only WORD]...: cost of whole frames, compared with that of their rays and with a
rasteriser.

A frame's processor time (user and system, whole processes) is the difference between runs of MANY and FEW frames,
divided by the difference in frames; start-up is measured separately. Our runs and the peers' alternate; figures are
medians. Peers: Embree's time for the same frames' camera and shadow rays (tests/bench/frame_rays.c); glretrace -b -s,
which replays the same calls on Mesa's llvmpipe and writes a PNG file per frame.

--only selects parts by a word of their names: whole, raster, cores, memory, start, pixels.
"""
import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SHARED = ROOT.parent / "shared/traces"
FEW, MANY = 2, 12
ROUNDS = 3
SCENES = ("cornell", "spheres", "hall", "still_life")
HACKS = {
    "superquadrics": ["/usr/libexec/xscreensaver/superquadrics", "-geometry", "640x480"],
    "glxgears": ["glxgears", "-geometry", "800x600"]
}
TRACES = {
    "neverball": 8, "openarena": 0
}  # recordings of ../shared/traces, each with the first frame to compare; openarena: recorded in play
SIZES = ("800x600", "1920x1080", "3840x2160")
BARS = {"whole": 3, "raster": 1.0, "whitted": 0.5, "cores": 0.95, "memory": 1.5, "start": 0.25, "pixels": 1.2}


class Run:
    """A finished process: its processor time, wall time and peak memory."""

    def __init__(self, command, **more):
        begin = time.monotonic()
        process = subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, **more)
        with process.stdout, process.stderr:
            self.said, complaint = process.stdout.read(), process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.wall = time.monotonic() - begin
        self.cpu = used.ru_utime + used.ru_stime
        self.gigabytes = used.ru_maxrss / 1024 ** 2
        if process.returncode:
            sys.exit(f"{command[0]} exits with {process.returncode}:\n{complaint[-1500:]}")


class Show:
    def __init__(self, build, only):
        self.build, self.only, self.rows = build, only, []
        self.folder = build / "show" / "frames"
        self.folder.mkdir(parents=True, exist_ok=True)
        self.scratch = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        device = json.loads(
            subprocess.run([build / "relume", "devices", "--json"], capture_output=True, text=True).stdout)[0]
        self.device = f"{device['name']}, vectors of {device['width']}"

    def part(self, name):
        return not self.only or name in self.only

    def say(self, what, figure, text, bar, peer=None, most=True):
        """Print one row. With `most` the figure must be at most the bar; otherwise it must be at least the bar."""
        passed = None if bar is None else figure <= bar if most else figure >= bar
        limit = None if bar is None else f"{'at most' if most else 'at least'} {bar}"
        self.rows.append({"what": what, "figure": text, "bar": limit, "peer": peer, "passed": passed})
        print(f"{what:58}{text:34}{limit or '':16}{'' if passed is None else 'holds' if passed else 'FAILS'}",
              flush=True)

    # --- Recordings ------------------------------------------------------------------------------------------------

    def record(self, name, frames, command):
        """Record a program once."""
        trace = self.folder / f"{name}.trace"
        if not trace.exists():
            Run([self.build / "relume", "record", "-o", trace, "--quit-after", frames, "--", *command],
                env=dict(os.environ, vblank_mode="0"))
        return trace

    def corpus(self, program, size="800x600", frames=MANY):
        return self.record(f"{program}.{size}", frames,
                           [self.build / "corpus" / program, "--frames", frames, "--animate", "camera", "--size", size])

    def cut(self, trace, frames, first=0):
        """Cut the first frames off a recording, for peers that can only replay whole ones."""
        out = self.folder / f"{trace.stem}.{frames}.trace"
        if not out.exists():
            Run([self.build / "relume", "trim", "-f", f"{first}-{first + frames - 1}", "-o", out, trace])
            there = json.loads(Run([self.build / "relume", "info", "--json", out]).said)["frames"]
            if there != frames:
                sys.exit(
                    f"{out}: frames before {first} are kept as well, which peers would replay: take a recording that "
                    f"begins there"
                )
        return out

    # --- Costs ------------------------------------------------------------------------------------------------------

    def render(self, trace, frames, *options):
        return Run([
            self.build / "relume", "render", trace, "-f", f"0-{frames - 1}", "-o", self.scratch / "####.exr",
            "--progress", "none", *options
        ])

    def replay(self, trace):
        return Run(["glretrace", "-b", "-s", f"{self.scratch}/", trace], env=dict(os.environ,
                                                                                  LIBGL_ALWAYS_SOFTWARE="1"))

    def frame_ms(self, run, few=FEW, many=MANY):
        """A frame's processor time; run(n) renders n frames."""
        return 1e3 * (run(many).cpu - run(few).cpu) / (many - few)


def medians(rounds, measures):
    """Run all measurements in turn, several times; returns the median of each."""
    figures = [[measure() for measure in measures] for _ in range(rounds)]
    return [statistics.median(column) for column in zip(*figures)]


def show_whole(show):
    for name in SCENES:
        trace = show.corpus(name)

        def rays():
            said = Run([show.build / "tests/bench/frame_rays", trace, MANY // 2, 5]).said.split()
            return float(said[0]) + float(said[1])

        show.render(trace, 1)  # compile the kernels before measuring
        ours, peer = medians(ROUNDS, [lambda: show.frame_ms(lambda n: show.render(trace, n)), rays])
        show.say(f"{name} 800x600, default channels: frame / its rays", ours / peer,
                 f"{ours / peer:.1f} ({ours:.0f} / {peer:.0f} ms)", BARS["whole"], f"Embree, {peer:.1f} ms")


def show_raster(show):
    traces = [(name, show.corpus(name)) for name in ("cornell", "hall")]
    traces += [(name, show.record(name, MANY, command)) for name, command in HACKS.items()]
    for name, first in TRACES.items():
        if (SHARED / f"{name}.trace").exists():
            traces.append((name, show.cut(SHARED / f"{name}.trace", MANY, first)))
        else:
            show.say(f"{name}: gl / glretrace", 0, "not run: no recording", None)
    for name, trace in traces:
        few = show.cut(trace, FEW)
        show.render(trace, 1)
        gl, whitted, peer = medians(ROUNDS, [
            lambda: show.frame_ms(lambda n: show.render(trace, n, "--mode", "gl", "--aov", "gl")),
            lambda: show.frame_ms(lambda n: show.render(trace, n, "--aov", "")),
            lambda: show.frame_ms(lambda n: show.replay(trace if n == MANY else few))])
        for what, ours, bar in (("gl", gl, BARS["raster"]), ("whitted, beauty alone", whitted, BARS["whitted"])):
            show.say(f"{name}: glretrace / {what}", peer / ours, f"{peer / ours:.2f} ({peer:.0f} / {ours:.0f} ms)", bar,
                     "glretrace", most=False)


def show_cores(show):
    cores = os.cpu_count()
    for name in ("cornell", "hall"):
        trace = show.corpus(name)
        runs = [show.render(trace, MANY) for _ in range(ROUNDS)]
        share = statistics.median(run.cpu / (cores * run.wall) for run in runs)
        show.say(f"{name}, {MANY} frames: processor time / ({cores} cores x wall)", share,
                 f"{share:.2f} (others' load {os.getloadavg()[0]:.1f})", BARS["cores"], most=False)


def show_memory(show):
    trace = show.corpus("hall", "3840x2160", 3)
    for jobs in (1, 2, 8):
        most = show.render(trace, 3, "--jobs", jobs).gigabytes
        show.say(f"hall 3840x2160, {jobs} frames in parallel: memory", most, f"{most:.2f} GB", BARS["memory"])


def show_start(show):
    trace = show.corpus("cornell")
    show.render(trace, 1)
    runs = [show.render(trace, 1) for _ in range(2 * ROUNDS + 1)]
    wall = statistics.median(run.wall for run in runs)
    show.say("cornell, one frame, from exec to exit", wall,
             f"{wall:.2f} s ({statistics.median(run.cpu for run in runs):.2f} s processor)", BARS["start"])


def show_pixels(show):
    costs = {}
    for size in SIZES:
        width, height = map(int, size.split("x"))
        many = MANY if size == SIZES[0] else 4
        trace = show.corpus("hall", size, 3 if size == SIZES[-1] else many)
        many = min(many, 3) if size == SIZES[-1] else many
        show.render(trace, 1)
        ms, = medians(ROUNDS, [lambda: show.frame_ms(lambda n: show.render(trace, n), 1, many)])
        costs[size] = 1e6 * ms / (width * height)
        show.say(f"hall {size}: a frame", ms, f"{ms:.0f} ms, {costs[size]:.0f} ns per pixel", None)
    spread = max(costs.values()) / min(costs.values())
    show.say("hall: highest / lowest cost per pixel over the sizes", spread, f"{spread:.2f}", BARS["pixels"])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", action="append", default=[])
    arguments = parser.parse_args()
    show = Show(arguments.build.absolute(), arguments.only)
    print(f"{show.device}; {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}", flush=True)
    try:
        for name, part in (("whole", show_whole), ("raster", show_raster), ("cores", show_cores),
                           ("memory", show_memory), ("start", show_start), ("pixels", show_pixels)):
            if show.part(name):
                part(show)
    finally:
        shutil.rmtree(show.scratch)
    (arguments.build / "show" / "frames.json").write_text(json.dumps(
        {"name": "frames", "command": "make show-frames", "device": show.device, "rows": show.rows}, indent=1) + "\n")
    return 0 if all(row["passed"] is not False for row in show.rows) else 1


if __name__ == "__main__":
    sys.exit(main())
