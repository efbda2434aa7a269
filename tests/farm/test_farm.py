#!/usr/bin/python3
# limit: 600 s
"""relume farm on a real Slurm with two nodes on this machine, and without Slurm: the same frames as a local run, to the
byte."""
import hashlib
import os
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
import cluster as slurm  # noqa: E402
import kills  # noqa: E402
from helpers import RELUME, SCRATCH, check, finish, must, record, run  # noqa: E402

FRAMES = 24
trace = SCRATCH / "it's gears.trace"
record(trace, "glxgears", options=("--ref", "color,depth", "--quit-after", str(FRAMES)))
# A name that a shell would split.
NAME = "a $b 'c"


def place(name):
    folder = SCRATCH / name
    folder.mkdir()
    return folder, folder / f"{NAME}.####.exr", folder / f"{NAME}.farm"


def digests(folder):
    return {f.name: hashlib.sha256(f.read_bytes()).hexdigest() for f in sorted(folder.glob("*.exr"))}


def words(pattern, chunk, *options):
    return [
        trace.name, "-f", f"0-{FRAMES - 1}", "-o", pattern, "--chunk", chunk, *options, "--", "--threads", "1",
        "--mode", "whitted"
    ]


# Without Slurm: a PATH that lacks it. (PoCL links kernels with ld.)
bare = SCRATCH / "bin"
bare.mkdir()
for tool in ("sh", "realpath", "mkdir", "flock", "seq", "ld"):
    (bare / tool).symlink_to(f"/usr/bin/{tool}")
# With Slurm's commands, but without its controller: one line, which names the ways to go on.
dead = SCRATCH / "dead"
dead.mkdir()
for tool in ("sbatch", "scontrol"):
    (dead / tool).write_text("#!/bin/sh\necho 'slurm_load_ctl_conf error' >&2\nexit 1\n")
    (dead / tool).chmod(0o755)
_, pattern, job = place("dead job")
done = run(RELUME, "farm", "submit", *words(pattern, 5), cwd=SCRATCH, env=dict(os.environ, PATH=f"{dead}:{bare}"))
check(done.returncode == 5 and done.stderr.count("\n") == 1 and "--local" in done.stderr
      and "relume farm script" in done.stderr and not job.exists(), f"no controller: {done.returncode}, {done.stderr}")
folder, pattern, job = place("local")
done = must(run(RELUME, "farm", "submit", *words(pattern, 5), cwd=SCRATCH, env=dict(os.environ, PATH=str(bare))))
local = digests(folder)
check(len(local) == FRAMES, f"locally {len(local)} frames of {FRAMES}")
check((job / "report/index.html").stat().st_size > 10000 and f"job {job}" in done.stdout,
      "the page exists, with the job's name")
single = SCRATCH / "single"
must(run(RELUME, "render", trace, "-f", f"0-{FRAMES - 1}", "-o", single / f"{NAME}.####.exr", "--mode", "whitted"))
check(digests(single) == local, "the same bytes as one run of relume render")

# Wrong usage and unreadable input stop before anything is submitted.
_, pattern, job = place("none")
for what, code, text, arguments in (
        ("no frames", 2, "-f FRAMES", ["x.trace", "-o", pattern]),
        ("a frame that is not there", 2, "frame 99", [trace, "-f", "0-99", "-o", pattern]),
        ("no such trace", 3, "none.trace", ["none.trace", "-f", "1", "-o", pattern]),
        ("an option that render does not know", 2, "--nonsense", [trace, "-f", "1", "-o", pattern, "--", "--nonsense"]),
        ("frames behind the --", 2, "--chunk", [trace, "-f", "1", "-o", pattern, "--", "--chunk=1/2"]),
        ("no frame number", 2, "no place", [trace, "-f", "1-2", "-o", "x.exr"]),
        ("no tasks", 2, "--chunk", [trace, "-f", "1", "-o", pattern, "--chunk", "0"])):
    done = run(RELUME, "farm", "submit", "--local", *arguments)
    check(done.returncode == code and text in done.stderr, f"{what}: exit code {done.returncode}, {done.stderr}")
check(not job.exists(), "nothing was written")
done = run(RELUME, "farm", "status", SCRATCH)
check(done.returncode == 3 and "is no job" in done.stderr,
      f"status of a folder without a job: {done.returncode}, {done.stderr}")

# Scripts for other engines.
for engine, start in (("parallel", ["sh"]), ("make", ["make", "-k", "-j2", "-f"])):
    folder, pattern, job = place(engine)
    script = SCRATCH / f"{engine}.script"
    script.write_text(must(run(RELUME, "farm", "script", "--for", engine, *words(pattern, 9), cwd=SCRATCH)).stdout)
    must(
        run(*start, script, cwd="/",
            env={k: v for k, v in os.environ.items() if not k.startswith("MAKE") and k != "MFLAGS"}))
    check(digests(folder) == local, f"{engine}: the same frames")
    check((job / "report/index.html").exists(), f"{engine}: the page")

# For GPU nodes: the tasks request GPUs, the report does not.
script = must(
    run(RELUME, "farm", "script", "--for", "slurm",
        *words(SCRATCH / "gpu" / f"{NAME}.####.exr", 9, "--gres", "gpu:1", "--sbatch=--partition=night"),
        cwd=SCRATCH)).stdout
submits = re.findall(r"\bsbatch .*", script)
check(
    len(submits) == 2 and all("--partition=night" in line for line in submits), f"both go to the partition: {submits}")
check("--gres 'gpu:1'" in submits[0] and "--array" in submits[0] and "--gres" not in submits[1],
      f"tasks request GPUs: {submits}")

missing = slurm.missing_programs()
check(not missing, f"Slurm is installed: {missing}")
with slurm.Cluster(SCRATCH / "slurm", gres="gpu:1") as cluster:
    def farm(*arguments):
        return cluster.run(RELUME, "farm", *arguments, cwd=SCRATCH)

    folder, pattern, job = place("farm")
    done = must(farm("submit", *words(pattern, 5, "--gres", "gpu:1", "--sbatch=--comment=night run")))
    found = re.search(r"^render (\d+), tasks 1-5\nreport (\d+)$", done.stdout, re.M)
    check(found, f"submit prints the numbers of both jobs: {done.stdout}")
    batch = cluster.run("scontrol", "show", "job", found[1]).stdout
    check(
        re.search("gres[:/]gpu:1", batch) and "Comment=night run" in batch,
        f"sbatch received its options: {batch[:3000]}")
    check(f"afterany:{found[1]}" in cluster.run("scontrol", "show", "job", found[2]).stdout,
          "the report waits for the frames")
    done = farm("status", job)
    check(done.returncode == 1 and "report waiting" in done.stdout,
          f"status while it runs: {done.returncode}, {done.stdout}")
    cluster.wait_empty(120)
    check(digests(folder) == local, "two nodes: the same bytes as locally")
    used = set(re.findall(r" NodeList=(n\d)", cluster.run("scontrol", "-o", "show", "job", found[1]).stdout))
    check(used == {"n1", "n2"}, f"both nodes worked: {used}")
    done = farm("status", job)
    check(done.returncode == 0 and f"frames {FRAMES} of {FRAMES} whole" in done.stdout and "page" in done.stdout,
          f"status afterwards: {done.returncode}, {done.stdout}")
    check("rendered frame 0" in (job / "log/1").read_text(), "each task has a log")

    # One frame lost, one torn, one with other settings: only these are rendered again, by their tasks alone.
    files = sorted(folder.glob("*.exr"))
    files[1].unlink()
    files[12].write_bytes(files[12].read_bytes()[:5000])
    must(run(RELUME, "render", trace, "-f", "13", "-o", pattern, "--mode", "gl"))
    done = farm("status", job)
    check(
        done.returncode == 1
        and f"{FRAMES - 3} of {FRAMES} whole, 1 missing, 1 damaged, 1 rendered with other settings" in done.stdout,
        f"status of damaged frames: {done.stdout}")
    landings = kills.Landings(folder)
    done = must(farm("retry", job))
    check("tasks 1,3\n" in done.stdout, f"retry starts two of five tasks: {done.stdout}")
    again = farm("retry", job)
    check(again.returncode == 0 and "waits or runs already" in again.stdout,
          f"retry ignores tasks already running: {again.stdout}")
    cluster.wait_empty(120)
    check(digests(folder) == local, "after retry: the same bytes again") or print(cluster.story(job))
    landed = set(landings.read())
    check(landed == {files[1].name, files[12].name, files[13].name}, f"only the three were rendered: {landed}")

    # Cancel stops everything, and keeps finished frames.
    folder, pattern, job = place("cancelled")
    must(farm("submit", *words(pattern, 1)))
    landings = kills.Landings(folder)
    while not landings.read():
        pass
    must(farm("cancel", job))
    cluster.wait_empty(60)
    kept = digests(folder)
    check(0 < len(kept) < FRAMES and kept.items() <= local.items(), f"cancelled after {len(kept)} frames, all complete")
    check(not list(folder.glob("*.part")), "no partial file is left")

    # Killed at random.
    folder, pattern, job = place("killed")
    landings = kills.Landings(folder)
    must(farm("submit", *words(pattern, 4)))
    killer = kills.Killer(cluster, 7)
    kills.campaign(cluster, killer, landings, job, RELUME, 5, 120, pause=(0.1, 0.5))
    counts = landings.read()
    check(killer.total() >= 3, f"killed {killer.done}")
    check(digests(folder) == local, f"after {killer.done} killed: the same bytes as locally")
    check(set(counts.values()) == {1}, f"every frame was written once: {counts}")

    # More tasks than an array allows.
    folder, pattern, job = place("many")
    done = cluster.run(RELUME, "farm", "submit", trace, "-f", f"0-{FRAMES - 1}", "-o", pattern, "--gres", "gpu:2")
    check(done.returncode == 5, f"requests that no node can satisfy are refused: {done.returncode}, {done.stderr}")

with slurm.Cluster(SCRATCH / "small", n_nodes=1, settings=["MaxArraySize=9"]) as cluster:
    done = cluster.run(RELUME, "farm", "submit", *words(pattern, 2), cwd=SCRATCH)
    check(done.returncode == 2 and "--chunk 3 " in done.stderr,
          f"too many tasks for the cluster: {done.returncode}, {done.stderr}")
    cluster.kill("slurmctld")
    done = cluster.run(RELUME, "farm", "submit", *words(pattern, 20), cwd=SCRATCH)
    check(done.returncode == 5 and "controller" in done.stderr,
          f"without a controller: {done.returncode}, {done.stderr}")
finish()
