#!/usr/bin/python3
"""tests/show/sandbox.py BUILD (as `make show-sandbox`): what a recording could access, and the cost of confinement.

A render with empty caches runs under strace. Once confined, it must open no file outside the list below and no socket,
and start no program except the linker. Then tests/real/test_confined.py tries to break out of each verb; all attempts
must fail. Cost: processor time of the same frames with and without confinement, alternated; medians.
"""
import json
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SYSTEM = ("/usr", "/lib", "/opt", "/sys", "/proc/self", "/proc/mounts", "/proc/cpuinfo", "/proc/meminfo", "/proc/stat",
          "/proc/filesystems", "/proc/driver", "/etc/ld.so.", "/etc/OpenCL", "/etc/alternatives", "/etc/localtime",
          "/etc/locale.alias", "/etc/debian_version", "/etc/os-release", "/dev/null", "/dev/zero", "/dev/full",
          "/dev/urandom", "/dev/random", "/dev/dri", "/dev/kfd", "/dev/nvidia", "/dev/shm")
ROUNDS, FRAMES, COST = 9, 12, 1.0


def run(*args, **more):
    done = subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False,
                          **more)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, args))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")


def traced(build, work):
    """Files outside its list that a confined render opens, its sockets, and the programs that it starts."""
    env = dict(os.environ, XDG_CACHE_HOME=str(work / "cache"), POCL_CACHE_DIR=str(work / "cache/pocl"))
    log = work / "strace.log"
    run("strace", "-f", "-s", 4096, "-o", log, "-e", "trace=open,openat,creat,socket,execve,landlock_restrict_self",
        build / "relume", "render", work / "x.trace", "-f", 0, "-o", work / "frames/x.####.exr", env=env)
    lines = log.read_text().split("landlock_restrict_self", 1)[1].splitlines()[1:]
    opened = {
        m.group(1)
        for line in lines
        if " = -1 " not in line and (m := re.search(r'open(?:at)?\((?:[\w-]+, )?"([^"]+)"', line))
    }
    programs = {m.group(1) for line in lines if "ENOENT" not in line and (m := re.search(r'execve\("([^"]+)"', line))}
    sockets = [line for line in lines if "socket(" in line and "= -1" not in line]
    strangers = sorted(p for p in opened
                       if p.startswith("/") and not p.startswith((*SYSTEM, str(work), str(build.resolve()))))
    return len(opened), strangers, sockets, sorted(programs)


def seconds(build, work, *options):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run(build / "relume", "render", work / "x.trace", "-f", f"0-{FRAMES - 1}", "-o", work / "cost/x.####.exr",
        "--progress", "none", *options)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main(build):
    rows = []

    def row(what, figure, bar, passed):
        rows.append({"what": what, "figure": figure, "bar": bar, "peer": None, "passed": passed})
        print(f"{'holds' if passed else 'FAILS'}  {what}: {figure} (bar {bar})", flush=True)

    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", work / "x.trace", "--", build / "corpus/cornell",
            "--frames", FRAMES)
        n, strangers, sockets, programs = traced(build, work)
        row(f"files opened once confined, out of {n}, that are not the verb's own", len(strangers), 0, not strangers)
        print(*strangers, sep="\n")
        row("sockets opened", len(sockets), 0, not sockets)
        row("programs started", " ".join(programs) or "none", "ld",
            all(p.rsplit("/", 1)[1].startswith("ld") for p in programs))
        done = subprocess.run([ROOT / "tests/real/test_confined.py"], capture_output=True, text=True, check=False,
                              env=dict(os.environ, RELUME_BUILD=str(build.resolve())))
        row("attempts to break out of eleven verbs", done.stdout.strip().splitlines()[-1], "no failure",
            done.returncode == 0)
        seconds(build, work)
        pairs = [(seconds(build, work), seconds(build, work, "--no-sandbox")) for _ in range(ROUNDS)]
        cost = 100 * (statistics.median(a for a, _ in pairs) / statistics.median(b for _, b in pairs) - 1)
        row(f"processor time of {FRAMES} frames of Cornell, confined", f"{cost:+.2f} %", f"{COST:+.2f} %", cost <= COST)
    (build / "show").mkdir(exist_ok=True)
    (build / "show/sandbox.json").write_text(
        json.dumps({"name": "sandbox", "command": "make show-sandbox", "rows": rows}, indent=1))
    return any(not r["passed"] for r in rows)


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
