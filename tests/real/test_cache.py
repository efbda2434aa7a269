#!/usr/bin/python3
# limit: 300 s
"""Trees cached on disk: frames are the same to the byte with and without the cache, with two runs at once, with damaged
files, and without a folder."""
import os
import subprocess

from helpers import RELUME, SCRATCH, check, corpus, finish, must, record, relume

TRACE = SCRATCH / "cache.trace"
FOLDER = SCRATCH / "trees"
# Mode gl is the fastest; its candidates come from the same trees.
OPTIONS = ("--mode", "gl", "--accel", "sbvh", "-f", "0", "--progress", "none")


def render(name, *options, env=None):
    """Render; returns the frame's bytes and the output."""
    done = must(relume("render", TRACE, "-o", SCRATCH / f"{name}.#.exr", *OPTIONS, *options, env=env))
    return (SCRATCH / f"{name}.0.exr").read_bytes(), done.stderr


def kept(folder):
    return sorted(folder.rglob("*")) if folder.exists() else []


record(TRACE, corpus("cornell"), "--frames", "1", "--mesh", options=())
home = dict(os.environ, XDG_CACHE_HOME=str(SCRATCH / "home"))
want, said = render("without", "--no-cache", env=home)
check(not kept(SCRATCH / "home"), f"--no-cache leaves files: {kept(SCRATCH / 'home')}")

check(render("first", "--cache", FOLDER)[0] == want, "a run that stores a tree: the frame differs")
files = kept(FOLDER)
check(len(files) == 1 and files[0].suffix == ".tree", f"kept: {files}")
whole, inode = files[0].read_bytes(), files[0].stat().st_ino
os.utime(files[0], (1, 1))
check(render("again", "--cache", FOLDER)[0] == want, "a run that finds a tree: the frame differs")
check(files[0].stat().st_ino == inode and files[0].stat().st_mtime > 1,
      "a cached tree is marked as used, and not rewritten")

render("default", env=home)
check([f.name for f in kept(SCRATCH / "home") if f.is_file()] == [files[0].name],
      f"the user's folder: {kept(SCRATCH / 'home')}")

for what, text in (("cut", whole[:len(whole) // 2]),
                   ("damaged", whole[:5000] + bytes([whole[5000] ^ 4]) + whole[5001:]), ("empty", b"")):
    files[0].write_bytes(text)
    frame, said = render(what, "--cache", FOLDER)
    check(frame == want, f"{what} file: the frame differs")
    check(files[0].read_bytes() == whole, f"{what} file is not replaced")

shared = SCRATCH / "shared"
runs = [
    subprocess.Popen([RELUME, "render", TRACE, "-o", SCRATCH / f"both{i}.#.exr", *OPTIONS, "--cache", shared])
    for i in range(2)
]
check([run.wait(timeout=120) for run in runs] == [0, 0], "two runs at once fail")
check(all((SCRATCH / f"both{i}.0.exr").read_bytes() == want for i in range(2)), "two runs at once: the frame differs")
check([f.name for f in kept(shared)] == [files[0].name] and kept(shared)[0].read_bytes() == whole,
      f"two runs store {kept(shared)}")

frame, said = render("nowhere", "--cache", "/dev/null/trees")
check(frame == want, "without a folder: the frame differs")
check(said.count("\n") == 1 and "/dev/null/trees" in said, f"an impossible folder: {said!r}")
frame, said = render("little", "--cache", SCRATCH / "little", "--cache-size", "100K")
check(frame == want and not said and not kept(SCRATCH / "little"),
      f"a tree larger than the cache: {kept(SCRATCH / 'little')} {said!r}")
for options in (("--cache-size", "much"), ("--cache", "")):
    bad = relume("render", TRACE, "-o", SCRATCH / "no.#.exr", *options)
    check(bad.returncode == 2 and bad.stderr.count("\n") == 1, f"{options}: {bad.returncode} {bad.stderr!r}")
finish()
