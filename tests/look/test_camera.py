#!/usr/bin/python3
# limit: 300 s
"""A recorded frame from another place (`render --camera`): it equals the program's picture from there. Also turntables;
and such pictures are never scored as the program's own."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, diff, finish, must, record, relume, render  # noqa: E402

NEAR, FRAMES = 3 / 255, 4
life, rooms, file = SCRATCH / "life.trace", SCRATCH / "rooms.trace", SCRATCH / "elsewhere.yaml"
record(life, corpus("still_life"), "--frames", FRAMES, "--animate", "camera")
record(rooms, corpus("rooms"), "--seed", 5, "--frames", FRAMES, "--animate", "camera", "--lighting", "opengl",
       "--mirror", options=())


def pixels(path, channels="RGB"):
    planes = Image(path, list(channels)).planes
    return list(zip(*(sum(map(list, planes[c]), []) for c in channels)))


def from_elsewhere(trace, frame, name, text, *options):
    file.write_text(text)
    return render(trace, SCRATCH / name, "-f", frame, "--camera", file, "--encoding", "display", *options)


def equal_share(a, b):
    return sum(max(abs(x - y) for x, y in zip(p, q)) <= NEAR for p, q in zip(a, b)) / len(a)


# The program moves 0.15 to the right per frame.
there = pixels(render(life, SCRATCH / "there", "-f", 3, "--encoding", "display", "--aov", "gl")[0])
here = pixels(render(life, SCRATCH / "here", "-f", 0, "--encoding", "display", "--aov", "gl")[0])
moved = from_elsewhere(life, 0, "moved", "place: [-0.45, 0, 0]\n")
check(equal_share(there, here) < 0.9, f"the program's frames differ: {equal_share(there, here)}")
share = equal_share(there, pixels(moved[0]))
check(share >= 0.999, f"frame 0 seen from frame 3's place equals frame 3: {share}")
own = from_elsewhere(life, 0, "own", "place: [0, 0, 0]\nlook_at: [0, 0, -1]\n", "--aov", "gl")
check(pixels(own[0]) == here, "from the recorded place, the recorded picture")
check(
    Image(moved[0], ["R"]).attributes["relume:camera"].decode().startswith("at -0.45 0 0, towards 0 0 -1"),
    "the picture records its camera")

# The program rotates its view by 4 degrees per frame, and the look file knows the world: camera 3 in world space, and
# in frame 0's eye space.
scenes = [json.loads(must(relume("scene", rooms, "-f", f, "--json")).stdout) for f in (0, 3)]
must(relume("look", rooms, "-o", SCRATCH / "rooms.look.yaml"))
world = SCRATCH / "world.look.yaml"
text = (SCRATCH / "rooms.look.yaml").read_text()
world.write_text(text[text.index("world:"):])
walls = [{i["list"]: i["modelview"] for i in s["instances"] if i["list"]} for s in scenes]
a, b = (of[max(walls[0].keys() & walls[1].keys())] for of in walls)
turn = [[sum(b[4 * k + i] * a[4 * k + j]
             for k in range(3))
         for j in range(3)]
        for i in range(3)]  # eye 3 from eye 0: b a^-1, both without scale
place = [
    sum(turn[i][j] * (sum(turn[i][k] * a[12 + k] for k in range(3)) - b[12 + i]) for i in range(3)) for j in range(3)
]
at, up = [p - d for p, d in zip(place, turn[2])], turn[1]
GL = ("gl.R", "gl.G", "gl.B", "id")
there = pixels(render(rooms, SCRATCH / "turned", "-f", 3, "--encoding", "display", "--aov", "gl,id")[0], GL)
here = pixels(render(rooms, SCRATCH / "straight", "-f", 0, "--encoding", "display", "--aov", "gl,id")[0], GL)
torus = max(p[3] for p in there)  # the last draw, which rotates


def equal_walls(other):
    walls = [(p[:3], q[:3]) for p, q in zip(there, other) if torus not in (p[3], q[3])]
    check(len(walls) > 0.8 * len(there), f"most of the picture shows walls: {len(walls)} of {len(there)}")
    return equal_share(*zip(*walls))


check(equal_walls(here) < 0.8, f"the viewer turns: {equal_walls(here)}")
for space in ("eye", "world"):
    moved = from_elsewhere(rooms, 0, space, f"space: {space}\nplace: {place}\nlook_at: {at}\nup: {up}\n", "--look",
                           world, "--aov", "gl,id")
    share = equal_walls(pixels(moved[0], GL))
    check(
        share >= 0.99,
        f"frame 0 from frame 3's camera, except the torus, its mirror image, and a culled room; space "
        f"{space}: {share}"
    )

# A turntable: pictures of one frame, numbered from 0; a second run skips existing ones.
table = "turntable: { frames: 4 }\nsize: [40, 30]\n"
made = from_elsewhere(life, 2, "table", table, "--chunk", "2/2")
check([p.name[-8:-4] for p in made] == ["0002", "0003"], f"half of a turntable's pictures: {made}")
made = from_elsewhere(life, 2, "table", table)
check(len(made) == 4 and len({str(pixels(p)) for p in made}) == 4, "a turntable shows four sides")
done = relume("render", life, "-f", 2, "--camera", file, "--encoding", "display", "-o", SCRATCH / "table/life.####.exr",
              "--skip-existing", "--dry-run")
check(done.stdout.count("leave") == 4, f"existing pictures are kept: {done.stdout}")
must(relume("farm", "submit", "--local", life, "-f", 2, "--chunk", 3, "-o", SCRATCH / "farm.####.exr", "--", "--camera",
            file, "--encoding", "display"))
check([p.read_bytes() for p in sorted(SCRATCH.glob("farm.*.exr"))] == [p.read_bytes() for p in made],
      "a farm splits a turntable's pictures")
done = relume("farm", "status", SCRATCH / "farm.farm")
check("frames 4 of 4 whole" in done.stdout, f"status counts them: {done.stdout}")

# They are not scored.
_, score = diff(life, SCRATCH / "moved", "--frames", 0)
notes = json.dumps(score)
check(score["counts"]["passed"] == 0 and "made with --camera" in notes,
      f"a view from another camera is not scored against the reference: {notes[:300]}")

for text, options, code, words in ((table, ("-o", SCRATCH / "x.####.exr"), 2, "-f names it"),
                                   (table, ("-f", 1, "-o", SCRATCH / "x.exr"), 2, "no place for the frame number"),
                                   ("space: world\n", ("-f", 1, "-o", SCRATCH / "x.exr"), 2, "space is world"),
                                   ("place: [0, 0]\n", ("-f", 1, "-o", SCRATCH / "x.exr"), 3,
                                    "line 1"), ("up: [0, 0, 1]\n", ("-f", 1, "-o", SCRATCH / "x.exr"), 5,
                                                "line of sight"), ("near: -1\n", ("-f", 1, "-o", SCRATCH / "x.exr"), 5,
                                                                   "for a pinhole, it must be above 0"),
                                   ("place: [0, 0, 1]\n", ("-f", 1, "-o", SCRATCH / "x.exr", "--aov", "motion"), 2,
                                    "no motion")):
    file.write_text(text)
    done = relume("render", life, "--camera", file, "--progress", "none", *options)
    check(done.returncode == code and words in done.stderr and done.stderr.count("\n") == 1,
          f"{text!r}: exit code {done.returncode}, {done.stderr}")
finish()
