#!/usr/bin/python3
"""tests/show/farm.py BUILD (as `make show-farm`): two nodes against one, and a farm whose processes are killed at
random.

400 frames of glxgears, 640x480, on a real Slurm on this machine, one core per node. Bars: two nodes are 1.8 times as
fast as one; after 50 kills of tasks, slurmd and slurmctld and `relume farm retry`, every frame exists, has the same
bytes as in a local run, and was rendered only once.
"""
import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "farm"))
import cluster as slurm  # noqa: E402
import kills  # noqa: E402

FRAMES, KILLS, BAR = 400, 50, 1.8
CHUNK, CHUNK_KILLED = 20, 10
KILLED = ("--samples", "4")  # frames slow enough for all KILLS to hit one


def digests(folder):
    return {f.name: hashlib.sha256(f.read_bytes()).hexdigest() for f in folder.glob("*.exr")}


def render(work, relume, trace, *options):
    """Digests of the same frames rendered without a farm."""
    subprocess.run([relume, "render", trace, "-o", work / "local" / "x.####.exr", "--progress", "none", *options],
                   check=True)
    found = digests(work / "local")
    shutil.rmtree(work / "local")
    return found


def submit(cluster, relume, trace, folder, chunk, *options):
    folder.mkdir()
    landings = kills.Landings(folder)
    done = cluster.run(relume, "farm", "submit", trace, "-f", f"0-{FRAMES - 1}", "-o", folder / "x.####.exr", "--chunk",
                       chunk, "--", "--threads", "1", *options)
    if done.returncode:
        sys.exit(f"relume farm submit: {done.stderr}")
    return folder / "x.farm", landings


def seconds(work, relume, trace, n_nodes):
    """From the first task's start to the last frame."""
    with slurm.Cluster(work / f"slurm{n_nodes}", n_nodes=n_nodes) as cluster:
        _, landings = submit(cluster, relume, trace, work / f"nodes{n_nodes}", CHUNK)
        begin = time.monotonic()
        while sum(landings.read().values()) < FRAMES:
            time.sleep(0.02)
            if time.monotonic() - begin > 1800:
                sys.exit(f"not done after 1800 s: {cluster.queue()}")
        spent = time.monotonic() - begin
        for number in re.findall(r"\d+", (work / f"nodes{n_nodes}/x.farm/slurm").read_text()):
            cluster.run("scancel", number)  # the report is not part of the measurement
        return spent


def show_kills(work, relume, trace, local, seed):
    with slurm.Cluster(work / "slurm", n_nodes=2) as cluster:
        folder, landings = submit(cluster, relume, trace, work / "killed", CHUNK_KILLED, *KILLED)
        killer = kills.Killer(cluster, seed)
        retries = kills.campaign(cluster, killer, landings, folder, relume, KILLS, 1800, pause=(0.1, 0.8))
        status = cluster.run(relume, "farm", "status", folder).stdout.splitlines()[0]
        counts, frames = landings.read(), digests(work / "killed")
        peer = cluster.run("sbatch", "-V").stdout.strip()
    twice = sum(n > 1 for n in counts.values())
    same = sum(local.get(name) == digest for name, digest in frames.items())
    what = ", ".join(f"{n} {kind}" for kind, n in killer.done.items())
    return [
        {
            "what": "random kills during the run",
            "figure": f"{killer.total()} ({what}; {retries} retries; seed {seed})", "bar": f"{KILLS} at least",
            "peer": peer, "passed": killer.total() >= KILLS
        },
        {
            "what": "frames after that", "figure": status, "bar": f"{FRAMES} of {FRAMES} whole", "peer": None,
            "passed": status.startswith(f"frames {FRAMES} of {FRAMES} whole")
        },
        {
            "what": "frames equal to a local run, byte for byte", "figure": f"{same}", "bar": f"{FRAMES}", "peer": None,
            "passed": same == FRAMES == len(frames)
        },
        {
            "what": "rendered twice", "figure": f"{twice}", "bar": "0", "peer": None, "passed": twice == 0
            and len(counts) == FRAMES
        },
    ]


def main(build):
    build = pathlib.Path(build).resolve()
    relume = build / "relume"
    missing = slurm.missing_programs()
    if missing:
        sys.exit(f"not installed: {', '.join(missing)}")
    os.environ.setdefault("POCL_CACHE_DIR", str(build / "show" / "pocl-cache"))
    with tempfile.TemporaryDirectory(prefix="farm-") as scratch:
        work = pathlib.Path(scratch)
        trace = work / "gears.trace"
        subprocess.run([
            ROOT / "tests/xvfb.sh", relume, "record", "-o", trace, "--quit-after",
            str(FRAMES), "--", "glxgears", "-geometry", "640x480"
        ], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        local, local_killed = render(work, relume, trace), render(work, relume, trace, *KILLED)
        one, two = (seconds(work, relume, trace, n) for n in (1, 2))
        equal = digests(work / "nodes1") == digests(work / "nodes2") == local
        print(f"one node {one:.1f} s, two nodes {two:.1f} s", flush=True)
        rows = [{
            "what": f"two nodes of one core against one, {FRAMES} frames of glxgears",
            "figure": f"{one / two:.2f} x ({one:.1f} s, {two:.1f} s; load {os.getloadavg()[0]:.1f} on "
                      f"{os.cpu_count()} cores)",
            "bar": f"{BAR} x", "peer": None, "passed": one / two >= BAR and equal
        }, *show_kills(work, relume, trace, local_killed, random.randrange(1 << 30))]
    (build / "show").mkdir(exist_ok=True)
    result = {"name": "farm", "command": "make show-farm", "rows": rows}
    (build / "show" / "farm.json").write_text(json.dumps(result, indent=1) + "\n")
    for row in rows:
        print(f"{'holds' if row['passed'] else 'FAILS'}  {row['what']}: {row['figure']} (bar: {row['bar']})")
    return 0 if all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
