#!/usr/bin/python3
"""Every command in Khronos' registries has a wrapper or a stated reason for lacking one; the generator's output depends
only on its input."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CAPTURE = ROOT / "capture/gen"
sys.dont_write_bytecode = True
sys.path.insert(0, str(CAPTURE))
import registry  # noqa: E402

OLD = re.compile(r"GL_VERSION_(1_\d|2_[01])|GLX_VERSION_1_\d")


def generate(overlay, directory):
    return subprocess.run(["/usr/bin/python3", "-B", CAPTURE / "gen.py", overlay, directory], capture_output=True,
                          text=True, check=False)


class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        run = generate(CAPTURE / "overlay.txt", cls.folder.name)
        assert run.returncode == 0, run.stderr
        lines = pathlib.Path(cls.folder.name, "commands.txt").read_text().splitlines()
        cls.commands = dict(line.split(" ", 1) for line in lines)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_each_command_is_recorded_or_has_a_reason(self):
        for name in ("gl.xml", "glx.xml"):
            for command in registry.read(name)[0]:
                self.assertRegex(self.commands.get(command, "missing"), r"^recorded$|^passed: .{10,}", command)

    def test_all_of_old_gl_is_recorded(self):
        for name in ("gl.xml", "glx.xml"):
            for command in registry.read(name)[0].values():
                if any(OLD.fullmatch(v) for v in command.versions):
                    self.assertEqual(self.commands[command.name], "recorded", command.name)

    def test_window_systems_are_recorded(self):
        for name, how in self.commands.items():
            if re.match(r"glX|OSMesa|egl", name) and name != "eglQueryDeviceBinaryEXT":
                self.assertEqual(how, "recorded", name)

    def test_the_library_shows_every_command(self):
        library = pathlib.Path(os.environ.get("RELUME_BUILD", ROOT / "build"), "librelume.so")
        symbols = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True,
                                 check=True).stdout
        shown = {line.split()[-1] for line in symbols.splitlines()}
        self.assertEqual(sorted(set(self.commands) - shown), [])
        extra = {s for s in shown - set(self.commands) if s not in ("dlsym", "relume_material", "relume_build_kd_tree")}
        self.assertEqual(sorted(extra), [])

    def test_same_input_same_bytes(self):
        with tempfile.TemporaryDirectory() as again:
            self.assertEqual(generate(CAPTURE / "overlay.txt", again).returncode, 0)
            files = sorted(f.relative_to(again) for f in pathlib.Path(again).rglob("*") if f.is_file())
            self.assertGreater(len(files), 6)
            for file in files:
                self.assertEqual((again / file).read_bytes(), (self.folder.name / file).read_bytes(), file)

    def test_errors_name_the_line(self):
        text = (CAPTURE / "overlay.txt").read_text()
        count = text.count("\n")
        for line, complaint in (("frobnicate glBegin", "there is no statement"),
                                ("arg glBegin nothing opaque", "no command has"), ("when glBeginn 1", "no command has"),
                                ("arg glBegin( mode opaque", "not a regular expression"), ("len COMPSIZE(x)", "len needs"),
                                ("type GLfoo", "type needs"), ("pass glBegin", "pass needs"),
                                ("header EGL/egl.h eglNonsense", "no such command"), ("header EGL/none.h egl\\w+",
                                                                                      "No such file")):
            with tempfile.TemporaryDirectory() as folder:
                overlay = pathlib.Path(folder, "overlay.txt")
                overlay.write_text(text + line + "\n")
                run = generate(overlay, folder)
                self.assertNotEqual(run.returncode, 0, line)
                self.assertIn(f"overlay.txt:{count + 1}: ", run.stderr, line)
                self.assertIn(complaint, run.stderr, line)


if __name__ == "__main__":
    unittest.main()
