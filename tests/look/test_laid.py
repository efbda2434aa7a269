#!/usr/bin/python3
# limit: 300 s
"""What a program lays on the ground and paints behind the world (corpus/street, whose viewer stands still): a sky, a mark, a blob of shadow,
each found once. The blob gives way to the traced shadow of OpenGL's light, and stays where there is none; OpenGL's own picture stays."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, finish, must, record, relume, render  # noqa: E402

COLORS, GL = ["R", "G", "B"], ["gl.R", "gl.G", "gl.B"]
MARK = (60, 155)  # columns that the mark covers


def picture(kind, name, *look):
    return Image(render(SCRATCH / f"{kind}.trace", SCRATCH / f"{kind}-{name}", "-f", 2, "--aov", "gl", *look)[0], COLORS + GL).planes


def worst(a, b, channels, columns=range(400)):
    return max(abs(p[x] - q[x]) for c in channels for p, q in zip(a[c], b[c]) for x in columns)


def brightness(planes, x0, y0, x1, y1):
    return sum(sum(row[x0:x1]) for row in planes["G"][y0:y1]) / ((x1 - x0) * (y1 - y0))


rules = {}
for kind in ("lit", "unlit", "plain"):
    record(SCRATCH / f"{kind}.trace", corpus("street"), "--frames", 4, "--size", "400x300", "--by", kind, options=())
    rules[kind] = SCRATCH / f"{kind}.look.yaml"
    must(relume("look", SCRATCH / f"{kind}.trace", "-o", rules[kind]))
    text = rules[kind].read_text()
    for role, times in (("sky", 1), ("decal", kind != "plain"), ("blob shadow", kind != "plain")):
        check(text.count(f"- role: {role}\n") == times, f"{kind}: {role}: {text}")
    check(("left_out: yes" in text) == (kind == "lit"), f"{kind}: only where OpenGL's light makes the same shadow the blob is left out: {text}")

before, after, plain = picture("lit", "before"), picture("lit", "after", "--look", rules["lit"]), picture("plain", "after", "--look", rules["plain"])
check(worst(before, after, GL) == 0, "OpenGL's picture stays")
check(worst(before, after, COLORS) > 0.01, "the blob shows without rules")
beside_mark = [x for x in range(400) if not MARK[0] <= x <= MARK[1]]
off = worst(after, plain, COLORS, beside_mark)
check(off < 0.002, f"without it the picture is that of the scene drawn without: off by {off}")
rules["lit"].write_text(rules["lit"].read_text().replace("replace: yes", "replace: no"))
check(worst(picture("lit", "kept", "--look", rules["lit"]), before, COLORS) == 0, "one key keeps the blob")

# Where nothing is lit, sky light is: it leaves the sky and the blob as they are, and shapes the ball.
unlit, shaped = picture("unlit", "before"), picture("unlit", "after", "--look", rules["unlit"])
check(worst(unlit, shaped, GL) == 0 and all(shaped[c][y][x] == unlit[c][y][x] for c in COLORS for y in range(60) for x in range(200)), "the sky stays")
check(brightness(shaped, 170, 205, 205, 225) < 0.95 * brightness(unlit, 170, 205, 205, 225), "the ball is darker below")
finish()
