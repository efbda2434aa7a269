#!/usr/bin/python3
"""tests/show/tests.py BUILD [--only FOLDER] [--count N] [--seconds S] [--most S] (as `make show-tests`): which faults
does `make check` notice?

Mutants of our own sources are drawn by the digests of their names (sites.py), taking folders and kinds in turn, so that
nobody chooses the places. All are compiled into one build of a clone of this tree, each behind a switch (schemata.py).
One run of the tests determines which mutants each test could notice: those whose code it runs with a different result.
Each mutant then runs with those tests until one fails, fast tests and those that noticed others first; a limit on
processor time ends a hang. The test must fail with the mutant twice and pass without it; intermittent failures and
skipped tests do not count.

Kernels share their text with their C twins, so both would be wrong alike: mutants of that text run where the twins are
the device, and those of kernels/ref where a real device is compared with them. Not tried: code for devices only (*.cl,
packs, the text around hooks, which is compiled only for a hook) and places without an expression (tables, sizes).
LEFT_OUT lists tests that read sources, rebuild the tree, start a farm, a browser or Wine, or take long. Tests that
measure time or need more than SLOW_S of processor time are left out, too.

All results are kept in BUILD/show/tests: a campaign can be stopped at any time and resumed. Half of a given time limit
goes to the first run of the tests, whose results hold until the test or the mutants' places change. A verdict holds
until its source or its test changes; surviving mutants are tried with new tests. tests/show/left.txt gives reasons for
survivors.
"""
import argparse
import hashlib
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "tests/show"), str(ROOT / "tests")]
import run as runner  # noqa: E402
import schemata  # noqa: E402
import sites  # noqa: E402
from table import Shown  # noqa: E402

SEED, BAR, SLOW_S = 1, 0.95, 20
PASSED, FAILED, SKIPPED = range(3)
FOLDERS = {
    "kernels": ("kernels/*.h", "kernels/camera/*.h", "kernels/gl/*.h", "kernels/frame/[!p]*/*.h",
                "kernels/frame/plain/*.h", "kernels/ref/*.c"), "replay": ("replay/**/*.c", "verbs/recording/*.c"),
    "tracer": ("tracer/**/*.c", ), "capture": ("capture/**/*.c", ), "diff": ("diff/**/*.c", )
}
LEFT_OUT = ("unit/test_house", "harness/", "farm/", "real/test_page", "real/test_wine", "real/test_i386",
            "real/test_install", "real/test_crash", "real/test_hooks", "unit/test_schemata")
QUICK = ("unit/", "gl/", "trace/", "fuzz/")
FLAGS = ["CFLAGS=-O1 -g0 -w -fno-delete-null-pointer-checks",
         "CXXFLAGS=-O1 -g0 -w"]  # the compiler must not use promises about arguments to remove a mutant
HOOK_TEXT = "kernels/frame/hook"
# Mutants of shared text run in a build whose device is the twins, unless a test names a device.
TWINS = ("tracer/device/device.c", "\treturn choice && strcmp",
         '\treturn !choice ? getenv("RELUME_TWINS") != NULL : strcmp')
TWINS_TESTS = ("golden/", "truth/", "look/", "real/test_panels", "real/test_textures", "real/test_shapes",
               "real/test_glass", "real/test_vertices", "real/test_samples", "unit/test_device")


def digest(*parts):
    return hashlib.sha256("\0".join(map(str, parts)).encode()).hexdigest()[:16]


def spent_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def sources(folder):
    return sorted({str(p.relative_to(ROOT)) for pattern in FOLDERS[folder] for p in ROOT.glob(pattern)})


def texts_of(test):
    """A test's own sources: those with its name, and those of the program or folder that it records (test_panels:
    panels/)."""
    own = test.name.replace("/test_", "/")
    return [
        p for pattern in (f"{test.name}.*", f"{own}.[ch]", f"{own}/*.[ch]")
        for p in sorted((ROOT / "tests").glob(pattern))
    ]


def drawn():
    """Sites in a fixed order: by kind and folder in turn, lowest digests first."""
    queues = {(kind, folder): [] for kind in sites.KINDS for folder in FOLDERS}
    for folder in FOLDERS:
        for path in sources(folder):
            for site in sites.find(ROOT, path, SEED):
                site.folder = folder
                queues[site.kind, folder].append(site)
    queues = [sorted(queue, key=lambda s: s.id, reverse=True) for queue in queues.values()]
    while any(queues):
        for queue in filter(None, queues):
            yield queue.pop()


class Mutants:
    """The clone, with all mutants in one build."""

    def __init__(self, folder, build, count):
        self.root, self.build = folder / "clone", folder / "clone/build"
        # Some cannot be switched, so a third more are drawn.
        draw = drawn()
        sites_drawn = [next(draw) for _ in range(count * 4 // 3)]
        paths = sorted({site.path for site in sites_drawn})
        of = digest(*(site.id for site in sites_drawn),
                    *((ROOT / path).read_text() for path in (*paths, "tests/show/schemata.py")))
        planted = folder / "planted.json"
        kept = json.loads(planted.read_text()) if planted.exists() else {}
        if kept.get("of") != of:
            parser, kept = schemata.Parser(ROOT, build), {"of": of, "texts": {}, "names": {}}
            for path in paths:
                here = [site for site in sites_drawn if site.path == path]
                kept["texts"][path], found = schemata.plant(parser, path, here, 1 + max(kept["names"], default=0))
                kept["names"].update({number: site.id for number, site in found.items()})
            planted.write_text(json.dumps(kept))
        texts, by_name = kept["texts"], {site.id: site for site in sites_drawn}
        self.by_number = {int(number): by_name[name] for number, name in kept["names"].items()}
        texts[TWINS[0]] = texts.get(TWINS[0], (ROOT / TWINS[0]).read_text()).replace(*TWINS[1:])
        if TWINS[2] not in texts[TWINS[0]]:
            sys.exit(f"{TWINS[0]} chooses devices in another way: see tests/show/tests.py")
        self.write(build, texts)
        if subprocess.run(["make", "-C", self.root, "BUILD=build", *FLAGS, "test-programs"], stdin=subprocess.DEVNULL,
                          stdout=subprocess.DEVNULL, env={**os.environ, "MAKELEVEL": "0"}, check=False).returncode:
            sys.exit(f"the mutants do not build: {self.root}")
        self.digest = digest(*(f"{number} {site.id}" for number, site in sorted(self.by_number.items())))

    def write(self, build, texts):
        """Write the present tree with these texts; unchanged files are kept, and so not rebuilt."""
        if not self.build.exists():
            shutil.copytree(build / "gen", self.build / "gen", copy_function=shutil.copy2)
        tracked = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "-co", "--exclude-standard"],
                                 capture_output=True, text=True, check=True).stdout.split("\0")[:-1]
        changed = False
        for path in self.root.rglob("*") if self.root.exists() else ():
            if path.is_file() and self.build not in path.parents and not (ROOT / path.relative_to(self.root)).is_file():
                path.unlink()  # the Makefile would build it
        for name in tracked:
            here, there = ROOT / name, self.root / name
            if here.is_file():
                there.parent.mkdir(parents=True, exist_ok=True)
                now = texts[name].encode() if name in texts else here.read_bytes()
                if not there.exists() or there.read_bytes() != now:
                    there.write_bytes(now)
                    shutil.copymode(here, there)
                    changed = True
        if changed:
            shutil.copyfile(build / "gen/kernels.c", self.build / "gen/kernels.c")  # devices keep the original

    def test(self, test, limit_s, **env):
        """(PASSED, FAILED or SKIPPED, processor seconds). Processes that need more than limit_s are ended."""
        shutil.rmtree(self.build / "tests/cache", ignore_errors=True)  # left by another mutant
        begin, was = spent_s(), {name: os.environ.get(name) for name in env}
        soft, hard = resource.getrlimit(resource.RLIMIT_CPU)
        os.environ.update(env)
        resource.setrlimit(resource.RLIMIT_CPU, (int(limit_s), hard))
        try:
            good, bad, _, _ = runner.run(test, self.build)
        finally:
            resource.setrlimit(resource.RLIMIT_CPU, (soft, hard))
            for name, value in was.items():
                os.environ.pop(name) if value is None else os.environ.update({name: value})
        return FAILED if bad else PASSED if good else SKIPPED, spent_s() - begin


class Campaign:
    def __init__(self, folder, build, count, most):
        folder.mkdir(parents=True, exist_ok=True)
        os.environ["POCL_CACHE_DIR"] = str(build / "tests/pocl-cache")
        self.mutants, self.most, self.file = Mutants(folder, build, count), most, folder / "verdicts.json"
        self.tests = [
            t for t in runner.find_tests(self.mutants.build, [])
            if not t.serial and not any(part in t.name for part in LEFT_OUT)
        ]
        self.texts = {t.name: digest(*(p.read_text(errors="replace") for p in texts_of(t))) for t in self.tests}
        kept = json.loads(self.file.read_text()) if self.file.exists() else {}
        self.verdicts, self.map = kept.get("verdicts",
                                           {}), kept.get("map", {}) if kept.get("of") == self.mutants.digest else {}
        self.flaky, self.sure = set(), {}

    def save(self):
        part = self.file.with_suffix(".part")
        part.write_text(json.dumps({"of": self.mutants.digest, "verdicts": self.verdicts, "map": self.map}, indent=1))
        part.replace(self.file)

    def way(self, site):
        return "twins" if site.folder == "kernels" and not site.path.startswith("kernels/ref/") else "device"

    def env(self, way):
        return {"RELUME_TWINS": "1"} if way == "twins" else {}

    def see(self, end):
        """Run each test once, within a time limit, and note the mutants that it could notice."""
        path = self.file.with_name("seen")
        for way in ("device", "twins"):
            for test in sorted(self.tests, key=lambda t: (not t.name.startswith(QUICK), t.command.suffix)):
                key, of = f"{way} {test.name}", self.texts[test.name]
                if self.map.get(key, {}).get("of") == of or way == "twins" and not any(part in test.name
                                                                                       for part in TWINS_TESTS):
                    continue
                if time.monotonic() > end:
                    print(f"{key} and later tests have not been run yet")
                    break
                path.write_bytes(bytes(1 + max(self.mutants.by_number)))
                outcome, seconds = self.mutants.test(test, SLOW_S, RELUME_MUTANTS=str(path), **self.env(way))
                seen = path.read_bytes()
                self.map[key] = {
                    "of": of, "passed": outcome == PASSED, "seconds": round(seconds, 2),
                    "reached": [n for n, what in enumerate(seen) if what],
                    "told": [n for n, what in enumerate(seen) if what & 2]
                }
                self.save()

    def tell(self):
        left_out = sorted(key for key, seen in self.map.items() if not seen["passed"])
        print(
            f"{len(self.map) - len(left_out)} runs of tests, {sum(seen['seconds'] for seen in self.map.values()):.0f} "
            f"s of processor time; skipped, over {SLOW_S} s, or failing "
            f"without a mutant: {', '.join(left_out) or 'none'}", flush=True)

    def likely_first(self, site, able, way):
        noticed = {}
        for known in self.verdicts.values():
            if known["by"]:
                noticed[known["by"]] = noticed.get(known["by"], 0) + (5 if known["path"] == site.path else 1)
        return sorted(able, key=lambda t: (0.2 + self.map[f"{way} {t.name}"]["seconds"]) / (1 + noticed.get(t.name, 0)))

    def is_sure(self, test, way, limit_s):
        """Whether a test passes without a mutant; checked once per campaign."""
        if (way, test.name) not in self.sure:
            self.sure[way, test.name] = self.mutants.test(test, limit_s, **self.env(way))[0] == PASSED
        return self.sure[way, test.name]

    def judge(self, number, site):
        """The verdict on a mutant. Tests that passed before are not repeated."""
        way, begin, before = self.way(site), spent_s(), self.verdicts.get(site.id)
        of = digest((ROOT / site.path).read_text())
        if before and before["of"] == of and before["by"] and before["text"] == self.texts.get(before["by"]):
            return before
        passed = before["passed"] if before and before["of"] == of else {}
        verdict = {
            "folder": site.folder, "path": site.path, "told": site.described(), "of": of, "by": None, "passed": passed
        }
        seen = {t.name: self.map[f"{way} {t.name}"] for t in self.tests if f"{way} {t.name}" in self.map}
        able = [
            t for t in self.tests
            if t.name in seen and seen[t.name]["passed"] and number in seen[t.name]["told"] and t.name not in self.flaky
        ]
        if not able:
            return {
                **verdict, "why": "no test can distinguish it" if any(
                    number in s["reached"] for s in seen.values()) else "no test runs it"
            }
        for test in self.likely_first(site, able, way):
            if passed.get(test.name) == self.texts[test.name]:
                continue
            if spent_s() - begin > self.most:
                return {
                    **verdict, "why": f"{len(passed)} of {len(able)} tests that could tell it pass, {self.most:.0f} s"
                }
            limit_s = 5 + 5 * seen[test.name]["seconds"]
            mutated = {"RELUME_MUTANT": str(number), "RELUME_FIRST_FAILURE": "1", **self.env(way)}
            if self.mutants.test(test, limit_s, **mutated)[0] != FAILED:
                passed[test.name] = self.texts[test.name]
            elif not self.is_sure(test, way, limit_s):
                self.flaky.add(test.name)
            elif self.mutants.test(test, limit_s, **mutated)[0] == FAILED:
                return {
                    **verdict, "by": test.name, "text": self.texts[test.name], "seconds": round(spent_s() - begin, 1)
                }
            else:
                self.flaky.add(test.name)
        return {**verdict, "why": f"all {len(able)} tests that could tell it pass"}


def main(options):
    signal.signal(signal.SIGXCPU, lambda *_: None)  # limits are for tests
    build = options.build.resolve()
    todo, end = Campaign(build / "show/tests", build, options.count, options.most), time.monotonic() + options.seconds
    todo.see(end - options.seconds / 2)
    todo.tell()
    tried = {}
    for number, site in sorted(todo.mutants.by_number.items(), key=lambda item: item[1].id):
        if options.only in (None, site.folder) and not site.path.startswith(HOOK_TEXT) and (time.monotonic() < end or
                                                                                            site.id in todo.verdicts):
            tried[site.id] = verdict = todo.verdicts[site.id] if time.monotonic() > end else todo.judge(number, site)
            if verdict != todo.verdicts.get(site.id):
                todo.verdicts[site.id] = verdict
                todo.save()
                print(f"{'noticed' if verdict['by'] else 'left':7}", site.id, verdict["told"],
                      verdict["by"] or verdict["why"], sep="  ", flush=True)
    reasons = dict(
        line.split(" ", 1)
        for line in (ROOT / "tests/show/left.txt").read_text().splitlines()
        if line and line[0] != "#")
    shown = Shown(options.build, "tests")
    for name, verdict in tried.items():
        if not verdict["by"]:
            print("left:", name, verdict["told"], f"({verdict['why']}): {reasons.get(name, 'no reason known')}")
    for folder in (*FOLDERS, "all"):
        of = [v for v in tried.values() if folder in ("all", v["folder"])]
        noticed = sum(v["by"] is not None for v in of)
        if of:
            shown.row(f"{folder}: {len(of)} mutants",
                      f"{noticed} noticed, {len(of) - noticed} left: {100 * noticed / len(of):.1f} %",
                      f"{100 * BAR:.0f} %" if folder == "all" else None,
                      noticed >= BAR * len(of) if folder == "all" else None)
    with_effect = len(tried) - sum(not verdict["by"] and name in reasons for name, verdict in tried.items())
    if with_effect:
        shown.row(f"without {len(tried) - with_effect} mutants that change no result (left.txt)",
                  f"{noticed} of {with_effect}: {100 * noticed / with_effect:.1f} %", None, None)
    return shown.finish()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", help="a folder")
    parser.add_argument("--count", type=int, default=200, help="approximate number of mutants")
    parser.add_argument("--seconds", type=float, default=1e9,
                        help="wall time limit; the next run continues")
    parser.add_argument("--most", type=float, default=120, help="seconds of processor time per mutant")
    sys.exit(main(parser.parse_args()))
