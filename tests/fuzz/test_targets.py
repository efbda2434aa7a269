#!/usr/bin/python3
# limit: 300 s
"""Kept inputs of each reader, found by libFuzzer and including every one that ever failed (kept_NAME), and some mutants
of them."""
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "real"))
sys.dont_write_bytecode = True
from helpers import BUILD, ROOT, SCRATCH, check, finish, run  # noqa: E402

MUTANTS = 100
drive = BUILD / "tests/fuzz/drive"
os.chdir(ROOT)  # targets read the golden recordings
for pack in sorted(HERE.glob("kept_*")):
    target = pack.name[5:]
    if target == "calls":
        continue  # covered by test_calls.c
    done = run(drive, "replay", target, pack, env=dict(os.environ, TMPDIR=str(SCRATCH)))
    check(done.returncode == 0, f"{target}: kept inputs: {done.stdout}{done.stderr}")
    done = run(drive, "mutate", target, MUTANTS, 1, pack, env=dict(os.environ, TMPDIR=str(SCRATCH)))
    check(done.returncode == 0, f"{target}: mutants: {done.stdout}{done.stderr}")
names = {pack.name[5:] for pack in HERE.glob("kept_*")} | {"replay"}
targets = {path.stem[5:] for path in HERE.glob("fuzz_*.c")}
check(names == targets, f"kept inputs of exactly the targets: {sorted(names ^ targets)}")
finish()
