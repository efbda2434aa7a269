#!/usr/bin/python3
"""tests/show/soak.py BUILD (as `make show-soak`): long runs do not grow, and disturbances do not affect the output.

One process renders 24,000 frames of 64 x 48 pixels, and another records 1,000 programs. At the end, memory, descriptors
and the contents of cache and temporary folders must be as they were after the first fifth. Then come a render and a
recording while the system clock jumps, a render that is repeatedly stopped and continued, and a render to a disk that
is full and then has room again. Their output must equal that of an undisturbed run, byte for byte. `make check` runs
this with few frames (tests/real/test_soak.py).
"""
import hashlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FRAMES, PROGRAMS = 24_000, 1_000
DISTURBED = 60          # frame count of the other parts
GROWTH_MB = 8           # above the first fifth's peak; each allocator arena may gain a page later
LOOK_S = 0.05
PART = ("--mode", "gl", "--progress", "none")


def tree_bytes(folder):
    total = 0
    for place, _, names in os.walk(folder):
        for name in names:
            try:
                total += os.lstat(os.path.join(place, name)).st_size
            except OSError:
                pass  # it has disappeared
    return total


class Watch(threading.Thread):
    """Samples memory, descriptors and folders of a process over its life; `each` is called at each sample."""

    def __init__(self, pid, folders, each=None):
        super().__init__(daemon=True)
        self.pid, self.folders, self.each, self.looks = pid, folders, each, []

    def run(self):
        proc, begin = pathlib.Path(f"/proc/{self.pid}"), time.monotonic()
        try:
            while True:
                done = self.each() if self.each else 0
                memory = int((proc / "statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE") / 1e6
                self.looks.append(
                    (done, memory, len(os.listdir(proc / "fd")), sum(map(tree_bytes, self.folders)) / 1e6))
                time.sleep(min(LOOK_S, 0.002 +
                               (time.monotonic() - begin) / 100))  # sample short runs as often as long ones
        except (OSError, IndexError):
            pass  # it has ended

    def growth(self, total):
        """(MB, descriptors, MB on disk) of growth beyond the first fifth's peak; None: too few samples"""
        early = [look for look in self.looks if total * 0.02 < look[0] <= total * 0.2]
        late = [look for look in self.looks if total * 0.2 < look[0] <= total * 0.98]
        if not early or not late:
            return None
        return tuple(max(look[i] for look in late) - max(look[i] for look in early) for i in (1, 2, 3))


def flat(growth):
    return growth is not None and growth[0] <= GROWTH_MB and growth[1] <= 2 and growth[2] <= 1


def words(growth):
    return "too few looks" if growth is None else f"{growth[0]:+.1f} MB, {growth[1]:+d} descriptors, {growth[2]:+.2f} MB on disk"


class Soak:
    def __init__(self, build, work, rows):
        self.build, self.work, self.rows = build.resolve(), work, rows
        self.relume = self.build / "relume"
        self.env = dict(os.environ, TMPDIR=str(work / "tmp"), XDG_CACHE_HOME=str(work / "cache"),
                        POCL_CACHE_DIR=os.environ.get("POCL_CACHE_DIR", str(self.build / "tests/pocl-cache")))
        (work / "tmp").mkdir()

    def row(self, what, figure, bar, passed):
        self.rows.append({"what": what, "figure": figure, "bar": bar, "peer": None, "passed": bool(passed)})
        print(f"{'holds' if passed else 'FAILS'}  {what}: {figure} (bar {bar})", flush=True)

    def run(self, *args, **more):
        return subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              check=False, **{"env": self.env, **more})

    def record(self, trace, frames):
        done = self.run(ROOT / "tests/xvfb.sh", self.relume, "record", "-o", trace, "--",
                        self.build / "corpus/two_triangles", "--frames", frames, "--size", "64x48", "--animate",
                        "camera")
        if done.returncode:
            sys.exit(f"record: {done.stdout}{done.stderr}")

    # --- No growth --------------------------------------------------------------------------------------------------

    def frames(self, count):
        trace, out = self.work / "long.trace", self.work / "frames"
        self.record(trace, count)
        out.mkdir()
        seen = [0]

        def tidy():
            """Count and delete finished frames, since thousands of files are not under test."""
            for path in list(out.glob("x.*.exr")):
                path.unlink(missing_ok=True)
                seen[0] += 1
            return seen[0]

        begin = time.monotonic()
        with open(self.work / "render.log", "w") as log:
            run = subprocess.Popen([self.relume, "render", trace, "-o", out / "x.######.exr", *PART],
                                   stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=self.env)
            watch = Watch(run.pid, [self.work / "tmp", self.work / "cache"], tidy)
            watch.start()
            code = run.wait()
        watch.join()
        growth = watch.growth(count)
        left = [path.name for path in out.iterdir() if not path.name.endswith(".exr")]
        self.row(f"{count} frames by one process, {time.monotonic() - begin:.0f} s: growth after the first fifth",
                 words(growth), f"{GROWTH_MB} MB, 2 descriptors, 1 MB", code == 0 and tidy() == count and flat(growth)
                 and not left)
        shutil.rmtree(out)
        trace.unlink()

    def programs(self, count):
        """One `relume record` of a shell that runs the programs; each makes a trace of its own."""
        out = self.work / "programs"
        out.mkdir()
        script = 'i=0; while [ $i -lt $1 ]; do "$2" --frames 2 --size 64x48 >/dev/null || exit 1; i=$((i+1)); done'
        before = set(os.listdir("/dev/shm"))
        begin = time.monotonic()
        with open(self.work / "record.log", "w") as log:
            display = subprocess.Popen([
                str(a) for a in (ROOT / "tests/xvfb.sh", self.relume, "record", "-o", out / "x.trace", "--", "sh", "-c",
                                 script, "sh", count, self.build / "corpus/two_triangles")
            ], stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=self.env)
            recorder = None
            while recorder is None and display.poll() is None:
                time.sleep(LOOK_S)
                recorder = next((int(p.name) for p in pathlib.Path("/proc").glob("[0-9]*") if is_recorder(p, out)),
                                None)
            watch = Watch(recorder or display.pid, [self.work / "tmp", self.work / "cache"],
                          lambda: len(os.listdir(out)))
            watch.start()
            code = display.wait()
        watch.join()
        traces = sorted(out.glob("*.trace"))
        info = self.run(self.relume, "info", "--json", traces[-1]) if traces else None
        growth = watch.growth(count)
        stray = [name for name in set(os.listdir("/dev/shm")) - before if "relume" in name]
        self.row(
            f"{count} programs recorded by one process, {time.monotonic() - begin:.0f} s: growth after the first fifth",
            words(growth), f"{GROWTH_MB} MB, 2 descriptors, 1 MB", code == 0 and len(traces) == count
            and info.returncode == 0 and flat(growth) and not stray)
        if code:
            print((self.work / "record.log").read_text()[-2000:])
        shutil.rmtree(out)

    # --- Disturbed --------------------------------------------------------------------------------------------------

    def digests(self, folder):
        return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.glob("*.exr")}

    def render(self, trace, folder, *more, **how):
        return self.run(self.relume, "render", trace, "-o", folder / "x.####.exr", *PART, *more, **how)

    def disturbed(self, count):
        trace = self.work / "short.trace"
        self.record(trace, count)
        done = self.render(trace, self.work / "plain")
        plain = self.digests(self.work / "plain")
        if done.returncode or len(plain) != count:
            sys.exit(f"render: {done.stderr}")
        self.clock(trace, plain, count)
        self.stopped(trace, plain)
        self.full(trace, plain)

    def clock(self, trace, plain, count):
        jumping = dict(self.env, LD_PRELOAD=str(self.build / "tests/real/clock_shim.so"))
        done = self.render(trace, self.work / "clock", env=jumping)
        self.row("rendered while the time of day jumps: frames that differ",
                 differing(plain, self.digests(self.work / "clock")), 0, done.returncode == 0
                 and self.digests(self.work / "clock") == plain)
        again = self.work / "clock.trace"
        script = 'LD_PRELOAD="$1:$LD_PRELOAD"; export LD_PRELOAD; shift; exec "$@"'
        done = self.run(ROOT / "tests/xvfb.sh", self.relume, "record", "-o", again, "--", "sh", "-c", script, "sh",
                        jumping["LD_PRELOAD"], self.build / "corpus/two_triangles", "--frames", count, "--size",
                        "64x48", "--animate", "camera")
        self.render(again, self.work / "clocked", "--aov", "gl")
        self.render(trace, self.work / "unclocked", "--aov", "gl")
        pixels, same = (pictures(self, folder) for folder in (self.work / "clocked", self.work / "unclocked"))
        self.row("recorded while it jumps: frames whose pixels differ", differing(same, pixels), 0, done.returncode == 0
                 and pixels == same and len(same) == count)

    def stopped(self, trace, plain):
        out = self.work / "stopped"
        run = subprocess.Popen([str(a) for a in (self.relume, "render", trace, "-o", out / "x.####.exr", *PART)],
                               stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               env=self.env)
        stops = 0
        while run.poll() is None:
            run.send_signal(signal.SIGSTOP)
            time.sleep(0.02)
            run.send_signal(signal.SIGCONT)
            time.sleep(0.02)
            stops += 1
        self.row(f"stopped and continued {stops} times: frames that differ", differing(plain, self.digests(out)), 0,
                 run.returncode == 0 and stops > 2 and self.digests(out) == plain)

    def full(self, trace, plain):
        disk = self.work / "disk"
        disk.mkdir()
        if self.run("mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", disk).returncode:
            print("a full disk: skipped, because nothing can be mounted here")
            return
        try:
            done = self.render(trace, disk)
            torn = [p.name for p in disk.iterdir() if p.suffix != ".exr"]
            said = done.stderr.strip().splitlines()
            self.row("rendered to a full disk: exit code", done.returncode, 5, done.returncode == 5 and not torn
                     and bool(said) and "No space" in done.stderr)
            self.run("mount", "-o", "remount,size=64m", disk)
            done = self.render(trace, disk, "--skip-existing")
            self.row("rendered again once there is room: frames that differ", differing(plain, self.digests(disk)), 0,
                     done.returncode == 0 and self.digests(disk) == plain)
        finally:
            self.run("umount", disk)


def is_recorder(proc, out):
    try:
        command = (proc / "cmdline").read_bytes().split(b"\0")
        return command[0].endswith(b"relume") and command[1] == b"record" and str(out).encode() in b"\0".join(command)
    except (OSError, IndexError):
        return False


def pictures(soak, folder):
    """The pixels only, since hashes of two recordings differ."""
    return {
        path.name: soak.run("oiiotool", "--info", "--hash", path).stdout.rpartition("SHA-1:")[2].split()[0]
        for path in sorted(folder.glob("*.exr"))
    }


def differing(wanted, found):
    return sum(found.get(name) != digest for name, digest in wanted.items()) + len(set(found) - set(wanted))


def soak(build, work, frames, programs, disturbed):
    rows = []
    run = Soak(build, work, rows)
    run.disturbed(disturbed)
    run.frames(frames)
    run.programs(programs)
    return rows


def main(build):
    with tempfile.TemporaryDirectory() as folder:
        rows = soak(build, pathlib.Path(folder), FRAMES, PROGRAMS, DISTURBED)
    (build / "show").mkdir(exist_ok=True)
    (build / "show/soak.json").write_text(
        json.dumps({"name": "soak", "command": "make show-soak", "rows": rows}, indent=1))
    return any(not row["passed"] for row in rows)


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
