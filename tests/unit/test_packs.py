#!/usr/bin/python3
"""packs.py: a member that packs.txt does not name, or that does not exist, fails; conditions become predicates."""
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCENE = ROOT / "scene/scene.h"
LIST = ROOT / "kernels/packs.txt"


class Packs(unittest.TestCase):
    def run_packs(self, scene, rules):
        with tempfile.TemporaryDirectory() as folder:
            work = pathlib.Path(folder)
            (work / "scene.h").write_text(scene)
            (work / "packs.txt").write_text(rules)
            done = subprocess.run(["/usr/bin/python3", "-B", ROOT / "kernels/packs.py", "packs.txt", "scene.h", "out"],
                                  cwd=folder, capture_output=True, text=True, check=False)
            out = work / "out"
            return done.returncode, done.stderr, out.read_text() if out.exists() else None

    def test_today(self):
        code, said, text = self.run_packs(SCENE.read_text(), LIST.read_text())
        self.assertEqual((code, said), (0, ""))
        self.assertIn("pack_refuses_shade(GLOBAL const struct scene_material *s)", text)
        self.assertIn("(s->clip_plane_mask)", text)
        self.assertIn("pack_refuses_layers(GLOBAL const struct scene_material *s, int stencil_bits, int mirrors)", text)

    def test_new_member(self):
        for struct, member in (("scene_material", "glow"), ("scene_surface", "coat"), ("scene_unit", "sharpness"),
                               ("scene_light", "cookie")):
            scene = SCENE.read_text().replace(f"struct {struct} {{", f"struct {struct} {{\n\tfloat {member}[2];")
            code, said, text = self.run_packs(scene, LIST.read_text())
            self.assertEqual((code, text), (1, None))
            self.assertIn(f"{member}: do packs support it?", said)

    def test_no_such_member(self):
        code, said, text = self.run_packs(SCENE.read_text(), LIST.read_text() + "glow\n")
        self.assertEqual((code, text), (1, None))
        self.assertIn("scene_light has no glow", said)

    def test_no_condition(self):
        code, said, _ = self.run_packs(SCENE.read_text(), LIST.read_text() + "radius often\n")
        self.assertEqual(code, 1)
        self.assertIn("not KIND: CONDITION: often", said)


unittest.main()
