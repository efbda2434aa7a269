#!/usr/bin/python3
"""Mutants behind switches (tests/show/schemata.py), in a small program instead of Relume: each one alone, and the runs
that could notice it."""
import os
import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCRATCH = pathlib.Path(os.environ.get("TMPDIR", "/tmp"))
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/show"))
import schemata  # noqa: E402
import sites  # noqa: E402

SOURCE = """#include <stdio.h>
#include <stdlib.h>
#define TWICE(x) (2 * (x))
struct bits { unsigned few : 3; };
static const int limits[] = { 5, 6 };
static int next(int *n) { return ++*n; }
static int has_text(const char *text) { return text ? 1 : 0; }
int main(int n, char **args)
{
	struct bits bits = { 3 };
	int calls = 0, sum = n + 7;

	switch (n) {
	case 9:
		return 9;
	}
	sum += TWICE(n - 1);
	if (next(&calls) + n > 3 && n > 2)
		sum *= 3;
	for (int i = 0; i < n; i++)
		sum += limits[0] + has_text(args[0]) * (int)bits.few;
	printf("%d %d\\n", sum, calls);
	return 0;
}
"""


def run(env, *arguments):
    done = subprocess.run(["./small", *arguments], cwd=SCRATCH, env={**os.environ, **env}, capture_output=True,
                          text=True, check=False)
    return done.stdout.strip() or f"code {done.returncode}"


class Schemata(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        (SCRATCH / "small.c").write_text(SOURCE)
        cls.sites = list(sites.find(SCRATCH, "small.c", 1))
        text, cls.by_number = schemata.plant(schemata.Parser(SCRATCH, SCRATCH), "small.c", cls.sites, 1)
        (SCRATCH / "small.c").write_text(text)
        subprocess.run(["gcc", "-O1", "-w", f"-I{ROOT}", "-o", "small", "small.c"], cwd=SCRATCH, check=True)
        (SCRATCH / "single").mkdir()
        for number, site in cls.by_number.items():  # as if edited by hand
            (SCRATCH / "single.c").write_text(SOURCE[:site.begin] + site.instead + SOURCE[site.end:])
            subprocess.run(["gcc", "-O1", "-w", "-o", f"single/{number}", "single.c"], cwd=SCRATCH, check=True)

    def test_each_mutant_is_itself(self):
        self.assertEqual(run({}), "16 1")
        for number, site in self.by_number.items():
            for arguments in ((), ("x",), ("x", "y")):
                wanted = subprocess.run([f"single/{number}", *arguments], cwd=SCRATCH, capture_output=True, text=True,
                                        check=False)
                self.assertEqual(run({"RELUME_MUTANT": str(number)}, *arguments),
                                 wanted.stdout.strip() or f"code {wanted.returncode}", site.described())

    def test_who_could_tell(self):
        seen = {}
        for arguments in ((), ("x", "y")):
            (SCRATCH / "seen").write_bytes(bytes(1 + max(self.by_number)))
            alone = run({}, *arguments)
            self.assertEqual(run({"RELUME_MUTANTS": str(SCRATCH / "seen")}, *arguments), alone)
            for number, what in enumerate((SCRATCH / "seen").read_bytes()):
                seen.setdefault(number, []).append(what)
                if number in self.by_number and run({"RELUME_MUTANT": str(number)}, *arguments) != alone:
                    self.assertEqual(what & 2, 2, f"{self.by_number[number].described()} changes what is printed")
        of = {
            site.described().split(": ")[1] + f" line {site.line}": seen[number]
            for number, site in self.by_number.items()
        }
        self.assertEqual(of["branch `next(&calls) + n > 3 && n > 2` -> `(next(&calls) + n > 3 && n > 2) && 0` line 18"],
                         [0, 3], "not taken the first time")
        self.assertEqual(of["comparison `>` -> `>=` line 18"], [0, 1],
                         "n > 2 is reached with three alone, and there is as true")
        self.assertEqual(of["constant `9` -> `10` line 15"], [0, 0], "never reached")

    def test_places(self):
        lines = {site.line for site in self.by_number.values()}
        self.assertFalse(lines & {5, 14}, "tables and cases have no switch")
        self.assertTrue({11, 17, 18, 19, 20, 21} <= lines)


if __name__ == "__main__":
    program = unittest.main(exit=False)
    failed = len(program.result.failures) + len(program.result.errors)
    print(f"{100 if not failed else 0}%: Checks: {program.result.testsRun}, Failures: {failed}, Errors: 0")
    sys.exit(failed != 0)
