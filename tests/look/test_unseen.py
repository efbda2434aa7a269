#!/usr/bin/python3
# limit: 300 s
"""Static objects that a frame leaves out still cast shadows: corpus/rooms with portal culling and a rotating viewer,
compared with the whole level. `relume look` writes rules that name the draws of other frames."""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import BUILD, SCRATCH, check, corpus, finish, must, record, relume, render  # noqa: E402

FRAME, NEAR = 20, 2 / 255
for cull in ("none", "portal"):
    record(SCRATCH / f"{cull}.trace", corpus("rooms"), "--seed", 5, "--frames", FRAME + 1, "--animate", "camera",
           "--mirror", "--lighting", "opengl", "--cull", cull, options=())
found, none = SCRATCH / "found.look.yaml", SCRATCH / "none.look.yaml"
must(relume("look", SCRATCH / "portal.trace", "-o", found))
unseen, world = re.search(r"\nunseen:\n(?:  .*\n)+", found.read_text()), re.search(r"\nworld:\n(?:  .*\n?)+",
                                                                                   found.read_text())
check(unseen and world, f"objects out of sight are listed: {found.read_text()[:1000]}")
found.write_text("spare: no" + unseen[0] + world[0])
none.write_text("spare: no\n")


def beauty(trace, rules, name):
    return Image(
        render(SCRATCH / f"{trace}.trace", SCRATCH / name, "-f", FRAME, "--look", rules, "--aov", "gl")[0],
        ["R", "G", "B", "gl.G"]).planes


def equal_share(a, b):
    pixels = [
        max(abs(x - y)
            for x, y in zip(p, q))
        for p, q in zip(*(zip(*(sum(map(list, s[c]), []) for c in "RGB")) for s in (a, b)))
    ]
    return sum(p <= NEAR for p in pixels) / len(pixels)


whole, without, restored = (beauty(*of)
                            for of in (("none", none, "whole"), ("portal", none, "without"), ("portal", found, "with")))
check(
    equal_share(whole, without) < 0.5,
    f"culling removes shadows: {equal_share(whole, without)} of the pixels are the same")
check(equal_share(whole, restored) > 0.98, f"other frames' draws bring them back: {equal_share(whole, restored)}")
check(without["gl.G"] == restored["gl.G"], "OpenGL's own picture is unchanged")
relume("look", SCRATCH / "portal.trace", "-o", found)
found.write_text(found.read_text().replace("unseen:\n", "unseen:\n  - frame: 3\n", 1))
done = relume("render", SCRATCH / "portal.trace", "-f", FRAME, "-o", SCRATCH / "x.exr", "--look", found)
check(done.returncode == 3 and "needs a frame and draws" in done.stderr,
      f"a rule without draws is refused: {done.stderr}")

stair = SCRATCH / "stair.trace"
record(stair, BUILD / "tests/real/stair")
must(relume("look", stair, "-o", found))
parts = set(re.findall(r"\n    part: (\d+)", found.read_text()))
check("unseen:" not in found.read_text(),
      f"a staircase replaced by another is not out of sight: {found.read_text()}")
check(len(parts) == 3, f"each has a part of the recording: {parts}")

ground = SCRATCH / "ground.trace"
record(ground, BUILD / "tests/real/recut", options=())
must(relume("look", ground, "-o", found))
plain = re.sub(r"\nunseen:\n(?:  .*\n)+", "\n", found.read_text())
check(plain != found.read_text(), f"the ground of the first frames is out of sight later: {found.read_text()}")
none.write_text(plain)
for frame in 8, 15:
    with_it, alone = (Image(
        render(ground, SCRATCH / f"ground-{rules.stem}", "-f", frame, "--look", rules, "--aov", "gl")[0],
        ["R", "G", "B"]).planes for rules in (found, none))
    check(
        equal_share(with_it, alone) > 0.99,
        f"no shadow of a ground with another tessellation, in frame {frame}: {equal_share(with_it, alone)}")
finish()
