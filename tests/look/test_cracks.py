#!/usr/bin/python3
# limit: 300 s
"""Meshes under `repair` (tests/real/cracks.c): light no longer leaks through a roof's T-junction; a die with reversed
far sides bends light like one of glass; OpenGL's picture and the camera's view are unchanged; repairs and leaks are
reported. On the first device and with the twins."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import BUILD, SCRATCH, check, finish, must, record, relume, run  # noqa: E402

KEPT = ("gl.R", "gl.G", "gl.B", "gl.depth", "Z", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "albedo.R", "albedo.G",
        "albedo.B", "id")
GLASS = "spare: no\nsurfaces:\n  - match: {{ list: 1 }}\n    transmit: 0.9\n    ior: 1.5\n{}"
trace = SCRATCH / "cracks.trace"
record(trace, BUILD / "tests/real/cracks")


def picture(name, frame, rules, device="reference"):
    """One frame: its channels, the command's output and the file's attributes."""
    look, out = SCRATCH / f"{name}.yaml", SCRATCH / f"{name}_{device}.exr"
    look.write_text(rules)
    done = must(relume("render", trace, "-f", frame, "-o", out, "--look", look, "--device", device))
    return Image(out,
                 {*KEPT, "R", "G", "B", "shadow.G", "refract.R", "refract.G"}).planes, done.stderr, run("strings",
                                                                                                        out).stdout


def lit_floor(planes):
    """Pixels of the floor that the lamp lights."""
    return sum(up > 0.9 and light > 0.2 for rows in zip(planes["N.Y"], planes["shadow.G"]) for up, light in zip(*rows))


def most_apart(a, b, channel):
    return max(abs(x - y) for rows in zip(a[channel], b[channel]) for x, y in zip(*rows))


for device in ("reference", "0"):
    before, _, _ = picture("before", 0, "spare: no\n", device)
    after, said, listed = picture("after", 0, "spare: no\nsurfaces:\n  - repair: { weld: 0.006 }\n", device)
    check(
        lit_floor(before) > 20 and lit_floor(after) == 0,
        f"{device}: {lit_floor(before)} pixels of the floor were lit through the roof, {lit_floor(after)} are")
    check(all(before[c] == after[c] for c in KEPT), f"{device}: OpenGL's picture and the camera's view are unchanged")
    merged, _, said_so = picture("merged", 0, "spare: no\nsurfaces:\n  - repair: { weld: 0.006, merge: yes }\n", device)
    check(
        lit_floor(merged) == 0 and all(before[c] == merged[c] for c in KEPT) and " 0 places merged" not in said_so,
        f"{device}: unchanged with coplanar triangles merged")
check("closed mesh" in listed and "closed" in listed and "leaks" not in said,
      f"the room is reported as closed: {said}{[line for line in listed.splitlines() if 'welded' in line]}")
tight, said, listed = picture("tight", 0, "spare: no\nsurfaces:\n  - repair: {}\n")
check(lit_floor(tight) == lit_floor(picture("before", 0, "spare: no\n")[0]), "a crack wider than the tolerance remains")
check("still leaks light at" in said and "mesh that leaks" in listed, f"the wider crack is reported: {said}")

whole, _, _ = picture("whole", 2, GLASS.format(""))
for device in ("reference", "0"):
    broken, _, _ = picture("broken", 1, GLASS.format(""), device)
    mended, _, _ = picture("mended", 1, GLASS.format("    repair: {}\n"), device)
    over, _, _ = picture("over", 3, GLASS.format("    repair: {}\n"), device)
    check(
        most_apart(over, whole, "R") < 0.01
        and most_apart(picture("inside", 3, GLASS.format(""), device)[0], whole, "R") > 0.2,
        f"{device}: a die seen from its back sides is repaired, too: {most_apart(over, whole, 'R')}")
    same, _, _ = picture("same", 2, GLASS.format("    repair: {}\n"), device)
    check(most_apart(broken, whole, "refract.R") > 0.2, f"{device}: reversed sides bend light the wrong way")
    check(
        most_apart(mended, whole, "refract.R") < 0.01 and most_apart(mended, whole, "R") < 0.01,
        f"{device}: repaired it is glass: {most_apart(mended, whole, 'refract.R')}")
    check(all(broken[c] == mended[c] for c in KEPT), f"{device}: OpenGL's picture of the die is unchanged")
    check(most_apart(same, whole, "R") < 1e-3, f"{device}: a whole mesh is unchanged")
bad = SCRATCH / "bad.yaml"
for rule, says in (("repair: { weld: 0.5 }", "weld is 0.5"), ("repair: { glue: yes }", "line 2")):
    bad.write_text(f"surfaces:\n  - {rule}\n")
    done = relume("render", trace, "-f", 0, "-o", SCRATCH / "bad.exr", "--look", bad)
    check(done.returncode == 3 and says in done.stderr, f"{rule} is an error: {done.stderr}")
finish()
