#!/usr/bin/python3
"""tests/show/inject.py BUILD [--only VERB] (as `make show-inject`): each system call fails once, in turn.

The nth malloc, read, write, mmap, open or thread creation of the command fails (tests/real/inject_shim.c), for every n
of a small index, info, scene, trim, render and diff; first only that call, then that call and all later ones. The
command must either reach the same result anyway, or end with code 3 or 5 and one line that gives the reason. It must
leave no partial file and leak no memory: all runs use LeakSanitizer if gcc provides it. The recorder runs under the
same shim: the program's pictures and exit code must not change. (OpenCL calls: show-device-faults.)
"""
import argparse
import concurrent.futures
import fnmatch
import hashlib
import itertools
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "tests/show"), str(ROOT / "tests")]
import run as runner  # noqa: E402
from table import Shown  # noqa: E402

CLASSES = ("malloc", "read", "write", "mmap", "open", "thread")
LIMIT_S = 120  # wall time, on a machine that may be busy


class Case:
    """A command line; words @trace, @programs, @frames, @ref are replaced by inputs. made: a pattern for each file that
    it writes."""

    def __init__(self, name, command, made=()):
        self.name, self.command, self.made = name, command, made


CASES = [
    Case("index", ["index", "--force", "@trace"], ["x.trace.index"]),
    Case("info", ["info", "@trace"]),
    Case("scene", ["scene", "-f", "0", "--json", "@trace"]),
    Case("trim", ["trim", "-f", "0", "-o", "new.trace", "@trace"], ["new.trace"]),
    Case("diff", ["diff", "--json", "s.json", "--junit", "j.xml", "--report", "report", "@ref", "@frames"],
         ["s.json", "j.xml", "report/index.html"]),
    Case("render",
         ["render", "@trace", "-f", "0", "--mode", "gl", "--aov", "gl", "-o", "out.####.exr", "--progress", "none"],
         ["out.0000.exr"]),
    Case("render by programs", ["render", "@programs", "-f", "0", "-o", "out.####.exr", "--progress", "none"],
         ["out.0000.exr"]),
    Case("approve", ["approve", "@frames", "approved"],
         [f"approved/*/{name}" for name in ("baseline.yaml", "frame.0000.exr", "frame.0001.exr")]),
]


def leak_sanitizer():
    """Path of the LeakSanitizer library for LD_PRELOAD, or None if there is none."""
    said = subprocess.run(["gcc", "-print-file-name=liblsan.so"], capture_output=True, text=True,
                          check=False).stdout.strip()
    return pathlib.Path(said) if "/" in said else None


def digest(path):
    text = path.read_bytes()
    if path.suffix in (".json", ".xml", ".html"):  # timings and host names differ
        text = b"\n".join(line for line in text.splitlines() if b"seconds" not in line and b"time=" not in line)
    return hashlib.sha256(text).hexdigest()


def plain(out):
    return [line for line in out.splitlines() if not line.startswith(b"built in")]


class Trial:
    def __init__(self, build, inputs):
        self.build, self.relume, self.shim, self.inputs = build.resolve(), (build / "relume").resolve(), (
            build / "tests/real/inject_shim.so").resolve(), inputs
        self.spared = (ROOT / "tests/lsan.supp").read_text()

    def run(self, case, inject=None, cache=None):
        """(exit code, stdout, stderr, {file: digest}, names of other files, counts of calls)"""
        with tempfile.TemporaryDirectory(dir=self.inputs) as folder:
            work, count = pathlib.Path(folder), pathlib.Path(f"{folder}.count")
            shutil.copy2(self.inputs / "x.trace", work)
            if case.name != "index":
                shutil.copy2(self.inputs / "x.trace.index", work)
            words = {"@trace": "x.trace", "@programs": "../programs.trace", "@frames": "../frames", "@ref": "../x.ref"}
            env = {
                **runner.environment(self.build, folder), "XDG_CACHE_HOME": str(cache or self.inputs / "cache"),
                "LD_PRELOAD": " ".join(str(p) for p in (self.shim, leak_sanitizer()) if p),
                "INJECT_SPARED": self.spared, "LSAN_OPTIONS": "exitcode=0:print_suppressions=0",
                "SOURCE_DATE_EPOCH": "1000000000", "INJECT_COUNT": str(count)
            }
            if inject:
                env["INJECT"] = inject
            try:
                done = subprocess.run([self.relume, *(words.get(w, w) for w in case.command)], cwd=work, env=env,
                                      stdin=subprocess.DEVNULL, capture_output=True, timeout=LIMIT_S, check=False)
            except subprocess.TimeoutExpired:
                return None, b"", b"", {}, [], {}
            files = {str(p.relative_to(work)): p for p in work.rglob("*") if p.is_file()}
            made = {name for pattern in case.made for name in fnmatch.filter(files, pattern)}
            known = {"x.trace", "x.trace.index", "report/sheet.png", *made}
            counts = counts_of(count) if count.exists() else {}
            count.unlink(missing_ok=True)
            return done.returncode, done.stdout, done.stderr, {n: digest(files[n])
                                                               for n in made}, sorted(set(files) - known), counts

    def wrong(self, case, good, points):
        """Faults at "CLASS:N" and at "CLASS:N+" (None: no fault). If the first run made no call after its Nth, it
        covered both."""
        found, calls = [], None
        for point in points:
            name, _, n = point.partition(":")
            if found and n == f"{calls}+":
                found.append(found[-1])
            else:
                done = self.run(case, point)
                found.append(self.judge(case, good, point, *done[:5]))
                calls = done[5].get(name)
        return found

    @staticmethod
    def judge(case, good, inject, code, out, err, made, others):
        said = [
            line for line in err.decode(errors="replace").splitlines()
            if line.startswith("relume:") and " warning: " not in line
        ]
        if code is None:
            return "hangs"
        if b"LeakSanitizer:DEADLYSIGNAL" in err:
            return f"crashes: {err.decode(errors='replace')[:900]}"
        if code not in (good[0], 3, 5):
            return f"exit code {code}: {err.decode(errors='replace')[-300:]}"
        if b"detected memory leaks" in err:
            return f"exit code {code}, and leaks: {err.decode(errors='replace')[:900]}"
        if others:
            return f"leaves {others}"
        if case.name == "diff" and code == 3:  # for diff, an unreadable frame is a result, and there are two of them
            return None if 1 <= len(said) <= 2 - (inject[-1]
                                                  != "+") else f"exit code 3 with {len(said)} lines: {err[-400:]}"
        if any(made[n] != good[3][n] for n in made):
            return f"exit code {code}: another {[n for n in made if made[n] != good[3][n]]}"
        if case.name == "index" and b"cache/relume" in out:  # the fallback location
            return None
        if code == good[0] and said and (inject[-1] == "+"
                                         or not case.name.startswith("render")):  # another worker retries
            return f"exit code {code} after {said}"
        if code == good[0]:
            return None if set(made) == set(good[3]) and (plain(out) == plain(
                good[1]) or case.name == "diff") else f"exit code {code}, but not the same: {err[-300:]}"
        most = 2 if case.name.startswith("render") else 1  # each worker reports its own failure
        return None if 1 <= len(
            said) <= most else f"exit code {code} with {len(said)} lines: {err.decode(errors='replace')[-400:]}"


def counts_of(path):
    counts = {}
    for line in path.read_text().splitlines():
        name, n = line.split()
        counts[name] = max(counts.get(name, 0), int(n))
    return counts


def points_of(counts, most):
    """Every n of each class, alone and from there on; if there are more than `most`, evenly spaced ones."""
    for name in CLASSES:
        n = counts.get(name, 0)
        step = max(1, -(-n // most)) if most else 1
        for at in range(1, n + 1, step):
            yield f"{name}:{at}"
            if name in ("malloc", "write"):
                yield f"{name}:{at}+"


def places_of(counts, most):
    """For each place in the code that makes such calls: all of its calls, and the last one if there are several."""
    for name in CLASSES:
        for at, n in enumerate(places_counts(counts, name), 1):
            yield f"{name}@{at}+"
            if n > 1:
                yield f"{name}@{at}:{n}"


def places_counts(counts, name):
    """How often each place made a call of the class."""
    return [
        counts[key] for key in sorted((key for key in counts
                                       if key.startswith(f"{name}@")), key=lambda key: int(key[len(name) + 1:]))
    ]


def try_case(trial, case, most, workers, points_of=points_of):
    """(points tried, [faults]). points_of: selects points from the counts"""
    trial.run(case)  # the files that later runs reuse now exist
    good = trial.run(case)
    if good[0] != 0 or len(good[3]) != len(case.made):
        return 0, [f"{case.name} does not work: {good}"]
    points = list(points_of(good[5], most))
    groups = [list(group) for _, group in itertools.groupby(points, key=lambda point: point.rstrip("+"))]
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        found = sum(pool.map(lambda group: trial.wrong(case, good, group), groups), [])
    wrong = [f"{case.name} {point}: {what}" for point, what in zip(points, found) if what]
    again = trial.run(case)
    if again[0] != good[0] or again[3] != good[3]:
        wrong.append(f"{case.name}: not the same afterwards: {again[0]} {again[2][-300:]}")
    return len(points), wrong


def try_recorder(trial, build, most):
    """Record a program while the recorder's calls fail; the program must not be affected."""
    shim, work = trial.shim, trial.inputs / "record"
    work.mkdir()
    program, count = (build / "tests/trace/pixels").resolve(), work / "count"
    record = [trial.relume, "record", "-o", "r.trace", "--ref", "color", "--", program]

    def run(env, *command):
        done = subprocess.run([ROOT / "tests/xvfb.sh", "env", *env, *command], cwd=work, stdin=subprocess.DEVNULL,
                              capture_output=True, timeout=LIMIT_S, check=False)
        return done.returncode, done.stdout

    alone = run([], program)
    if run([f"LD_PRELOAD={shim}", f"INJECT_COUNT={count}"], *record) != alone:
        return 0, ["recording pixels: not as without a recorder"]
    points, wrong = list(points_of(counts_of(count), most)), []
    for point in points:
        got = run([f"LD_PRELOAD={shim}", f"INJECT={point}"], *record)
        if got != alone and got[0] not in (2, 3, 5):
            wrong.append(f"record {point}: exit code {got[0]} instead of {alone[0]}")
        for path in work.glob("*.part"):
            wrong.append(f"record {point}: leaves {path.name}")
            path.unlink()
    return len(points), wrong


def prepare(build, inputs):
    relume = (build / "relume").resolve()
    made = [[
        ROOT / "tests/xvfb.sh", relume, "record", "-o", inputs / "x.trace", "--ref", "color", "--",
        build.resolve() / "corpus/two_triangles", "--frames", "2", "--size", "64x48"
    ],
            [
                ROOT / "tests/xvfb.sh", relume, "record", "-o", inputs / "programs.trace", "--",
                build.resolve() / "corpus/phong", "--by", "fragment", "--frames", "1", "--size", "64x48"
            ], [relume, "index", inputs / "x.trace"],
            [relume, "render", inputs / "x.trace", "-o", inputs / "frames/x.####.exr", "--mode", "gl", "--aov", "gl"]]
    for command in made:
        done = subprocess.run([str(w) for w in command], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              check=False)
        if done.returncode:
            sys.exit(f"{command}: exit code {done.returncode}\n{done.stderr}")


def main(build, only, most):
    shown = Shown(build, "inject")
    with tempfile.TemporaryDirectory() as folder:
        inputs = pathlib.Path(folder)
        prepare(build, inputs)
        trial = Trial(build, inputs)
        for name in (*(case.name for case in CASES), "record"):
            if only and only != name:
                continue
            if name == "record":
                n, wrong = try_recorder(trial, build, 60)
            else:
                n, wrong = try_case(trial, next(case for case in CASES if case.name == name), most, os.cpu_count())
            print(*wrong, sep="\n", end="\n" if wrong else "")
            shown.row(f"relume {name}" + (", at most 60 of each class" if name == "record" else ""),
                      f"{n} points, {len(wrong)} failures", "0 failures", n > 0 and not wrong)
    return shown.finish()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only")
    parser.add_argument("--most", type=int, default=0, help="points of each class at most (0: all)")
    options = parser.parse_args()
    sys.exit(main(options.build, options.only, options.most))
