"""Which lines of our sources each test runs: gcov's counts of a build of its own, kept for as long as no source changes.

Counts are written where a process ends by itself. One that a signal ends tells nothing, nor do kernels on an OpenCL device: of kernels/ only
their C twins count. What a verb may not write while it is confined is written there all the same: in this build nothing is confined.
"""
import bisect
import hashlib
import json
import os
import pathlib
import subprocess

FLAGS = ("CFLAGS=-O1 -g --coverage", "CXXFLAGS=-O1 -g --coverage", "LDFLAGS=--coverage")
CONFINES = ("base/options.c", "\tif (no_sandbox)\n", "\tif (no_sandbox || 1)\n")
AT_ONCE = 40  # files of counts for one gcov


def prepare(root):
    """Let verbs of a tree write counts."""
    path, was, now = root / CONFINES[0], *CONFINES[1:]
    text = path.read_text()
    if text.count(was) + text.count(now) != 1:
        raise SystemExit(f"{CONFINES[0]} confines in another way: see tests/show/reach.py")
    if was in text:
        path.write_text(text.replace(was, now))


class Lines:
    """Of one source: functions as (first, last), lines with counts, and those that ran."""

    def __init__(self, functions=(), counted=(), ran=()):
        self.functions, self.counted, self.ran = set(map(tuple, functions)), set(counted), set(ran)

    def kept(self):
        return [sorted(self.functions), sorted(self.counted), sorted(self.ran)]

    def ran_at(self, line):
        """A line of a statement that goes on counts as its first one; what is in no function, a table or a macro, as any line of the file."""
        inside = [f for f in self.functions if f[0] <= line <= f[1]]
        if not inside:
            return bool(self.ran)
        first, counted = max(inside)[0], sorted(self.counted)
        at = bisect.bisect_right(counted, line) - 1
        return bool(self.ran & {line}) or (counted[at] in self.ran if at >= 0 and counted[at] >= first else first in self.ran)


class Reach:
    def __init__(self, folder, clone, sources):
        """clone: a tree that was prepared and built with FLAGS. sources: paths below its root that are of interest."""
        self.clone, self.sources, self.known = clone, set(sources), {}
        digest = hashlib.sha256()
        for name in sorted(self.sources):
            digest.update(name.encode() + b"\0" + (clone.root / name).read_bytes())
        self.kept = folder / f"reach-{digest.hexdigest()[:12]}"
        self.kept.mkdir(parents=True, exist_ok=True)

    def counts(self):
        """{source: Lines} of all counts in the build."""
        found, files = {}, sorted(str(p.relative_to(self.clone.root)) for p in self.clone.build.rglob("*.gcda"))
        for at in range(0, len(files), AT_ONCE):
            done = subprocess.run(["gcov", "--json-format", "--stdout", *files[at:at + AT_ONCE]], cwd=self.clone.root, capture_output=True, text=True, check=False)
            for part in filter(None, done.stdout.splitlines()):
                for file in json.loads(part)["files"]:
                    name = os.path.relpath(self.clone.root / file["file"], self.clone.root)
                    if name in self.sources:
                        lines = found.setdefault(name, Lines())
                        lines.functions |= {(f["start_line"], f["end_line"]) for f in file["functions"]}
                        lines.counted |= {line["line_number"] for line in file["lines"]}
                        lines.ran |= {line["line_number"] for line in file["lines"] if line["count"]}
        return found

    def of(self, test):
        """What a test runs, {source: Lines}; None where it fails in this build, so that nobody knows. The first time the test is run."""
        path = self.kept / (test.name.replace("/", "-") + ".json")
        if test.name not in self.known:
            if not path.exists():
                for old in self.clone.build.rglob("*.gcda"):
                    old.unlink()
                passed, seconds = self.clone.test(test)
                lines = {name: found.kept() for name, found in self.counts().items() if found.ran} if passed else None
                path.write_text(json.dumps({"seconds": seconds, "lines": lines}))
            lines = json.loads(path.read_text())["lines"]
            self.known[test.name] = lines and {name: Lines(*kept) for name, kept in lines.items()}
        return self.known[test.name]

    def reaches(self, test, source, line):
        """Whether a test runs a line, as far as is known."""
        lines = self.of(test)
        return lines is None or source in lines and lines[source].ran_at(line)
