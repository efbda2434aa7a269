#!/usr/bin/python3
# limit: 400 s
"""A farm in trouble, on a real Slurm with two nodes: which frames and tasks failed, the reason, and the log's place;
two jobs for the same frames; commands at the end; pictures that cannot be scored.
"""
import contextlib
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
import cluster as slurm  # noqa: E402
from helpers import RELUME, SCRATCH, check, finish, must, record, run  # noqa: E402

FRAMES = 24
trace = SCRATCH / "gears.trace"
record(trace, "glxgears", options=("--ref", "color", "--quit-after", str(FRAMES)))
# The scalar twins need no compilation, so the first frame comes soon even on a busy machine.
QUICK = ("--device", "reference", "--mode", "gl", "--aov", "gl")
# Long enough to be interrupted: a task takes longer than Slurm and a status query.
SLOW = ("--device", "reference", "--depth=3", "--samples=4")


def words(pattern, chunk, *options, render=QUICK):
    return [trace.name, "-f", f"0-{FRAMES - 1}", "-o", pattern, "--chunk", chunk, *options, "--", *render]


def place(name):
    (SCRATCH / name).mkdir()
    return SCRATCH / name, f"{name}/x.####.exr", f"{name}/x.farm"


def until(ready, what, seconds=60):
    end = time.monotonic() + seconds
    while not ready():
        if time.monotonic() > end:
            check(False, f"{what}: not within {seconds} s")
            finish()
        time.sleep(0.05)


missing = slurm.missing_programs()
check(not missing, f"Slurm is installed: {missing}")

# Without Slurm: a run locks its folder until it ends.
folder, pattern, job = place("local")
first = subprocess.Popen([RELUME, "farm", "submit", "--local", *map(str, words(pattern, 5, render=SLOW))], cwd=SCRATCH,
                         stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
until(lambda: list(folder.glob("*.exr")), "the first frame")
before = {f.name: f.stat().st_mtime_ns for f in folder.glob("*.exr")}
second = run(RELUME, "farm", "submit", "--local", *words(pattern, 5), cwd=SCRATCH)
check(
    second.returncode == 2 and second.stderr
    == f"relume: {job}: process {first.pid} still renders there: wait for it or end it, or submit to another -o\n",
    f"a second run is refused: {second.returncode}, {second.stderr}")
status = run(RELUME, "farm", "status", job, cwd=SCRATCH)
check(status.returncode == 1 and f"\nprocess {first.pid} is at work" in status.stdout,
      f"status of a run without Slurm: {status.stdout}")
script = SCRATCH / "parallel.sh"
script.write_text(must(run(RELUME, "farm", "script", "--for", "parallel", *words(pattern, 5), cwd=SCRATCH)).stdout)
third = run("sh", script)
check(third.returncode == 2 and f"process {first.pid} still renders there" in third.stderr,
      f"a script is refused as well: {third.returncode}, {third.stderr}")
first.terminate()
check(first.wait() in (143, -signal.SIGTERM), f"the first ended by SIGTERM: {first.returncode}")
until(lambda: "nothing is at work" in run(RELUME, "farm", "status", job, cwd=SCRATCH).stdout, "nothing at work")
check(before.items() <= {f.name: f.stat().st_mtime_ns for f in folder.glob("*.exr")}.items(),
      "its frames are unchanged")
done = must(
    run(RELUME, "farm", "submit", "--local",
        *words(pattern, 5, "--at-end", 'echo "$RELUME_CODE $RELUME_FARM" >"local/end"'), cwd=SCRATCH))
check(re.search(r"^rendered again, for other settings: \d+ frames?$", done.stdout, re.M),
      f"a later run names what it replaces: {done.stdout}")
check((folder / "end").read_text() == f"0 {job}\n", f"the command at the end: {(folder / 'end').read_text()}")
done = run(RELUME, "farm", "script", "--for", "make", *words(pattern, 5, "--at-end", "true"), cwd=SCRATCH)
check(done.returncode == 2 and "behind make's" in done.stderr, f"make runs in its own way: {done.stderr}")

with slurm.Cluster(SCRATCH / "slurm") as cluster:
    def farm(*arguments, **more):
        return cluster.run(RELUME, "farm", *arguments, cwd=SCRATCH, **more)

    # Two jobs for the same frames.
    folder, pattern, job = place("twice")
    submitted = time.time()
    number = re.search(r"^render (\d+),", must(farm("submit", *words(pattern, 4, render=SLOW))).stdout, re.M)[1]
    until(lambda: list(folder.glob("*.exr")), "the first frame")
    second = farm("submit", *words(pattern, 4))
    check(
        second.returncode == 2 and re.fullmatch(
            rf"relume: {job}: Slurm job \d+ still renders there \((1 task|2 tasks) running, [0-5] waiting\): 'relume "
            rf"farm status "
            rf"{job}' shows it; submit with --replace to cancel it first, or to another -o\n", second.stderr),
        f"a second job is refused: {second.returncode}, {second.stderr}")
    check(number in second.stderr, f"by its number: {second.stderr}")
    check(SLOW[-1].encode() in (SCRATCH / job / "arguments").read_bytes(), "the first job is unchanged")
    status = farm("status", job)
    until(lambda: len(list(folder.glob("*.exr"))) >= 3, "three frames")
    status = farm("status", job)
    check(
        re.search(
            r"^tasks [12] running, [0-4] waiting; report waiting or running; [\d.]+ frames a minute, about \d+ "
            r"(s|min) left$",
            status.stdout, re.M), f"rate and time left: {status.stdout}")
    rate, took = re.search(r"; ([\d.]+) frames a minute", status.stdout), time.time() - submitted
    check(rate and float(rate[1]) >= 0.9 * 60 * 3 / took,
          f"at least three in {took:.1f} s since the submission: {status.stdout}")
    wanting = re.search(r"^missing: frames (.*)$", status.stdout, re.M)
    check(wanting and all(re.fullmatch(r"\d+(-\d+)?", part) for part in wanting[1].split(",")),
          f"the missing frames: {status.stdout}")
    done = must(farm("submit", *words(pattern, 4, "--replace"), timeout=150))
    watched = farm("status", "--watch=1", job, timeout=120)
    check(
        watched.returncode == 0 and f"frames {FRAMES} of {FRAMES} whole" in watched.stdout
        and "report exit code 0" in watched.stdout,
        f"replaced, and watched to its end: {watched.returncode}, {watched.stdout}{watched.stderr}")
    check(re.search(r"^\d\d:\d\d:\d\d  frames \d+ of 24; tasks \d running, ", watched.stdout, re.M),
          f"a line from time to time: {watched.stdout}")

    # A frame that cannot be written, a renderer that is killed, a task killed together with its script.
    folder, pattern, job = place("trouble")
    (folder / "x.0006.exr").mkdir()
    end = '{ echo "$RELUME_CODE"; relume_farm=$RELUME_FARM; echo "$relume_farm"; } >"trouble/end"'
    must(farm("submit", *words(pattern, 4, "--at-end", end, render=SLOW)))
    killed = {}

    def kill_task(task, everything):
        """Kill the renderer of a task, or all of its processes: they are stopped first, so that none reacts to
        another's end.
        """
        ours = []
        renders = False
        for pid, command in cluster.below():
            try:
                environment = pathlib.Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
            except OSError:
                continue
            if f"SLURM_ARRAY_TASK_ID={task}".encode() in environment and command != "slurmstepd" and (
                    everything or command == "relume"):
                ours.append(pid)
                renders |= command == "relume"
        if not renders:
            return  # its script has not reported its start yet
        for sign in (signal.SIGSTOP, signal.SIGKILL):
            for pid in ours:
                with contextlib.suppress(ProcessLookupError):  # it ended with its parent
                    os.kill(pid, sign)
                killed[task] = True

    until(lambda: kill_task(3, False) or 3 in killed, "task 3 runs")
    until(lambda: kill_task(4, True) or 4 in killed, "task 4 runs")
    cluster.wait_empty(200)
    status = farm("status", job)
    check(status.returncode == 1, f"status: exit code {status.returncode}")
    for what in (r"^task 2, frames 4-7: exit code 5; log trouble/x\.farm/log/2\n    relume: .*x\.0006\.exr.*$",
                 r"^task 3, frames 8-11: ended by signal 9 \(Killed\); log trouble/x\.farm/log/3$",
                 r"^task 4, frames 12-15: killed with its script \(Slurm: \w+, signal 9\); log trouble/x\.farm/log/4$",
                 r"^'relume farm retry trouble/x\.farm' renders what is missing$",
                 r"; report exit code 5$"):
        if not check(re.search(what, status.stdout, re.M), f"{what} in:\n{status.stdout}"):
            print(cluster.story(SCRATCH / job))
    check(not re.search(r"^task [156]", status.stdout, re.M), f"successful tasks are not named:\n{status.stdout}")
    check((folder / "end").read_text() == f"5\n{job}\n", f"the command at the end: {(folder / 'end').read_text()}")

    # With accounting Slurm knows more: a task that ran out of memory.
    tool = SCRATCH / "tools"
    tool.mkdir()
    (tool / "sacct").write_text(
        '#!/bin/sh\nfor job; do :; done\necho "${job}_3|FAILED|137:0"\necho "${job}_4|OUT_OF_MEMORY|0:125"\necho '
        '"${job}_5|CANCELLED by 0|0:0"\n'
    )
    (tool / "sacct").chmod(0o755)
    status = cluster.run("env", f"PATH={tool}:{cluster.env['PATH']}", RELUME, "farm", "status", job, cwd=SCRATCH)
    check("task 4, frames 12-15: killed with its script (Slurm: OUT_OF_MEMORY, signal 125); log" in status.stdout,
          f"by accounting: {status.stdout}")
    (folder / "x.0006.exr").rmdir()
    must(farm("retry", job))
    cluster.wait_empty(200)
    status = farm("status", job)
    check(status.returncode == 0 and "task " not in status.stdout, f"after retry: {status.stdout}")

    # Display pictures, another camera, missing channels gl.*: there is no score, and the reason is printed.
    for name, output, render, why in (("png", "x.####.png", ("--mode", "gl"),
                                       "only .exr holds the channels gl.* that can be"),
                                      ("aov", "x.####.exr", ("--mode", "gl", "--aov=albedo"),
                                       "--aov leaves out the channels gl.* that could be")):
        folder, _, job = place(name)
        done = must(farm("submit", *words(f"{name}/{output}", 12, render=("--device", "reference", *render))))
        check(f"\nnothing is scored: {why}\n" in done.stdout and "report" not in done.stdout, f"{name}: {done.stdout}")
        cluster.wait_empty(100)
        status = farm("status", job)
        check(status.returncode == 0 and not (SCRATCH / job / "report").exists(),
              f"{name}: {status.returncode}, {status.stdout}")
    folder, pattern, job = place("end")
    done = must(
        farm(
            "submit",
            *words("end/x.####.png", 12, "--at-end", 'echo "$RELUME_CODE" >"end/end"',
                   render=("--device", "reference", "--mode", "gl"))))
    check(re.search(r"^at the end \d+$", done.stdout, re.M), f"the command is a separate job: {done.stdout}")
    cluster.wait_empty(100)
    check((folder / "end").read_text() == "0\n", "the command knows that all frames are complete")
finish()
