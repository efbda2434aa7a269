#!/usr/bin/python3
# limit: 300 s
"""`relume look` recovers the camera and the static objects: corpus/rooms rotates its viewer by 4 degrees per frame, in
front of a rotating torus."""
import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, finish, must, record, relume, render  # noqa: E402

FRAMES = 4
trace, rules = SCRATCH / "rooms.trace", SCRATCH / "rooms.look.yaml"
record(trace, corpus("rooms"), "--seed", 5, "--frames", FRAMES, "--animate", "camera", "--lighting", "opengl",
       "--truth", SCRATCH / "truth.json")
must(relume("look", trace, "-o", rules))
text = rules.read_text()
found = re.search(r"camera: followed through (\d+) of (\d+) frames, moves in (\d+)", text)
check(found and found.groups() == (str(FRAMES - 1), str(FRAMES), str(FRAMES - 1)),
      f"the camera moves in each frame but the first: {text[:400]}")
found = re.search(r"meshes: (\d+) static, (\d+) moving, (\d+) with the viewer", text)
check(found and int(found[1]) > 100 and found[2] == "1" and found[3] == "0",
      f"walls are static, the torus rotates: {text[:400]}")
check("world:" in text, "the file locates the world")

# A light at its position in world space (the first frame's eye space) is in OpenGL's position in each frame, and lights
# the scene alike.
lights = [json.loads(must(relume("scene", trace, "-f", f, "--json")).stdout)["lights"][0] for f in range(FRAMES)]
check(len({tuple(l["position_eye"]) for l in lights}) == FRAMES, "the light moves in eye space")
world = text[text.index("world:"):]
for frame, light in enumerate(lights):
    pictures = []
    for name, where in (("world", lights[0]["position_eye"]), ("eye", light["position_eye"])):
        rules.write_text(f"lights:\n- light: {light['index']}\n  space: {name}\n  position: {where}\n{world}")
        pictures += render(trace, SCRATCH / name, "-f", frame, "--look", rules, "--aov", "id", "--encoding",
                           "display")[-1:]
    first, second = (Image(p, ["R", "G", "B"]) for p in pictures)
    worst = max(abs(a - b) for c in "RGB" for p, q in zip(first.planes[c], second.planes[c]) for a, b in zip(p, q))
    check(worst < 0.02, f"frame {frame}: a light of the world keeps its place: {worst}")

# A frame that shows nothing of the world keeps OpenGL's picture.
rules.write_text("lights:\n- light: 0\n  off: yes\n- position: [0, 0, 0, 1]\n  space: world\n"
                 "world:\n- mesh: \"0123456789abcdef\"\n  at: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n")
plain, changed = (Image(render(trace, SCRATCH / n, "-f", 0, "--aov", "id", *o)[0], ["R", "G", "B"])
                  for n, o in (("plain", ()), ("lost", ("--look", rules))))
check(all(plain.planes[c] == changed.planes[c] for c in "RGB"), "no rule applies if the world is not visible")
done = relume("look", trace, "-f", "90-99", "-o", rules)
check(done.returncode == 2 and "has 4 frames" in done.stderr, f"missing frames: {done.stderr}")
finish()
