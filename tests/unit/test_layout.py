#!/usr/bin/python3
"""The snapshot layout's identity depends on members, not on comments; an unknown kind of pointer is refused."""
import pathlib
import subprocess
import tempfile
import unittest

LAYOUT = pathlib.Path(__file__).resolve().parent.parent.parent / "replay/index/layout.py"
RULES = "pointers outer inner\npointers inner at\nkept apart one two\nleft apart three\n"
SOURCE = """
struct inner { const char *at; unsigned n, m[3]; };
struct outer { float a[4][4]; union { int b; float c; }; struct inner inner; };
struct apart { int one, two; void *three; };
int prototype(struct outer *outer);
"""


class Layout(unittest.TestCase):
    def run_layout(self, source, rules=RULES):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "rules").write_text(rules)
            done = subprocess.run(["/usr/bin/python3", "-B", LAYOUT, "rules", "out"], cwd=folder, input=source,
                                  capture_output=True, text=True, check=False)
            out = pathlib.Path(folder) / "out"
            return done.returncode, out.read_text().split("\n")[2:] if out.exists() else done.stderr

    def test_members(self):
        code, rows = self.run_layout(SOURCE)
        self.assertEqual(code, 0)
        self.assertEqual([row.strip(" \t\\") for row in rows if row], [
            "SINGLE(apart, one)", "SINGLE(apart, two)", "PLACED(outer, a, float)", "PLACED(outer, b, int)",
            "PLACED(outer, c, float)", "PLACED(outer, inner, struct inner)", "PLACED(inner, at, void *)",
            "PLACED(inner, n, unsigned)", "PLACED(inner, m, unsigned)"
        ])

    def test_text_changes_nothing(self):
        other = SOURCE.replace("; ", ";\n\n    ").replace("int prototype",
                                                          "long another").replace("(struct outer *outer)", "(void)")
        self.assertEqual(self.run_layout(SOURCE), self.run_layout(other))

    def test_new_members_are_refused(self):
        for old, new in ("n, m[3];", "n, m[3]; struct inner *next;"), ("void *three;",
                                                                       "void *three; int four;"), ("void *three;", ""):
            code, said = self.run_layout(SOURCE.replace(old, new))
            self.assertEqual(code, 1, said)
            self.assertIn("rules: struct", said)


unittest.main()
