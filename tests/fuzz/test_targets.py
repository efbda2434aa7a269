#!/usr/bin/python3
# limit: 300 s
"""What libFuzzer found worth keeping of each reader, with every input that ever broke something (kept_NAME), and some
mutants of it."""
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "real"))
sys.dont_write_bytecode = True
from helpers import BUILD, ROOT, SCRATCH, check, finish, run  # noqa: E402

MUTANTS = 100
drive = BUILD / "tests/fuzz/drive"
os.chdir(ROOT)  # targets read golden recordings
for pack in sorted(HERE.glob("kept_*")):
    target = pack.name[5:]
    if target == "calls":
        continue  # test_calls.c
    done = run(drive, "replay", target, pack, env=dict(os.environ, TMPDIR=str(SCRATCH)))
    check(done.returncode == 0, f"{target}: what was kept: {done.stdout}{done.stderr}")
    done = run(drive, "mutate", target, MUTANTS, 1, pack, env=dict(os.environ, TMPDIR=str(SCRATCH)))
    check(done.returncode == 0, f"{target}: mutants: {done.stdout}{done.stderr}")
names = {pack.name[5:] for pack in HERE.glob("kept_*")} | {"replay"}
targets = {path.stem[5:] for path in HERE.glob("fuzz_*.c")}
check(names == targets, f"kept inputs of each target, and of nothing else: {sorted(names ^ targets)}")
finish()
