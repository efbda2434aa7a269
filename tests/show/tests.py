#!/usr/bin/python3
"""tests/show/tests.py BUILD [--only WHAT] [--count N] [--seconds S] [--most S] [--again] (as `make show-tests`): which faults `make check` notices.

Mutants of our own sources, drawn by their names' digests (sites.py) in turn from each folder and of each kind: nobody picks places. One
that compiles to the same objects is no fault. All others are built, one after the other, in a clone of this tree, and those tests of
`make check` that run its line (reach.py) until one fails; likely ones first: those named like the file, those of its folder, those that noticed
others of the folder, quick ones. Kernels run on devices, where nobody counts lines: all tests are theirs. A test counts only where it passes in a
second clone that nobody changed.

Verdicts are kept in BUILD/show/tests/verdicts.json: a campaign may be stopped at any time, and goes on. What is left passed all tests that
run it (or --most seconds of them); tests/show/left.txt gives reasons.
"""
import argparse
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "tests/show"), str(ROOT / "tests")]
import reach  # noqa: E402
import run as runner  # noqa: E402
import sites  # noqa: E402
from table import Shown  # noqa: E402

SEED, BAR = 1, 0.95
FOLDERS = {"kernels": ("kernels/*.h", "kernels/*/*.h", "kernels/*/*.cl", "kernels/ref/*.c"), "replay": ("replay/**/*.c",), "tracer": ("tracer/**/*.c",),
           "capture": ("capture/**/*.c",), "diff": ("diff/**/*.c",), "look": ("look/**/*.c",), "scene": ("scene/*.c",), "film": ("film/*.c",)}
# Where a folder's own tests are; parts of names, likely ones first.
ROOMS = {"kernels": "golden/ real/test_panels check/test_shade check/test_camera check/ truth/ real/test_glass",
         "replay": "real/test_panels gl/ real/test_textures real/test_shapes trace/ real/test_index fuzz/",
         "tracer": "golden/ unit/test_accel unit/test_blas unit/test_image unit/test_pack real/test_batch unit/test_device truth/ check/",
         "capture": "trace/ real/test_record real/test_mapped unit/test_sizes", "diff": "unit/test_gates unit/test_metrics unit/test_diff unit/test_flip real/test_approve real/test_ci",
         "look": "look/ unit/test_tricks unit/test_backdrop unit/test_known truth/test_look real/test_harm", "scene": "real/test_export gl/ unit/test_layout",
         "film": "real/test_film real/test_display real/test_denoise"}
LEFT_OUT = ("unit/test_house", "harness/")  # they read sources
# How kernels are compiled to see whether they are the same.
KERNEL = ["clang", "-x", "cl", "-cl-std=CL1.2", "-D__OPENCL_VERSION__=120", "-Xclang", "-finclude-default-header", "-w", "-O1", "-march=native", "-I", ".", "-I", "build/gen",
          "-S", "-emit-llvm"]
# What a test is thought to take before it was run, seconds of processor time.
UNKNOWN_S = {".c": 1, ".sh": 10, ".py": 30}


def spent_s():
    """Processor time of all that ran for us."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Clone:
    """A copy of this tree with a build of its own."""

    def __init__(self, folder, build, flags=()):
        self.root, self.build, self.flags = folder, folder / "build", flags
        if not self.build.exists() and not flags:
            shutil.copytree(build, self.build, symlinks=True, ignore=lambda at, names: ["show", "pocl-cache", "cache"])
        self.restore()

    def restore(self):
        """As the tree is now; what is the same stays, and is not built again."""
        tracked = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], capture_output=True, text=True, check=True).stdout.split("\0")[:-1]
        for name in tracked:
            here, there = ROOT / name, self.root / name
            if not here.exists():
                continue
            if not there.exists():
                there.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(here, there)
            elif there.read_bytes() != here.read_bytes():
                shutil.copyfile(here, there)  # and is newer than what was made from it
        known = set(tracked)
        for folder in {pathlib.Path(name).parts[0] for name in tracked if "/" in name}:
            for there in (self.root / folder).rglob("*"):
                if there.is_file() and str(there.relative_to(self.root)) not in known and "__pycache__" not in there.parts:
                    there.unlink()

    def make(self, *targets):
        """Whether make does it."""
        done = subprocess.run(["make", "-j2", "-C", self.root, "BUILD=build", *self.flags, *targets], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              env={**os.environ, "MAKELEVEL": "0"}, check=False)
        return done.returncode == 0

    def test(self, test):
        """(whether it passes, seconds of processor time)"""
        begin = spent_s()
        if test.command.suffix:
            passed = self.make("check", f"ONLY={test.name}")
        else:  # what other tests need is not linked anew for it
            here = runner.Test(self.root / "tests" / f"{test.name}.c", self.build)
            passed = self.make(f"build/tests/{test.name}") and runner.run(here, self.build)[1] == 0
        return passed, spent_s() - begin


class Campaign:
    def __init__(self, folder, build, most):
        folder.mkdir(parents=True, exist_ok=True)
        os.environ["POCL_CACHE_DIR"] = str(folder / "pocl-cache")  # both clones' and all tests'
        self.kept, self.most, self.kernel_code = folder / "verdicts.json", most, {}
        kept = json.loads(self.kept.read_text()) if self.kept.exists() else {}
        self.verdicts, self.times = kept.get("verdicts", {}), kept.get("times", {})
        self.base, self.clone = Clone(folder / "base", build), Clone(folder / "mutant", build)
        self.tests = [t for t in runner.find_tests(self.base.build, []) if not any(part in t.name for part in LEFT_OUT)]
        self.texts = {t.name: next((ROOT / "tests").glob(f"{t.name}.*")).read_text(errors="replace") for t in self.tests}
        counting = Clone(folder / "counting", build, reach.FLAGS)
        reach.prepare(counting.root)
        for clone in (self.base, self.clone, counting):
            if not clone.make("all"):
                sys.exit(f"what nobody changed does not build: {clone.root}")
        self.reach = reach.Reach(folder, counting, sources())

    def save(self):
        part = self.kept.with_suffix(".part")
        part.write_text(json.dumps({"verdicts": self.verdicts, "times": self.times}, indent=1))
        part.replace(self.kept)

    def likely_first(self, site, folder):
        stem = re.sub(r"_(packet|single|wide)$", "", pathlib.Path(site.path).stem)
        words = [word for word in stem.split("_") if len(word) > 3]
        noticed = {}
        for verdict in self.verdicts.values():
            if verdict["verdict"] == "noticed" and verdict["folder"] == folder:
                noticed[verdict["by"]] = noticed.get(verdict["by"], 0) + (5 if verdict["path"] == site.path else 1)

        def worth(test):
            seconds = self.times.get(test.name, UNKNOWN_S[test.command.suffix or ".c"])
            return (1 + 20 * (stem in test.name) + 3 * sum(word in self.texts[test.name] for word in words) +
                    next((40 / (1 + at) for at, part in enumerate(ROOMS[folder].split()) if part in test.name), 0) + 10 * noticed.get(test.name, 0)) / (3 + seconds)
        return sorted(self.tests, key=worth, reverse=True)

    def same_objects(self, since):
        """Whether all that was made anew is as in the clone that nobody changed."""
        def code(path):
            stripped = path.with_suffix(".stripped")
            subprocess.run(["objcopy", "--strip-debug", path, stripped], check=True)
            data = stripped.read_bytes()
            stripped.unlink()
            return data
        made = [p for p in self.clone.build.rglob("*.o") if p.stat().st_mtime >= since and p.name != "kernels.o"]
        return all(code(p) == code(self.base.build / p.relative_to(self.clone.build)) for p in made)

    def kernels(self, site):
        """What the mutant makes of the kernels: None does not compile, True the same code, False other code."""
        def code(clone, file):
            done = subprocess.run([*KERNEL, "-o", "-", file], cwd=clone.root, capture_output=True, text=True, check=False)
            return done.stdout if done.returncode == 0 else None
        files = [site.path] if site.path.endswith(".cl") else sorted(str(p.relative_to(ROOT)) for p in ROOT.glob("kernels/*/*.cl"))
        for file in files:
            if file not in self.kernel_code:
                self.kernel_code[file] = code(self.base, file) or sys.exit(f"clang does not compile {file}")
            mutant = code(self.clone, file)
            if mutant != self.kernel_code[file]:
                return None if mutant is None else False
        return True

    def judge(self, site, folder):
        since, begin = time.time() - 0.01, spent_s()
        path = self.clone.root / site.path
        text = path.read_text()
        path.write_text(text[:site.begin] + site.instead + text[site.end:])
        shutil.rmtree(self.clone.build / "tests/cache", ignore_errors=True)
        verdict = {"folder": folder, "path": site.path, "told": site.told(), "by": None}
        try:
            if not self.clone.make("all"):
                return {**verdict, "verdict": "does not compile"}
            if self.same_objects(since):
                kernels = self.kernels(site) if folder == "kernels" else True
                if kernels is not False:
                    return {**verdict, "verdict": "equivalent" if kernels else "does not compile"}
            n = 0
            for test in self.likely_first(site, folder):
                if spent_s() - begin > self.most:
                    return {**verdict, "verdict": "left", "why": f"{n} tests that run it pass, {self.most} s"}
                before = spent_s()
                runs_it = folder == "kernels" or self.reach.reaches(test, site.path, site.line)
                begin += spent_s() - before  # counting is for all mutants
                if not runs_it:
                    continue
                n += 1
                passed, seconds = self.clone.test(test)
                if passed:
                    self.times[test.name] = 0.7 * self.times.get(test.name, seconds) + 0.3 * seconds
                elif self.base.test(test)[0]:
                    return {**verdict, "verdict": "noticed", "by": test.name, "after": n - 1, "seconds": round(spent_s() - begin)}
            return {**verdict, "verdict": "left", "why": f"all {n} tests that run it pass"}
        finally:
            path.write_text(text)


def sources(folders=FOLDERS):
    """Names of the sources of folders, in order."""
    return sorted({str(p.relative_to(ROOT)) for folder in folders for pattern in FOLDERS[folder] for p in ROOT.glob(pattern)})


def drawn():
    """Sites in turn: folder by folder, kind by kind, the lowest names first."""
    queues = {}
    for folder in FOLDERS:
        for path in sources((folder,)):
            for site in sites.find(ROOT, path, SEED):
                queues.setdefault((site.kind, folder), []).append(site)
    queues = {key: sorted(queue, key=lambda s: s.id, reverse=True) for key, queue in queues.items()}
    while any(queues.values()):
        for kind in sites.KINDS:
            for folder in FOLDERS:
                if queues.get((kind, folder)):
                    yield folder, queues[kind, folder]


def campaign(options):
    """Verdicts by name, of what is wanted, in the order of the draw."""
    todo = Campaign(options.build.resolve() / "show/tests", options.build.resolve(), options.most)
    end, tried, faults = time.monotonic() + options.seconds, {}, 0
    for folder, queue in drawn():
        while queue:  # until one of this folder and kind is a fault
            site = queue.pop()
            if options.only and options.only not in (folder, site.id) and options.only not in site.path:
                continue
            verdict = todo.verdicts.get(site.id)
            if not verdict or options.again and verdict["verdict"] == "left":
                if time.monotonic() > end:
                    return tried
                verdict = todo.verdicts[site.id] = todo.judge(site, folder)
                todo.save()
                print(f"{verdict['verdict']:10}  {site.id}  {verdict['told']}  {verdict['by'] or verdict.get('why', '')}", flush=True)
            tried[site.id] = verdict
            if verdict["verdict"] in ("noticed", "left"):
                faults += 1
                break
        if faults == options.count:
            break
    return tried


def reasons():
    path = ROOT / "tests/show/left.txt"
    return dict(line.split(" ", 1) for line in path.read_text().splitlines() if line and line[0] != "#") if path.exists() else {}


def main(options):
    tried = campaign(options)
    why, shown = reasons(), Shown(options.build, "tests")
    for name, verdict in tried.items():
        if verdict["verdict"] == "left":
            print(f"left: {name} {verdict['told']} ({verdict['why']}): {why.get(name, 'no reason known')}")
    for folder in (*FOLDERS, "all"):
        of = [v for v in tried.values() if folder in ("all", v["folder"])]
        n = {what: sum(v["verdict"] == what for v in of) for what in ("equivalent", "noticed", "left")}
        faults = n["noticed"] + n["left"]
        if faults:
            share = n["noticed"] / faults
            shown.row(f"{folder}: {faults} mutants, {n['equivalent']} more made the same code", f"{n['noticed']} noticed, {n['left']} left: {100 * share:.1f} %",
                      f"{100 * BAR:.0f} %" if folder == "all" else None, share >= BAR if folder == "all" else None)
    return shown.finish()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", help="a folder, a part of a file's path, or a mutant's name")
    parser.add_argument("--count", type=int, default=200, help="mutants that are faults (200)")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="begin no more after this time")
    parser.add_argument("--most", type=float, default=1800, help="seconds of processor time for a mutant (1800)")
    parser.add_argument("--again", action="store_true", help="those that were left, too")
    sys.exit(main(parser.parse_args()))
