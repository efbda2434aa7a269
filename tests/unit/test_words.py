#!/usr/bin/python3
"""No folder gains habits that make sentences read as translated (tests/words.py), and the count notices them."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests"))
import words  # noqa: E402


def habits(name, text):
    """[(habit, line)] of one file's text."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / name).write_text(text)
        found = words.places(pathlib.Path(folder), [name])
    return sorted((habit, line) for (habit, _), where in found.items() for _, line in where)


class Prose(unittest.TestCase):
    def test_comments_and_messages_are_read_and_code_is_not(self):
        self.assertEqual(habits("a.c", "int told; /* What it does */\nint b; // Of a frame\nf(told, \"x\");\n"),
                         [("begins-of", 2), ("begins-what", 1)])
        self.assertEqual(habits("a.c", 'err_warn(f, "the frame "\n\t"is told here");\nchar c = \'"\';\nint stands;\n'),
                         [("told", 2)])
        self.assertEqual(habits("a.py", "told = 1  # whence\nx = 'it is done anew'\n"), [("anew", 2), ("whence", 1)])
        self.assertEqual(habits("a.md", "# A\n\nOf one.\n\n```\nOf two, told\n```\n\n- What three\n"),
                         [("begins-of", 3), ("begins-what", 9)])

    def test_a_habit_may_span_lines(self):
        self.assertEqual(habits("a.h", "/**\n * Frames such\n * that a file\n * goes by them.\n */\n// so\n// many\n"),
                         [("goes-by", 4), ("so-many", 6), ("such-that", 2)])

    def test_a_literal_that_continues_a_sentence_has_no_beginning(self):
        self.assertEqual(habits("a.c", 'f("%" PRIu64 " of %u frames", "of the one");\nf("what is it? " "told");\n'),
                         [("begins-of", 1), ("begins-what", 2), ("told", 2)])

    def test_other_uses_of_the_same_words_are_no_habit(self):
        self.assertEqual(habits("a.h", "/* A camera that stands still; a stand-in; it stands for one. */\n"), [])
        self.assertEqual(habits("a.h", "/* Integers that stand for [-1,1]; as many as fit; of a file. */\n"), [])
        self.assertEqual(habits("a.c", '/* url: http://whence */\nf("%s");\n'), [("whence", 1)])


class Ratchet(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name, text in {"tests/words.txt": "told base 1\nanew base 1\n", "base/a.c": "/* told */\n\n\n",
                           "build/b.c": "/* told */\n", "tests/fuzz/kept/c.c": "/* told */\n"}.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)

    def git(self, *more):
        name = ["-c", "user.name=a", "-c", "user.email=a@b"]
        subprocess.run(["git", "-C", self.root, *name, *more], check=True, capture_output=True)

    def test_fewer_places_pass_and_can_be_written(self):
        wrong, notes = words.faults(self.root)
        self.assertEqual((wrong, notes[0]), ([], "base: anew 0 times, 1 in tests/words.txt"))
        subprocess.run([sys.executable, "-B", ROOT / "tests/words.py", "--root", self.root, "--update"], check=True)
        self.assertEqual(words.faults(self.root), ([], []))

    def test_a_place_more_fails_and_is_named(self):
        for with_git in (0, 1):
            (self.root / "base/a.c").write_text("/* told */\n\n\n")
            if with_git:
                self.git("init", "-q")
                self.git("add", ".")
                self.git("commit", "-qm", "a")
            (self.root / "base/a.c").write_text("/* told */\n\n/* told too */\n")
            wrong, _ = words.faults(self.root)
            self.assertIn("base: told 2 times, at most 1", wrong[0])
            self.assertEqual(wrong[1:], ["  base/a.c:3"] if with_git else ["  base/a.c:1", "  base/a.c:3"])

    def test_a_new_file_and_a_new_folder_fail(self):
        self.git("init", "-q")
        self.git("add", ".")
        self.git("commit", "-qm", "a")
        (self.root / "film").mkdir()
        (self.root / "film/b.py").write_text("# whence\n")
        self.assertEqual(words.faults(self.root)[0][1:], ["  film/b.py:1"])


class Shown(unittest.TestCase):
    """make show-words."""

    def test_counts_and_bars_of_each_folder_are_written(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-B", ROOT / "tests/show/prose.py", folder], capture_output=True,
                                  text=True, check=False)
            shown = json.loads((pathlib.Path(folder) / "show/words.json").read_text())
        self.assertEqual((done.returncode, shown["name"], shown["command"]), (0, "words", "make show-words"))
        rows = {row["what"].split(":")[0]: row for row in shown["rows"]}
        self.assertTrue({"all", "base", "docs", "tests"} <= set(rows))
        total = sum(words.allowed(ROOT).values())
        self.assertEqual(rows["all"]["bar"], f"<= {total}")
        self.assertEqual(sum(int(row["bar"][3:]) for name, row in rows.items() if name != "all"), total)


class Real(unittest.TestCase):
    def test_no_folder_has_more_than_its_count(self):
        wrong, _ = words.faults(ROOT)
        self.assertFalse(wrong, "\n".join(wrong))


if __name__ == "__main__":
    program = unittest.main(exit=False)
    failed = len(program.result.failures) + len(program.result.errors)
    print(f"{0 if failed else 100}%: Checks: {program.result.testsRun}, Failures: {failed}, Errors: 0")
    sys.exit(1 if failed else 0)
