#!/usr/bin/python3
# limit: 300 s
"""Decals on the ground and paintings behind the world (corpus/street, with a static viewer): a sky, a road mark, a blob
shadow are each found once. The blob is replaced by the traced shadow of OpenGL's light, or of the sun visible in the
sky. OpenGL's own picture is unchanged."""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, diff, finish, must, record, relume, render  # noqa: E402

COLORS, GL = ["R", "G", "B"], ["gl.R", "gl.G", "gl.B"]
MARK = (60, 155)  # columns of the road mark


def picture(kind, name, *look):
    return Image(
        render(SCRATCH / f"{kind}.trace", SCRATCH / f"{kind}-{name}", "-f", 2, "--aov", "gl", *look)[0],
        COLORS + GL).planes


def worst(a, b, channels, columns=range(400)):
    return max(abs(p[x] - q[x]) for c in channels for p, q in zip(a[c], b[c]) for x in columns)


def brightness(planes, x0, y0, x1, y1):
    return sum(sum(row[x0:x1]) for row in planes["G"][y0:y1]) / ((x1 - x0) * (y1 - y0))


def without_dome(text):
    """Rules without ambient occlusion and highlights, so that only shadows are compared."""
    return re.sub(r"^(sky|gloss):.*\n(  .*\n)*", "", text, flags=re.M)


rules = {}
for kind in ("lit", "unlit", "plain", "thrown"):
    record(SCRATCH / f"{kind}.trace", corpus("street"), "--frames", 4, "--size", "400x300", "--by", kind,
           **({} if kind == "unlit" else {"options": ()}))
    rules[kind] = SCRATCH / f"{kind}.look.yaml"
    if kind == "thrown":
        continue
    must(relume("look", SCRATCH / f"{kind}.trace", "-o", rules[kind]))
    text = rules[kind].read_text()
    for role, times in (("sky", 1), ("decal", kind != "plain"), ("blob shadow", kind != "plain")):
        check(text.count(f"- role: {role}\n") == times, f"{kind}: {role}: {text}")
    check(("left_out: yes" in text) == (kind != "plain") and ("role: sun" in text) == (kind == "unlit"),
          f"{kind}: a light, and no second blob: {text}")

for kind in ("lit", "plain"):
    rules[kind].write_text(without_dome(rules[kind].read_text()))
before, after, plain = picture("lit", "before"), picture("lit", "after", "--look",
                                                         rules["lit"]), picture("plain", "after", "--look",
                                                                                rules["plain"])
check(worst(before, after, GL) == 0, "OpenGL's picture is unchanged")
check(worst(before, after, COLORS) > 0.01, "the blob shows without rules")
beside_mark = [x for x in range(400) if not MARK[0] <= x <= MARK[1]]
off = worst(after, plain, COLORS, beside_mark)
check(off < 0.002, f"without it the picture equals that of the scene drawn without it: off by {off}")
rules["lit"].write_text(rules["lit"].read_text().replace("replace: yes", "replace: no"))
check(worst(picture("lit", "kept", "--look", rules["lit"]), before, COLORS) == 0, "one key keeps the blob")

# The same blob projected onto the ground by a texture unit: the traced shadow replaces it, in the albedo too.
must(relume("look", SCRATCH / "thrown.trace", "-o", rules["thrown"]))
text = rules["thrown"].read_text()
check(text.count("- role: shadow in a unit\n") == 1 and "shadow_unit: 0" in text, f"thrown: {text}")
rules["thrown"].write_text(without_dome(text))
before, after = picture("thrown", "before"), picture("thrown", "after", "--look", rules["thrown"])
check(worst(before, after, GL) == 0, "thrown: OpenGL's picture is unchanged")
off, was = worst(after, plain, COLORS), worst(before, plain, COLORS)
check(off < 0.006 < was,
      f"thrown: without it the picture equals that of the scene drawn without it: off by {off}, with it by {was}")
rules["thrown"].write_text(without_dome(text).replace("replace: yes", "replace: no"))
check(worst(picture("thrown", "kept", "--look", rules["thrown"]), before, COLORS) == 0, "thrown: one key keeps it")

# In an unlit scene, the sun visible in the sky becomes the light: the sky and the lamp are unchanged, open ground
# nearly so, and the ball casts a shadow towards the viewer. Sun: texel (39.5, 25.5) + 0.5 of the picture ahead; the
# viewer looks down by 10 degrees.
unlit, shaped = picture("unlit", "before"), picture("unlit", "after", "--look", rules["unlit"])
text = rules["unlit"].read_text()
found = [float(x) for x in re.search(r"role: sun$.*?position: \[(.*?)\]", text, re.M | re.S)[1].split(",")]
check(
    sum((a - b)**2 for a, b in zip(found, (0.2336, 0.4269, -0.8736, 0))) < 0.01**2,
    f"the sun is where the sky shows it: {found}")
check(text.count("- role: lamp\n") == 1 and text.count("- role: light of a lamp\n") == 1, f"the lamp shines: {text}")
check(
    worst(unlit, shaped, GL) == 0
    and all(shaped[c][y][x] == unlit[c][y][x] for c in COLORS for y in range(60) for x in range(200)),
    "the sky is unchanged")
check(brightness(shaped, 330, 58, 355, 70) == brightness(unlit, 330, 58, 355, 70), "the lamp is unchanged")
check(0.85 < brightness(shaped, 330, 230, 390, 290) / brightness(unlit, 330, 230, 390, 290) < 1.15,
      "open ground is nearly unchanged")
check(brightness(shaped, 160, 255, 190, 275) < 0.9 * brightness(unlit, 160, 255, 190, 275), "the ball casts a shadow")
render(SCRATCH / "unlit.trace", SCRATCH / "harm", "-f", 2, "--look", rules["unlit"])
code, score = diff(SCRATCH / "unlit.trace", SCRATCH / "harm")
harm = [f["gates"]["N"] for f in score["frames"] if f["frame"] == 2]
check(harm and harm[0]["state"] == "passed", f"no harm: {harm}")
finish()
