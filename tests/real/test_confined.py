#!/usr/bin/python3
"""A recording that takes over the process gains access to nothing; tests/real/intruder_shim.c acts as one. Without
confinement it gains access to everything."""
import ctypes
import os
import re
import shutil
import subprocess
import tempfile

from helpers import BUILD, RELUME, SCRATCH, check, corpus, finish, pathlib, record, relume, skip

FILES = ("read a file", "read accounts", "overwrite a file", "truncate a file", "remove a file", "make a file",
         "list a folder")
CALLS = ("socket", "local socket", "io_uring", "kill", "exec")
VERBS = {
    "info": ("info", "x.trace"),
    "dump": ("dump", "x.trace"),
    "scene": ("scene", "x.trace"),
    "index": ("index", "--force", "x.trace"),
    "export": ("export", "x.trace", "-o", "glb/x.glb"),
    "trim": ("trim", "-f", 0, "x.trace", "-o", "cut/x.trace"),
    "repair": ("repair", "x.trace", "-o", "mended/x.trace"),
    "look": ("look", "x.trace", "-o", "rules/x.look.yaml"),
    "render": ("render", "x.trace", "-f", 0, "-o", "frames/x.####.exr", "--progress", "none"),
    "diff": ("diff", "x.trace", "frames", "-f", 0, "--report", "report", "--json", "score/x.json"),
    "bench": ("bench", "x.trace", "--repeat", 1),
    "pick": ("pick", "x.trace", "400,300"),
}


def landlocked():
    return ctypes.CDLL(None).syscall(444, None, 0, 1) >= 3


def intrude(work, *args):
    """Exit code, and the errno of each attempt, 0 for success."""
    other = work / "other"
    shutil.rmtree(other, ignore_errors=True)
    other.mkdir()
    for name in ("secret", "victim"):
        (other / name).write_text("mine")
    prey = subprocess.Popen(["sleep", "1000"])
    env = dict(os.environ, LD_PRELOAD=str(BUILD / "tests/real/intruder_shim.so"), SECRET=str(other / "secret"),
               VICTIM=str(other / "victim"), NEW=str(other / "new"), PREY=str(prey.pid))
    done = relume(*args, env=env, cwd=work / "own")
    prey.kill()
    prey.wait()
    kept = sorted(p.name for p in other.iterdir()) == ["secret", "victim"] and (other / "victim").read_text() == "mine"
    return done, dict(
        (what, int(number)) for what, number in re.findall(r"intruder: ([\w ]+): (\d+)", done.stderr)), kept


if not landlocked():
    skip("this kernel's Landlock cannot refuse truncation")
if b"__asan_init" in pathlib.Path(RELUME).read_bytes():
    skip("sanitizers conflict with the preloaded shim")

with tempfile.TemporaryDirectory(dir=SCRATCH) as folder:
    work = pathlib.Path(folder)
    for name in ("own", "own/cut", "own/mended", "own/score"):
        (work / name).mkdir()
    record(work / "own/x.trace", corpus("cornell"), "--frames", 1)
    for verb, args in VERBS.items():
        done, attempts, kept = intrude(work, *args)
        check(done.returncode == 0, f"{verb}: exit code {done.returncode}: {done.stderr}")
        check(set(attempts) == {*FILES, *CALLS}, f"{verb}: attempts {attempts}")
        check(
            all(attempts.values()) and kept,
            f"{verb}: succeeded despite confinement: {[w for w, n in attempts.items() if n == 0]}")
        reports = done.stderr.replace("intruder", "")
        check("confine" not in reports and "Landlock" not in reports, f"{verb}: {reports}")
    for out in ("new/x.####.exr", "new/er/x.####.exr", f"{work}/new/x.####.exr"):
        done = relume("render", "missing.trace", "-o", out, cwd=work / "own")
        check(done.returncode == 3 and not (work / "own/new").exists() and not (work / "new").exists(),
              f"no such recording, {out}: {done}")
    for verb in ("info", "render", "diff"):
        done, attempts, kept = intrude(work, *VERBS[verb], "--no-sandbox")
        attempts.pop("io_uring") # kernels may refuse it to everyone
        check(done.returncode == 0 and not any(attempts.values()) and not kept, f"{verb} --no-sandbox: {attempts}")
finish()
