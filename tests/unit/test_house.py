#!/usr/bin/python3
"""The sources match the graph in docs/architecture.md (tests/house.py), and the check notices violations."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("RELUME_BUILD", ROOT / "build"))
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests"))
import house  # noqa: E402

LEAF = "int err_leaf(void);\nint err_leaf(void) { return 1; }\n"
SHOWN = "    replay/gl              -> base replay/machine\n    replay/machine         -> base\n"


class Drawn(unittest.TestCase):
    """A source tree of three files, built for the test."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)

    def build(self, **more):
        files = {
            "base/err.c": LEAF, "base/err.h": "int err_leaf(void);\n",
            "replay/machine/args.c": '#include "base/err.h"\nint arg(void) { return err_leaf(); }\n',
            "replay/machine/args.h": "int arg(void);\n",
            "replay/gl/light.c": '#include "base/err.h"\n#include "replay/machine/args.h"\nint light(void) { return '
                                 'arg() + err_leaf(); }\n'
        }
        files.update({name.replace("__", "/") + ".c": text for name, text in more.items()})
        for name, text in files.items():
            for folder in (self.root, self.root / "build"):
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)
        for source in (self.root / name for name in files if name.endswith(".c")):
            out = self.root / "build" / source.relative_to(self.root).with_suffix(".o")
            subprocess.run(["gcc", "-w", "-I", self.root, "-c", "-o", out, source], check=True)
        return house.House(self.root, self.root / "build")

    def test_a_sound_house_has_no_faults(self):
        self.assertEqual(self.build().faults(SHOWN), [])
        self.assertEqual(sorted(self.build().text().split("\n")), sorted(SHOWN.rstrip("\n").split("\n")))

    def test_files_that_call_each_other_are_a_circle(self):
        made = self.build(replay__gl__fog='int light(void); int fog(void) { return light(); }\n',
                          replay__gl__light='int fog(void); int light(void) { return fog(); }\n')
        self.assertEqual(made.file_circles, [["replay/gl/fog", "replay/gl/light"]])
        self.assertTrue(any(line.startswith("circle between files") for line in made.faults(SHOWN)))

    def test_a_leaf_that_calls_a_chapter_is_found(self):
        lines = self.build(replay__machine__args="int light(void); int arg(void) { return light(); }\n").faults(SHOWN)
        self.assertIn("circle between folders: replay/gl replay/machine", lines)
        self.assertTrue(any("replay/machine -> replay/gl is not in docs/architecture.md" in line for line in lines))

    def test_an_include_is_an_arrow(self):
        lines = self.build(base__err='#include "replay/machine/args.h"\n' + LEAF).faults(SHOWN)
        self.assertTrue(any("base -> replay/machine is not in" in line and "#include" in line for line in lines), lines)

    def test_an_arrow_that_nobody_uses_is_found(self):
        lines = self.build().faults(SHOWN + "    base                   -> diff\n")
        self.assertEqual(lines, ["base -> diff is in docs/architecture.md, and nobody uses it"])

    def test_long_functions_and_repetitions_are_counted(self):
        long = "static int f(void)\n{\n" + "\tg();\n" * 90 + "}\n"
        self.assertEqual(house.functions(long), [("f", 93)])
        same = "\n".join(f"\tstep_{i}();" for i in range(9))
        for name in ("a.c", "b.c"):
            (self.root / name).write_text(f"void {name[0]}(void)\n{{\n{same}\n}}\n")
        self.assertEqual(house.repeated(self.root, ["a.c", "b.c"]), [(("a.c", 1), ("b.c", 1))])


class Real(unittest.TestCase):
    def test_the_house_is_as_the_document_draws_it(self):
        faults = house.House(ROOT, BUILD).faults((ROOT / house.DRAWING).read_text(encoding="utf-8"))
        self.assertFalse(faults, "\n".join(faults))

    def test_lines_have_at_most_120_columns(self):
        listed = subprocess.run(["git", "-c", "safe.directory=*", "ls-files", "*.c", "*.h", "*.cl", "*.cpp"], cwd=ROOT,
                                capture_output=True, text=True, check=False).stdout.split()
        if not listed:
            self.skipTest("no git checkout")
        lines = {name: (ROOT / name).read_text(encoding="utf-8").split("\n") for name in listed}
        wide = [f"{name}:{number}" for name in listed for number, line in enumerate(lines[name], 1) if len(line) > 120]
        self.assertFalse(wide, "\n".join(wide))


if __name__ == "__main__":
    program = unittest.main(exit=False)
    failed = len(program.result.failures) + len(program.result.errors)
    print(f"{0 if failed else 100}%: Checks: {program.result.testsRun}, Failures: {failed}, Errors: 0")
    sys.exit(1 if failed else 0)
