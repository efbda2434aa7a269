#!/usr/bin/python3
# limit: 240 s
"""relume diff as a command: sets of frames, exit codes, and output."""
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib

import jsonschema

RELUME = os.environ.get("RELUME", "build/relume")
SCHEMA = json.loads(
    (pathlib.Path(__file__).resolve().parent.parent.parent / "diff/score/score.schema.json").read_text())
WIDTH, HEIGHT = 48, 40


def picture(seed, width=WIDTH, height=HEIGHT):
    """RGB rows, top first: a box on a dark background, whose position depends on the seed."""
    rows = []
    for y in range(height):
        row = bytearray()
        for x in range(width):
            inside = 5 + seed <= x < 25 + seed and 8 <= y < 30
            row += bytes((200, 60 + 4 * (x % 16), 30)) if inside else b"\x0a\x0c\x14"
        rows.append(bytes(row))
    return rows


def drifted(rows):
    """One code too bright everywhere, which FLIP notices, and one pixel beyond R1, which tolerates 0.1 %: P decides."""
    rows = [bytes(b + 1 if b < 255 else b for b in row) for row in rows]
    return [bytes((rows[0][0] + 2,)) + rows[0][1:]] + rows[1:]


def write_png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(b"".join(b"\0" + r for r in rows))) + chunk(b"IEND", b""))


def read_png(path):
    """RGB rows of an 8-bit PNG file without interlacing, with any filters."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, _, *form = struct.unpack(">IIBBBBB", data[at + 8:at + 21])
            assert form == [8, 2, 0, 0, 0], form
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += size + 12
    raw, rows, above = zlib.decompress(packed), [], bytes(3 * width)
    for start in range(0, len(raw), 3 * width + 1):
        row = bytearray(raw[start + 1:start + 1 + 3 * width])
        for i in range(len(row)):
            left, up, corner = (row[i - 3], above[i], above[i - 3]) if i >= 3 else (0, above[i], 0)
            nearest = min((left, up, corner), key=lambda v: abs(left + up - corner - v))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, nearest)[raw[start]]) % 256
        rows.append(bytes(row))
        above = row
    return rows


def places(rows, wanted):
    """Positions of a picture within another: (x, y)."""
    return [(at.start() // 3, y)
            for y in range(len(rows) - len(wanted) + 1)
            for at in re.finditer(re.escape(wanted[0]), rows[y])
            if all(rows[y + k][at.start():at.start() + len(row)] == row for k, row in enumerate(wanted))]


def snappy(data):
    """A raw Snappy block of literals only."""
    out, n = bytearray(), len(data)
    while True:
        out.append(n & 127 | (128 if n > 127 else 0))
        n >>= 7
        if not n:
            break
    for at in range(0, len(data), 60):
        part = data[at:at + 60]
        out += bytes(((len(part) - 1) << 2,)) + part
    return bytes(out)


def ref_record(kind, frame, data):
    packed = snappy(data)
    return struct.pack("<IIIQQ", kind, WIDTH, HEIGHT, frame, len(packed)) + packed


def ref_color(frame, rows):
    upside_down = b"".join(b"".join(row[i:i + 3] + b"\xff" for i in range(0, len(row), 3)) for row in reversed(rows))
    return ref_record(1, frame, upside_down)


class Diff(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.dir = pathlib.Path(folder.name)
        self.ref, self.traced = self.dir / "ref", self.dir / "traced"
        for n in range(1, 5):
            write_png(self.ref / f"a.{n:04}.png", picture(n))
            write_png(self.traced / f"b.{n}.png", picture(n))

    def diff(self, *args, expect):
        done = subprocess.run([RELUME, "diff", *map(str, args)], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, expect, done.stdout + done.stderr)
        # Kernels without Landlock, and emulated ones, cause warnings.
        done.stderr = re.sub(r"^relume: warning: (this kernel has no Landlock|calls cannot be confined).*\n", "",
                             done.stderr, flags=re.M)
        return done

    def json(self, *args, expect):
        run = json.loads(self.diff(*args, "--json", "-", expect=expect).stdout)
        jsonschema.validate(run, SCHEMA, jsonschema.Draft202012Validator)
        return run

    def outcomes(self, *args, expect):
        return {f["frame"]: f["outcome"] for f in self.json(*args, expect=expect)["frames"]}

    def test_schema(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        write_png(self.traced / "b.3.png", picture(9))
        run = self.json(self.ref, self.traced, expect=1)
        for path, value in ((("version", ), 2), (("extra", ), 1), (("frames", 0, "outcome"), "fine"),
                            (("frames", 0, "fidelity"), 1.5), (("frames", 0, "gates", "R1", "figures"), []),
                            (("frames", 0, "gates", "R9"), {}), (("counts", "passed"), -1)):
            changed = json.loads(json.dumps(run))
            at = changed
            for key in path[:-1]:
                at = at[key]
            at[path[-1]] = value
            with self.assertRaises(jsonschema.ValidationError, msg=path):
                jsonschema.validate(changed, SCHEMA, jsonschema.Draft202012Validator)

    def test_equal_sets_pass(self):
        done = self.diff(self.ref, self.traced, "--table", expect=0)
        self.assertRegex(done.stdout.splitlines()[-1], r"^4 frames: 4 passed; lowest fidelity 100\.000 %")
        self.assertIn("not measured: R5", done.stdout)
        done = self.diff(self.ref, self.traced, expect=0)
        self.assertEqual([len(done.stdout.splitlines()), done.stderr], [1, ""])

    def test_patterns_and_single_files(self):
        self.diff(self.ref / "a.####.png", self.traced / "b.%d.png", expect=0)
        self.diff(self.ref / "a.0002.png", self.traced / "b.2.png", expect=0)
        write_png(self.dir / "one.png", picture(2))
        self.diff(self.dir / "one.png", self.traced / "b.2.png", expect=0)

    def test_failed_frame_comes_first(self):
        write_png(self.traced / "b.3.png", picture(9))
        self.assertIn("frame 3: failed, ", self.diff(self.ref, self.traced, expect=1).stdout)
        done = self.diff(self.ref, self.traced, "--table", expect=1)
        rows = [line.split()[:2] for line in done.stdout.splitlines() if re.match(r" +\d+ [a-z]", line)]
        self.assertEqual(rows, [["3", "failed"], ["1", "passed"], ["2", "passed"], ["4", "passed"]])
        self.assertIn("R1  interior colour", done.stdout)

    def test_swapped_frames_fail(self):
        write_png(self.traced / "b.2.png", picture(3))
        write_png(self.traced / "b.3.png", picture(2))
        self.assertEqual(self.outcomes(self.ref, self.traced, expect=1),
                         {1: "passed", 2: "failed", 3: "failed", 4: "passed"})

    def test_missing_and_extra_frames(self):
        (self.traced / "b.2.png").unlink()
        self.assertEqual(self.outcomes(self.ref, self.traced, "--all", expect=1)[2], "missing")
        self.assertEqual(self.outcomes(self.ref, self.traced, "--all", "-f", "2-9", expect=1),
                         {2: "missing", 3: "passed", 4: "passed"})
        self.assertIn(f"not compared: 1 frame of {self.ref} that {self.traced} lacks; --all demands it\n",
                      self.diff(self.ref, self.traced, expect=0).stdout)
        self.assertEqual(list(self.outcomes(self.ref, self.traced / "b.3.png", expect=0)), [3])
        self.diff(self.ref, self.traced, "-f", "3-4", expect=0)
        self.assertEqual(self.outcomes(self.ref, self.traced, "-f", "3-6", expect=1)[6], "missing")
        write_png(self.traced / "b.2.png", picture(2))
        write_png(self.traced / "b.7.png", picture(7))
        self.assertEqual(self.outcomes(self.ref, self.traced, expect=4)[7], "extra")

    def test_windows_of_exr(self):
        """A picture is its display window: moved data fail, cropped data are compared in place, overscan is ignored,
        DWA is read."""
        for name, edit in (("base", []), ("shift", ["--origin", "+5+3"]), ("crop", ["--crop", "20x21+20+10"]),
                           ("dwaa", ["--compression",
                                     "dwaa:1"]), ("dwab", ["--compression",
                                                           "dwab:1"]), ("piz", ["--compression", "piz"])):
            (self.dir / name).mkdir()
            subprocess.run(
                ["oiiotool", self.ref / "a.0003.png", *edit, "-d", "float", "-o", self.dir / name / "f.3.exr"],
                check=True)
        (self.dir / "over").mkdir()
        subprocess.run([
            "oiiotool", self.ref / "a.0003.png", "--create", f"{WIDTH + 8}x{HEIGHT + 6}", "3", "--origin", "-4-3",
            "--paste", "+0+0", "--fullsize", f"{WIDTH}x{HEIGHT}+0+0", "-d", "float", "-o", self.dir / "over" / "f.3.exr"
        ], check=True)
        for name, wanted in (("base", "passed"), ("shift", "failed"), ("crop", "passed"), ("dwaa", "passed"),
                             ("dwab", "passed"), ("piz", "passed"), ("over", "passed")):
            for pair in ((self.dir / "base", self.dir / name), (self.dir / name, self.dir / "base")):
                self.assertEqual(self.outcomes(*pair, "--report", self.dir / "page", expect=int(wanted == "failed")),
                                 {3: wanted}, name)
        damaged = bytearray((self.dir / "crop" / "f.3.exr").read_bytes())
        at = damaged.index(b"displayWindow\0box2i\0") + len(b"displayWindow\0box2i\0") + 4
        damaged[at:at + 16] = struct.pack("<4i", 1000, 1000, 1047, 1039)
        (self.dir / "crop" / "f.3.exr").write_bytes(damaged)
        self.assertIn("shows nothing of its display window",
                      self.diff(self.dir / "base", self.dir / "crop", expect=3).stderr)

    def test_other_size_fails(self):
        write_png(self.traced / "b.1.png", picture(1, WIDTH + 1))
        done = self.diff(self.ref, self.traced, expect=1)
        self.assertIn(f"size {WIDTH + 1} x {HEIGHT}", done.stdout)

    def test_unreadable_frame(self):
        rows = picture(1)
        whole = f"P6 {WIDTH} {HEIGHT} 255\n".encode() + b"".join(rows)
        (self.traced / "b.1.png").unlink()
        (self.traced / "b.1.ppm").write_bytes(whole)
        self.diff(self.ref, self.traced, expect=0)
        # truncated; not as PNG: OpenImageIO 2.4 leaks a string when libpng's longjmp leaves it
        (self.traced / "b.1.ppm").write_bytes(whole[:len(whole) // 2])
        self.assertEqual(self.outcomes(self.ref, self.traced, expect=3),
                         {1: "unreadable", 2: "passed", 3: "passed", 4: "passed"})

    def test_bad_input(self):
        empty = self.dir / "empty"
        empty.mkdir()
        (self.dir / "t.trace").write_bytes(b"")
        (self.dir / "no.ref").write_bytes(b"RELREF0\n")
        for args in ([empty, self.traced], [self.dir / "none", self.traced], [self.ref, self.dir / "x.####.exr"],
                     [self.dir / "no.ref", self.traced]):
            done = self.diff(*args, expect=3)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("--ref", self.diff(self.dir / "t.trace", self.traced, expect=3).stderr)

    def test_wrong_usage(self):
        for args in ([self.ref], [self.ref, self.traced, "-f", "x"], [self.ref, self.traced, "--effects", "light=1:2"],
                     [self.ref, self.traced, "--effects", "shadow=a:2"], [self.ref, self.traced, "-f", "2000-3000000"],
                     [self.ref, self.traced, "--nonsense"]):
            self.diff(*args, expect=2)
        write_png(self.traced / "c.1.png", picture(1))
        self.assertIn("two images of frame 1", self.diff(self.ref, self.traced, expect=2).stderr)

    def test_reference_file(self):
        depth = struct.pack("<f", 1.0) * (WIDTH * HEIGHT)
        data = b"RELREF2\n" + b"".join(ref_color(n, picture(n)) + ref_record(2, n, depth) for n in range(1, 5))
        (self.dir / "t.ref").write_bytes(data)
        (self.dir / "t.trace").write_bytes(b"")
        self.diff(self.dir / "t.ref", self.traced, expect=0)
        write_png(self.dir / "two.png", picture(2))
        self.assertIn("two.png: has no frame number, and", self.diff(self.dir / "t.ref", self.dir / "two.png",
                                                                     expect=2).stderr)
        self.diff(self.dir / "t.ref", self.dir / "two.png", "-f", "2", expect=0)
        self.diff(self.dir / "t.ref", self.dir / "two.png", "-f", "1", expect=1)
        done = self.diff(self.dir / "t.trace", self.traced, "--table", expect=0)
        self.assertIn("not measured: R5 depth: the frame has no channel", done.stdout)
        (self.dir / "t.ref").write_bytes(data[:-10000])  # truncates the last frame's colour, too
        self.assertEqual(self.outcomes(self.dir / "t.ref", self.traced, expect=3)[4], "unreadable")
        done = self.diff(self.dir / "t.ref", self.traced, expect=3)
        self.assertEqual(done.stderr.count(f"warning: {self.dir}/t.ref: is cut short after frame 3; "), 1, done.stderr)
        self.diff(self.dir / "t.ref", self.traced, "-f", "1-3", expect=0)

    def test_no_such_layer(self):
        depth = struct.pack("<f", 1.0) * (WIDTH * HEIGHT)
        (self.dir / "t.ref").write_bytes(b"RELREF2\n" + b"".join(
            ref_color(n, picture(n)) + ref_record(2, n, depth) for n in range(1, 5)))
        for ref in (self.ref, self.dir / "t.ref"):
            done = self.diff(ref, self.traced, "--channel", "foo", expect=2)
            self.assertEqual(done.stderr, f"relume: {self.traced}: there is no layer 'foo'; --channel may be beauty\n")
            self.assertEqual(done.stdout, "")
            self.diff(ref, self.traced, "--channel", "beauty", expect=0)

    def test_frames_of_another_recording(self):
        golden = pathlib.Path(__file__).resolve().parent.parent / "golden"
        (self.dir / "t.ref").write_bytes(b"RELREF1\n" + ref_color(1, picture(1)))
        frame = golden / "cornell.0001.exr"
        for trace, said in (("cornell", False), ("two_triangles", True)):
            (self.dir / "t.trace").write_bytes((golden / f"{trace}.trace").read_bytes())
            done = self.diff(self.dir / "t.trace", frame, expect=1)
            self.assertEqual("made from another recording" in " ".join(done.stdout.split()), said, done.stdout)
            self.assertIn("    V validity: ", done.stdout)
        (self.dir / "out").mkdir()
        subprocess.run([
            RELUME, "render", "--device", "reference", "--mode", "gl", golden / "two_triangles.trace", "-o",
            self.dir / "out" / "####.exr"
        ], check=True)
        (self.dir / "t.trace").write_bytes((golden / "cornell.trace").read_bytes())
        done = self.diff(self.dir / "t.trace", self.dir / "out", expect=1)
        self.assertIn("another recording: one of two_triangles of hash", " ".join(done.stdout.split()))

    def test_junit(self):
        write_png(self.traced / "b.3.png", picture(9))
        (self.traced / "b.4.png").write_bytes(b"no")
        self.diff(self.ref, self.traced, "--junit", self.dir / "j.xml", expect=3)
        suite = xml.etree.ElementTree.parse(self.dir / "j.xml").getroot().find("testsuite")
        self.assertEqual([suite.get(k) for k in ("tests", "failures", "errors")], ["4", "1", "1"])
        failed = suite.find("testcase[failure]")
        self.assertEqual([failed.get(k) for k in ("classname", "name", "file")],
                         ["traced", "frame 3", str(self.traced / "b.3.png")])
        self.assertRegex(
            failed.find("failure").get("message"),
            "^not as the reference: R1 interior colour: interior pixels over 2/255 ")
        self.assertIn(f"\npicture: {self.traced}/b.3.png\nreference: {self.ref}/a.0003.png\n",
                      failed.find("failure").text)

    def test_names(self):
        """Pictures are matched by path if they have no number, if numbers repeat, and in folders; file endings do not
        matter."""
        for folder in (self.ref, self.traced):
            for n, name in enumerate(("login", "dark/login", "dark/menu.2", "5_on", "5_off")):
                write_png(folder / f"{name}.png", picture(n))
        self.assertEqual(
            {f.get("name", f["frame"]): f["outcome"] for f in self.json(self.ref, self.traced, expect=0)["frames"]},
            dict.fromkeys([1, 2, 3, 4, "5_off", "5_on", "dark/login", "dark/menu.2", "login"], "passed"))
        write_png(self.traced / "login.png", picture(9))
        (self.traced / "dark/menu.2.png").rename(self.traced / "dark/new.png")
        (self.traced / "5_on.png").unlink()
        write_png(self.traced / "5_on.tif", picture(3))
        subprocess.run(["oiiotool", self.ref / "5_on.png", "-o", self.traced / "5_on.tif"], check=True)
        out = self.diff(self.ref, self.traced, "--all", "--markdown", self.dir / "m.md", "--junit", self.dir / "j.xml",
                        "--annotations", "--report", self.dir / "page", expect=1).stdout
        for said in ("login: failed, ", "dark/menu.2: missing: ", "dark/new: extra: ", f"({self.traced}/login.png)",
                     "10 frames", "::error title=relume diff%3A login failed::"):
            self.assertIn(said, " ".join(out.split()) if said == "dark/menu.2: missing: " else out)
        self.assertNotIn("5_on", out)
        self.assertIn("| login | failed |", (self.dir / "m.md").read_text())
        self.assertEqual(
            {c.get("name") for c in xml.etree.ElementTree.parse(self.dir / "j.xml").iter("testcase") if len(c)},
            {"login", "dark/menu.2", "dark/new"})
        self.assertIn('"name": "dark/new"', (self.dir / "page/index.html").read_text())
        self.assertEqual(self.outcomes(self.ref, self.traced / "dark/../login.png", expect=1), {9: "failed"})
        write_png(self.dir / "other/new.png", picture(1))
        self.assertIn("no numbered image, and none with a path",
                      self.diff(self.ref, self.dir / "other", expect=3).stderr)
        # a file of reference frames has no other frames to compare with, and the message says so
        (self.dir / "t.ref").write_bytes(b"RELREF2\n" + b"".join(ref_color(n, picture(n)) for n in range(1, 5)))
        self.assertIn("login.png: has no number", self.diff(self.dir / "t.ref", self.traced, expect=0).stderr)
        write_png(self.traced / "login.tif", picture(9))
        self.assertIn("two pictures named login", self.diff(self.ref, self.traced, expect=2).stderr)

    def test_report(self):
        write_png(self.traced / "b.3.png", picture(9))
        out = self.dir / "deep" / "report"
        self.diff(self.ref, self.traced, "--report", out, expect=1)
        page = (out / "index.html").read_text()
        self.assertEqual(sorted(p.name for p in out.iterdir()), ["index.html", "sheet.png"])
        self.assertIsNone(re.search(r"(src|href)=[\"'](?!data:|#)|url\(|@import|fetch\(", page), "needs the network")
        for n in range(1, 5):
            self.assertIn(f'<script type="application/json" id="p{n}">{{', page)
        for block in re.findall(r'<script type="application/json" id="p\d+">(.*?)</script>', page, re.S):
            self.assertTrue(json.loads(block)["thumbnail"].startswith("data:image/png;base64,"))
        self.assertEqual(page.count('"flip": "data:image/png;base64,'), 4)
        self.assertLess(page.index('id="p3"'), page.index('id="p1"'))  # failures come first
        sheet = read_png(out / "sheet.png")  # a row for each frame, failures first: reference, compared picture, ...
        (left, top), = places(sheet, picture(3))
        (x, y), = places(sheet, picture(9))
        self.assertEqual(y, top)
        self.assertGreaterEqual(x, left + WIDTH)
        below = [places(sheet, picture(n)) for n in (1, 2, 4)]
        self.assertEqual([(at[0][0], at[1][0]) for at in below], [(left, x)] * 3)
        self.assertEqual(len({at[0][1] for at in below} | {top}), 4)
        self.assertGreater(min(at[0][1] for at in below), top)
        self.assertEqual(len(sheet[0]) // 3, left + 3 * (x - left), "columns: reference, compared picture, difference")

    def config(self, text):
        path = self.dir / "c.yaml"
        path.write_text(text)
        return "--config", path

    def test_configuration(self):
        write_png(self.traced / "b.3.png", picture(9))
        ignore = "ignore: [{x: 5, y: 0, width: 40, height: 40}]"
        self.diff(self.ref, self.traced, *self.config(f"rules:\n- match: 'tr*'\n  {ignore}\n"), expect=0)
        self.diff(self.ref, self.traced, *self.config(f"rules:\n- match: 'x*'\n  {ignore}\n"), expect=1)
        self.diff(self.ref, self.traced, *self.config(f"rules:\n- frames: 1-2\n  {ignore}\n"), expect=1)
        presets = "presets:\n- name: a\n  ignore: [{x: 5, y: 0, width: 10, height: 40}]\n" \
                  "- name: b\n  inherits: a\n  ignore: [{x: 15, y: 0, width: 30, height: 40}]\n"
        self.diff(self.ref, self.traced, *self.config(f"{presets}rules:\n- preset: b\n"), expect=0)
        self.diff(self.ref, self.traced, *self.config(f"{presets}rules:\n- preset: a\n"), expect=1)
        white = [bytes(3 * 5) + b"\xff" * (3 * 40) + bytes(3 * 3)] * HEIGHT
        write_png(self.dir / "m.png", white)
        self.diff(self.ref, self.traced, *self.config("rules:\n- mask: m.png\n"), expect=0)
        shutil.copy(self.ref / "a.0003.png", self.traced / "b.3.png")
        subprocess.run(["oiiotool", self.ref / "a.0002.png", "--ch", "R,G,B,A=0.5", "-o", self.traced / "b.2.png"],
                       check=True)
        self.diff(self.ref, self.traced, *self.config("rules:\n- ignore_alpha: no\n"), expect=1)
        subprocess.run([
            "oiiotool", self.ref / "a.0002.png", "--ch", "R,G,B,A=0.5", "--attrib", "oiio:UnassociatedAlpha", "1", "-o",
            self.traced / "b.2.tif"
        ], check=True)
        (self.traced / "b.2.png").unlink()
        self.diff(self.ref, self.traced, *self.config("rules:\n- {frames: 2, ignore_alpha: yes}\n"), expect=0)

    def test_bars(self):
        write_png(self.traced / "b.2.png", drifted(picture(2)))
        frames = lambda *args, expect: self.json(self.ref, self.traced, *args, expect=expect)["frames"]
        self.assertEqual(frames(expect=1)[1]["gates"]["P"]["state"], "failed")
        loose = self.config("rules:\n- bars: [{gate: P, fail: 0.1, warn: 0.01}]\n")
        self.assertEqual(frames(*loose, expect=0)[1]["gates"]["P"]["state"], "warned")
        done = self.diff(self.ref, self.traced, *loose, "--annotations", expect=0)
        self.assertIn("::warning title=relume diff%3A frame 2 warns::", done.stdout)
        better = self.config("rules:\n- bars: [{gate: P, fail: 0.1, better: 0.02}]\n")
        self.assertEqual([f["outcome"] for f in frames(*better, expect=1)], ["failed", "passed", "failed", "failed"])

    def test_runs(self):
        """Frame 2 is noisy, frame 3 is wrong in all runs, frame 4 is missing in one; runs are distinguished."""
        runs = [self.dir / f"run{n}" for n in range(4)]
        for n, run in enumerate(runs):
            for frame in range(1, 5):
                rows = [bytearray(row) for row in picture(frame)]
                if frame == 2:
                    rows[3 + n][3 * (5 + 8 * n):3 * (9 + 8 * n)] = b"\xff" * 12
                if frame == 3:
                    for row in rows[10:16]:
                        row[30:60] = b"\x20\xf0\x20" * 10
                if frame < 4 or n != 1:
                    write_png(run / f"f.{frame}.png", [bytes(row) for row in rows])
        rules = self.dir / "rules.yaml"
        rules.write_text(
            "rules:\n- {bars: [{gate: P, fail: 0.5}, {gate: R1, fail: 90}, {gate: R4, figure: 2, fail: 9000}]}\n"
            "flaky:\n- {frames: '1', gates: [R1], reason: a driver, expires: 2099-01-01}\n")
        said = self.diff(self.ref, *runs, expect=1).stdout
        verdicts = dict(re.findall(r"^ +(\d+) (flaky|regression)", said, re.M))
        self.assertEqual(verdicts, {"2": "flaky", "3": "regression", "4": "flaky"}, said)
        self.assertRegex(
            said, r"frames: \"2\", gates: \[R1[^]]*\], reason: .* in 4 of 4 runs, 16 pixels vary\", expires: 20\d\d-")
        self.assertRegex(said, r"4 flaky +1 of 4  missing \(1\)")
        self.assertIn("1 steady, 2 flaky (50 %), 1 regression\n", said)
        said = self.diff("--config", rules, self.ref, *runs, expect=1).stdout
        self.assertIn('the flaky entry "a driver": none of its gates failed in 4 pictures', said)
        self.assertIn("bar 9000 for R4", said)
        self.assertNotIn("bar 90 for R1", said)
        self.diff("-f", "1,2,4", "--quarantine", self.dir / "q.yaml", "--expires", "9", self.ref, *runs, expect=0)
        (self.dir / "approved.yaml").write_text((self.dir / "q.yaml").read_text())
        self.assertEqual(self.outcomes(self.ref, runs[0], "--config", self.dir / "approved.yaml", expect=1)[2], "flaky")
        self.assertNotIn("expires:",
                         self.diff("--config", self.dir / "approved.yaml", self.ref, *runs, expect=1).stdout)
        self.diff("--json", "-", self.ref, *runs, expect=2)
        self.diff("--quarantine", "x", self.ref, runs[0], expect=2)

    def test_markdown(self):
        write_png(self.traced / "b.2.png", picture(9))
        for _ in range(2):  # output of a job's earlier steps is kept
            self.diff("--markdown", self.dir / "sum.md", "--report", self.dir / "report", self.ref, self.traced,
                      expect=1)
        text = (self.dir / "sum.md").read_text()
        self.assertEqual(text.count("### relume diff"), 2)
        self.assertIn(
            f"3 passed, 1 failed of 4 frames; [page]({self.dir}/report/index.html), [contact "
            f"sheet]({self.dir}/report/sheet.png)",
            text)
        self.assertRegex(text, r"\| 2 \| failed \| not as the reference: \*\*R1\*\* interior pixels")
        write_png(self.traced / "b.3.png", picture(30))
        self.diff("--markdown", self.dir / "two.md", self.ref, self.traced, expect=1)
        self.assertEqual(
            len(
                re.findall(r"^\| 2-3 \| failed .* \(frame 3, the worst\) \|  \|$", (self.dir / "two.md").read_text(),
                           re.M)), 1)

    def test_flaky(self):
        write_png(self.traced / "b.2.png", drifted(picture(2)))
        entry = "flaky:\n- {{frames: '2', gates: [{}], reason: a driver, expires: {}}}\n"
        good = self.config(entry.format("P", "2999-01-31"))
        self.assertEqual(self.outcomes(self.ref, self.traced, *good, expect=0)[2], "flaky")
        self.diff(self.ref, self.traced, *good, "--junit", self.dir / "j.xml", expect=0)
        suite = xml.etree.ElementTree.parse(self.dir / "j.xml").getroot().find("testsuite")
        self.assertEqual(suite.find("testcase/skipped").get("message"), "a driver")
        done = self.diff(self.ref, self.traced, *self.config(entry.format("P", "2001-01-31")), expect=1)
        self.assertIn("expired", done.stderr)
        self.diff(self.ref, self.traced, *self.config(entry.format("R1", "2999-01-31")), expect=1)

    def test_bad_configuration(self):
        for text, said in (("rules:\n- match: a\n  bar: 3\n", "line 3: Unexpected key: bar"),
                           ("rules:\n- bars:\n  - gate: R9\n    fail: 1\n", "line 3: "),
                           ("rules:\n- bars: [{gate: R1, fail: x}]\n", "line 2: "),
                           ("rules:\n- preset: none\n", "no preset 'none'"),
                           ("presets:\n- {name: a, inherits: b}\n- {name: b, inherits: a}\n", "must be defined before"),
                           ("flaky:\n- {gates: [P], reason: x, expires: 2030-13-01}\n", "is not a date"),
                           ("rules:\n- mask: none.png\n", "none.png"),
                           ("rules:\n- bars: [{gate: R1, figure: 3, fail: 1}]\n", "has 1 figure")):
            done = self.diff(self.ref, self.traced, *self.config(text), expect=3)
            self.assertIn(said, done.stderr)
            self.assertIn(str(self.dir), done.stderr, "names the file")

    def test_first_wrong_frame(self):
        write_png(self.traced / "b.3.png", picture(9))
        (self.traced / "b.4.png").unlink()
        done = self.diff(self.ref, self.traced, "--all", "--annotations", expect=1)
        self.assertIn("first wrong frame 3", done.stdout)
        self.assertEqual(len(re.findall("^::error ", done.stdout, re.M)), 2)

    def test_annotated_name(self):
        """Special characters of workflow commands are escaped, including the escape character itself."""
        odd = self.dir / "50%0A\r\nx"
        for frame in range(1, 5):
            write_png(odd / f"b.{frame}.png", picture(9))
        done = self.diff(self.ref, odd, "--annotations", expect=1)
        said = [line for line in done.stdout.splitlines() if line.startswith("::error ")]
        self.assertEqual(len(said), 4)
        for line in said:
            self.assertIn(f"::{self.dir}/50%250A%0D%0Ax%0AR1 ", line)

    def test_nothing_half_written(self):
        (self.dir / "file").write_text("")
        self.diff(self.ref, self.traced, "--report", self.dir / "file", expect=5)
        self.diff(self.ref, self.traced, "--json", self.dir / "none" / "x.json", expect=5)
        if pathlib.Path("/dev/full").exists():
            self.diff(self.ref, self.traced, "--json", "/dev/full/x", expect=5)

    def test_raster_usage(self):
        for args, code in ((["t.trace"], 2), (["t.trace", "-o", "x.png"], 2), (["t.trace", "-o", "x.####.exr"], 2),
                           ([str(self.dir / "none.trace"), "-o", str(self.dir / "x.####.png")], 3)):
            done = subprocess.run([RELUME, "raster", *args], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertEqual(list(self.dir.glob("x*")), [])


if __name__ == "__main__":
    program = unittest.main(exit=False, failfast="RELUME_FIRST_FAILURE" in os.environ)
    failed = len(program.result.failures) + len(program.result.errors)
    # counts in libcheck's format, for the runner
    print(f"{100 if not failed else 0}%: Checks: {program.result.testsRun}, Failures: {failed}, Errors: 0")
    sys.exit(failed != 0)
