#!/usr/bin/python3
"""libFuzzer under AddressSanitizer and UndefinedBehaviorSanitizer on every reader: `make fuzz`, `make fuzz-keep`.

usage: campaign.py BUILD run SECONDS [TARGET...] | campaign.py BUILD keep [TARGET...] | campaign.py BUILD pack FILE
INPUT...

`run` cycles through the targets (tests/fuzz/fuzz_NAME.c), one process at a time, a slice each, until SECONDS have
passed. A campaign continues where the last one stopped: inputs that reach new code are in BUILD/fuzz/found_NAME,
crashes in BUILD/fuzz/NAME-crash-*, sums of all campaigns in BUILD/fuzz/sums.json. Exits with 1 if a target crashed.
`keep` stores a minimal set of small inputs with the same coverage in tests/fuzz, and adds the sums to
tests/fuzz/sums.json, which `make show-fuzz` prints. `pack` adds inputs, such as a crash, to a target's kept inputs.
"""
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))
from seeds import make_seeds, read_pack  # noqa: E402

SLICE_S = 900  # maximum; each slice starts by reading earlier inputs, which takes minutes
LONGEST = {
    "calls": 16384, "verbs": 250_000, "snapshot": 200_000, "index": 150_000, "exr": 100_000, "oiio": 100_000,
    "ref": 100_000
}
SMALL = {"calls": 2048, "snapshot": 60_000, "index": 100_000}  # kept inputs are smaller
EDGES_ALONE = ("-set_cover_merge=1", "-use_counters=0")  # distinguishing hit counts would keep thousands of inputs
MOST_MB = {"replay": 8192}  # windows of 16384 x 16384 pixels need this much
TIMEOUT_S = 60  # wall time of a process with low priority


def all_targets():
    return sorted(path.stem[5:] for path in HERE.glob("fuzz_*.c"))


def write_pack(path, parts):
    path.write_bytes(b"".join(len(part).to_bytes(4, "little") + part for part in sorted(set(parts))))


def kept_of(target):
    """A target's kept inputs: a folder of trace streams for `replay`, a pack for every other one."""
    if target == "replay":
        return [path.read_bytes() for path in (HERE / "kept").iterdir()]
    return read_pack(HERE / f"kept_{target}")


def unpacked(folder, target):
    """The kept inputs as files in a temporary folder."""
    kept = folder / f"kept_{target}"
    shutil.rmtree(kept, ignore_errors=True)
    kept.mkdir(parents=True)
    for i, part in enumerate(kept_of(target)):
        (kept / f"{i:05}").write_bytes(part)
    return kept


def environment(target, **more):
    free = int(target != "oiio")  # leaks in its readers are not ours
    return dict(os.environ, ASAN_OPTIONS=f"allocator_may_return_null=1:detect_leaks={free}:symbolize={free}",
                UBSAN_OPTIONS=f"print_stacktrace=1:symbolize={free}", **more)


def load(path):
    return json.loads(path.read_text()) if path.exists() else {}


def add(sums, target, **more):
    row = sums.setdefault(target, {"seconds": 0, "runs": 0, "edges": 0, "of": 0, "findings": 0})
    for name, value in more.items():
        row[name] = value if name == "of" else max(row[name], value) if name == "edges" else round(row[name] + value, 1)


def slice_of(folder, target, seconds):
    """One run of libFuzzer. Its statistics are added to the sums; returns 1 after a crash."""
    found = folder / f"found_{target}"
    found.mkdir(exist_ok=True)
    work = folder / "tmp"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    program = work / target  # a copy, because it may be rebuilt meanwhile
    try:
        shutil.copy(folder / target, program)
    except OSError as why:
        print(f"{target}: {why}", flush=True)
        time.sleep(5)
        return 0
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    log = folder / f"{target}.log"
    with open(log, "w") as out:
        done = subprocess.run([
            program, f"-max_total_time={seconds}", f"-timeout={TIMEOUT_S}",
            f"-rss_limit_mb={MOST_MB.get(target, 2048)}", "-malloc_limit_mb=6000",
            f"-max_len={LONGEST.get(target, 65536)}", "-close_fd_mask=3", "-print_final_stats=1",
            f"-artifact_prefix={folder}/{target}-", found, folder / f"kept_{target}", folder / f"seeds_{target}"
        ], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=out, check=False,
                              env=environment(target, TMPDIR=str(work)))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    text = log.read_text(errors="replace")
    edges = [int(n) for n in re.findall(r" cov: (\d+)", text)]
    of = re.search(r"\((\d+) inline 8-bit counters\)", text)
    runs = re.search(r"number_of_executed_units: *(\d+)", text)
    sums = load(folder / "sums.json")
    add(sums, target, seconds=after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
        runs=int(runs.group(1)) if runs else 0, edges=max(edges, default=0), of=int(of.group(1)) if of else 0,
        findings=done.returncode != 0)
    (folder / "sums.json").write_text(json.dumps(sums, indent=1))
    if done.returncode:
        print(f"{target}: crashed",
              *re.findall(r".*(?:ERROR: |runtime error: |SUMMARY: |Test unit written).*", text), sep="\n  ", flush=True)
    row = sums[target]
    print(f"{target}: {row['runs']:.0f} runs in {row['seconds']:.0f} s, {row['edges']} of {row['of']} edges",
          flush=True)
    return done.returncode != 0


def run(build, seconds, targets):
    folder = build / "fuzz"
    make_seeds(build, folder)
    end = time.monotonic() + seconds
    for target in targets:
        unpacked(folder, target)
    broken = 0
    while time.monotonic() < end:
        for target in targets:
            left = end - time.monotonic()
            if left >= 1:
                broken |= slice_of(folder, target, int(max(1, min(SLICE_S, left, seconds / len(targets)))))
    return broken


def keep(build, targets):
    """Select a minimal set of small inputs with the coverage of all; then add the sums."""
    folder = build / "fuzz"
    for target in targets:
        most = SMALL.get(target, 3072)
        out, small = folder / f"merged_{target}", folder / "small"
        for path in (out, small):
            shutil.rmtree(path, ignore_errors=True)
            path.mkdir()
        for i, path in enumerate([*(folder / f"found_{target}").glob("*"), *(folder / f"seeds_{target}").glob("*")]):
            if path.is_file() and path.stat().st_size <= most:
                shutil.copy(path, small / str(i))
        subprocess.run(
            [folder / target, "-merge=1", *EDGES_ALONE, "-close_fd_mask=3", out,
             unpacked(folder, target), small], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, check=False, env=environment(target, FUZZ_FREE="1"))
        parts = kept_of(target) + [path.read_bytes() for path in out.iterdir() if path.stat().st_size <= most]
        if target == "replay":
            subprocess.run(["cp", "-n", *out.iterdir(), HERE / "kept"], check=False)
        elif parts:
            write_pack(HERE / f"kept_{target}", parts)
        print(f"{target}: {len(set(parts))} kept, {sum(map(len, set(parts)))} bytes", flush=True)
    sums, more = load(HERE / "sums.json"), load(folder / "sums.json")
    for target, row in more.items():
        add(sums, target, **row)
    (HERE / "sums.json").write_text(json.dumps(sums, indent=1, sort_keys=True) + "\n")
    (folder / "sums.json").unlink(missing_ok=True)
    return 0


def main():
    build, what, rest = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3:]
    if what == "run":
        return run(build, int(rest[0]), rest[1:] or all_targets())
    if what == "keep":
        return keep(build, rest or all_targets())
    file = pathlib.Path(rest[0])
    write_pack(file, read_pack(file) + [pathlib.Path(path).read_bytes() for path in rest[1:]])
    return 0


if __name__ == "__main__":
    sys.exit(main() if len(sys.argv) > 3 or sys.argv[2:] == ["keep"] else __doc__)
