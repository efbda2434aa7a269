#!/usr/bin/python3
"""Which lines a test runs, as gcov counts them: of a small program in place of Relume (tests/show/reach.py)."""
import os
import pathlib
import subprocess
import sys
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCRATCH = pathlib.Path(os.environ.get("TMPDIR", "/tmp"))
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/show"))
import reach  # noqa: E402

SOURCE = """#include <stdio.h>
static const int limits[] = { 1,
                              2 };
static int add(int a,
               int b,
               int c)
{
	return a +
	       b +
	       limits[c];
}
int main(int n, char **args)
{
	(void)args;
	if (n > 1)
		puts("many");
	return add(n, 0, 0) == 0;
}
"""


class Clone:
    root = SCRATCH
    build = SCRATCH / "build"
    runs = 0

    def test(self, test):
        self.runs += 1
        return subprocess.run([self.build / "program", *test.arguments], stdout=subprocess.DEVNULL, check=False).returncode == 0, 0.5


class Reached(unittest.TestCase):
    def test_lines(self):
        clone = Clone()
        clone.build.mkdir()
        for name in ("small.c", "unused.c"):
            (SCRATCH / name).write_text(SOURCE)
        subprocess.run(["cc", "-O1", "--coverage", "-o", "build/program", "small.c"], cwd=SCRATCH, check=True)
        for tries in (1, 2):  # the second is read from what is kept
            reached = reach.Reach(SCRATCH / "kept", clone, ["small.c", "unused.c"])
            few, many, broken = (types.SimpleNamespace(name=f"unit/{name}", arguments=arguments) for name, arguments in (("few", ()), ("many", ("x",)), ("broken", ())))
            for line, by_few in ((2, True), (3, True), (5, True), (9, True), (10, True), (14, True), (15, True), (16, False), (17, True)):
                self.assertEqual(reached.reaches(few, "small.c", line), by_few, f"line {line}")
                self.assertTrue(reached.reaches(many, "small.c", line), f"line {line}")
                self.assertFalse(reached.reaches(few, "unused.c", line))
            self.assertEqual(clone.runs, 2)
        (clone.build / "program").write_text("#!/bin/sh\nexit 1\n")
        self.assertTrue(reached.reaches(broken, "unused.c", 1), "of a test that fails nobody knows what it runs")
        (SCRATCH / "unused.c").write_text("int other;\n")
        self.assertNotEqual(reach.Reach(SCRATCH / "kept", clone, ["small.c", "unused.c"]).kept, reached.kept, "other sources have other counts")

    def test_prepared(self):
        (SCRATCH / "base").mkdir()
        for _ in range(2):
            (SCRATCH / "base/options.c").write_text((ROOT / "base/options.c").read_text())
            reach.prepare(SCRATCH)
            reach.prepare(SCRATCH)
            self.assertEqual((SCRATCH / "base/options.c").read_text().count("no_sandbox || 1"), 1)


if __name__ == "__main__":
    program = unittest.main(exit=False)
    failed = len(program.result.failures) + len(program.result.errors)
    print(f"{100 if not failed else 0}%: Checks: {program.result.testsRun}, Failures: {failed}, Errors: 0")
    sys.exit(failed != 0)
