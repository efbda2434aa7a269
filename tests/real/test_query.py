#!/usr/bin/python3
"""relume query: rays, distances and collisions in a recorded frame, compared with the frame's own triangles; and
invalid input."""
import math
import pathlib
import struct
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import exr  # noqa: E402
from helpers import BUILD, RELUME, ROOT, SCRATCH, check, finish, must, relume, run  # noqa: E402

CORNELL = ROOT / "tests/golden/cornell.trace"
BINARY = {
    "nearest": ("8f", "3fI"), "any": ("8f", "I"), "distance": ("4f", "4fI"), "box": ("9f", "fI"), "sphere": ("7f", "fI")
}


def query(kind, queries, *options, trace=CORNELL):
    """Answers, each a list of words."""
    done = subprocess.run(
        [RELUME, "query", "-k", kind, *map(str, options), str(trace)], text=True, capture_output=True, timeout=100,
        input="".join(" ".join(map(str, q)) + "\n" for q in queries))
    must(done)
    return [line.split() for line in done.stdout.splitlines()]


# The frame's own triangles: rays along each pixel of a row, by nearest and by any, must find the depth.
must(relume("render", CORNELL, "-f", "1", "--mode", "gl", "--aov", "gl,Z,P,id", "-o", SCRATCH / "cornell.####.exr"))
image = exr.Image(SCRATCH / "cornell.0001.exr")
point = [image.at(channel, image.width // 3, image.height // 2) for channel in ("P.X", "P.Y", "P.Z", "id")]
check(all(map(math.isfinite, point)) and point[2] < 0, f"a point of the picture: {point}")
x, y, z, draw = point
through = query("nearest", [(0, 0, 0, 0, x, y, z, 1e9), (0, 0, 0, 0, x, y, z, 0.5), (0, 0, 0, 0, -x, -y, -z, 1e9)],
                "-f", 1)
check(
    abs(float(through[0][0]) - 1) < 2e-3 and int(through[0][4]) == int(draw),
    f"the ray through that pixel ends there: {through[0]}, id {draw}")
check(through[1] == ["-"] and through[2] == ["-"], f"no hit before it or behind the viewer: {through[1:]}")
check(
    query("any", [(0, 0, 0, 0, x, y, z, 2), (0, 0, 0, 0, x, y, z, 0.5)], "-f", 1) == [["1"], ["0"]],
    "any hit gives the same")
near = query("distance", [(x, y, z, 1e9), (x, y, z + 1e5, 1)], "-f", 1)
check(float(near[0][0]) < 2e-3 and near[1] == ["-"], f"the point lies on a surface: {near}")
every = query("all", [(0, 0, 0, 0, x, y, z, 1e9)], "-f", 1)[0]
check(
    int(every[0]) >= 1 and every[1] == through[0][0] and every[4] == through[0][3], f"the nearest of all hits: {every}")
ts = [float(t) for t in every[1::4]]
check(ts == sorted(ts) and len(ts) == int(every[0]), f"all hits are in order: {every}")
one = query("all", [(0, 0, 0, 0, x, y, z, 1e9)], "-f", 1, "-m", 1)[0]
check(one[0] == every[0] and one[1:] == every[1:5], f"--most 1: {one}")

# A small sphere and a small box move towards the point: they stop before it, at least by their size.
length = math.sqrt(x * x + y * y + z * z)
for kind, size in (("sphere", (0.01,)), ("box", (0.01, 0.01, 0.01))):
    stop = query(kind, [(0, 0, 0, *size, x, y, z), (0, 0, 0, *size, -x, -y, -z), (x, y, z, *size, 0, 0, 0)], "-f", 1)
    check(0.9 < float(stop[0][0]) <= 1 - 0.009 / length, f"the {kind} stops before the surface: {stop[0]}")
    check(stop[1] == ["-"] and float(stop[2][0]) == 0,
          f"the {kind} moves freely backwards, and touches at its place: {stop[1:]}")

# Binary numbers instead of text; a file instead of a pipe; comments.
text = {
    "nearest": (0, 0, 0, 0, x, y, z, 1e9), "any": (0, 0, 0, 0, x, y, z, 1e9), "distance": (0, 0, 0, 1e9),
    "box": (0, 0, 0, .1, .1, .1, 0, 0, 2 * z), "sphere": (0, 0, 0, .1, 0, 0, 2 * z)
}
for kind, (asked, answered) in BINARY.items():
    queries = SCRATCH / f"{kind}.bin"
    queries.write_bytes(struct.pack(asked, *text[kind]) * 3)
    must(relume("query", "-f", 1, "-k", kind, "--binary", CORNELL, queries, "-o", SCRATCH / "new/answers.bin"))
    answers = (SCRATCH / "new/answers.bin").read_bytes()
    words = query(kind, [text[kind]], "-f", 1)[0]
    numbers = struct.unpack(answered, answers[:struct.calcsize(answered)])
    check(
        len(answers) == 3 * struct.calcsize(answered) and answers[:len(answers) // 3] == answers[-(len(answers) // 3):],
        f"{kind}: three answers")
    check(all(abs(a - float(b)) <= 1e-6 * abs(a) for a, b in zip(numbers, words)),
          f"{kind}: numbers {numbers}, text {words}")
(SCRATCH / "queries.txt").write_text("# rays\n\n0 0 0 0  0 0 -1 1e9  # straight on\n   \n0 0 0 0 0 0 1 1e9")
done = relume("query", "-f", 1, CORNELL, SCRATCH / "queries.txt")
check(done.returncode == 0 and len(done.stdout.splitlines()) == 2 and done.stdout.splitlines()[1] == "-",
      f"comments: {done.stdout}{done.stderr}")
check(query("nearest", [], "-f", 1) == [], "no queries give no answers")
check(
    query("nearest", [("nan", 0, 0, 0, 0, 0, -1, 9), (0, 0, 0, 0, 0, 0, "-inf", 9)], "-f", 1) == [["-"], ["-"]],
    "NaN queries find nothing")
# No draw of this frame is depth-tested: an empty scene.
empty = query("distance", [(0, 0, 0, 1e9)], "-f", 0, trace=ROOT / "tests/golden/two_triangles.trace")
check(empty == [["-"]], f"a frame without depth: {empty}")

# Invalid input: one line, the right code, no partial output.
(SCRATCH / "bad.txt").write_text("0 0 0 0 0 0 -1 1e9\n0 0 0\n")
(SCRATCH / "word.txt").write_text("0 0 0 0 0 0 -1 far\n")
(SCRATCH / "torn.bin").write_bytes(b"\0" * 33)
for what, code, words in (("too few numbers", 3, (CORNELL, SCRATCH / "bad.txt", "-o", SCRATCH / "none.txt")),
                          ("a word", 3, (CORNELL, SCRATCH / "word.txt", "-o", SCRATCH / "none.txt")),
                          ("a torn query", 3, (CORNELL, SCRATCH / "torn.bin", "--binary", "-o", SCRATCH / "none.txt")),
                          ("no such file", 3, (CORNELL, SCRATCH / "absent.txt", "-o", SCRATCH / "none.txt")),
                          ("no such recording", 3, (SCRATCH / "absent.trace",)),
                          ("no such frame", 2, (CORNELL, "-f", 99)),
                          ("no such kind", 2, (CORNELL, "-k", "colour")),
                          ("no hits wanted", 2, (CORNELL, "-k", "all", "-m", 0)),
                          ("no such device", 2, (CORNELL, "-d", "no such device"))):
    done = relume("query", *words)
    lines = [line for line in done.stderr.splitlines() if line]
    check(done.returncode == code and len(lines) == 1, f"{what}: {done.returncode}, {done.stderr}")
check(not (SCRATCH / "none.txt").exists(), "nothing half-written")
check("bad.txt:2" in relume("query", CORNELL, SCRATCH / "bad.txt").stderr, "the line is named")

# A program that uses the library through its public header.
(SCRATCH / "mine.c").write_text(r"""
#include <stdio.h>
#include <relume-rays.h>

int main(int argc, char **argv)
{
	const float corners[3][3] = { { -1, -1, -5 }, { 1, -1, -5 }, { 0, 2, -5 } };
	const unsigned index[1][3] = { { 0, 1, 2 } };
	const struct relume_rays_ray ray = { { 0, 0, 0 }, 0, { 0, 0, -2 }, 100 };
	struct relume_rays *rays;
	struct relume_rays_hit hit;

	if (relume_rays_open_triangles(corners, 3, index, 1, argc > 1 ? argv[1] : NULL, &rays) || relume_rays_nearest(rays, &ray, 1, &hit))
		return 1;
	printf("%g %g %g %u of %zu\n", hit.t, hit.b1, hit.b2, hit.triangle, relume_rays_triangles(rays));
	relume_rays_close(&rays);
	return 0;
}
""")
must(
    run("cc", "-Wall", "-Werror", f"-I{ROOT / 'verbs/query'}", SCRATCH / "mine.c", "-o", SCRATCH / "mine", f"-L{BUILD}",
        f"-Wl,-rpath,{BUILD.resolve()}", "-lrelume-rays"))
for device in ((), ("reference",)):
    done = run(SCRATCH / "mine", *device)
    check(done.stdout.split()[0] == "2.5" and done.stdout.strip().endswith("0 of 1"),
          f"a program's own triangle: {done.stdout}{done.stderr}")
shown = run("nm", "-D", "--defined-only", BUILD / "librelume-rays.so").stdout.split("\n")
check(all(line.split()[2].startswith("relume_rays_") for line in shown if line),
      "the library exports only its interface")
finish()
