#!/usr/bin/python3
# limit: 300 s: a compilation for each hook
"""Hooks that decide what rays hit and what light arrives: any_hit, bounds with intersection, light. Each is compared
with a picture made without it."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import exr  # noqa: E402
from helpers import ROOT, SCRATCH, check, corpus, finish, must, record, relume  # noqa: E402

TRACE = SCRATCH / "still.trace"
FUNCTIONS = {
    "any_hit": ("request", "hit hit"), "closest_hit": ("request", "hit hit"), "miss": ("request", "miss missed"),
    "light": ("request", "beam beam"), "bounds": ("box", "object object"),
    "intersection": ("request", "crossing crossing"), "ray_generation": ("ray", "pixel pixel")
}
SKY = {"miss": "return relume_color((float4)(0.25f, 0.5f, 1.0f, 0.0f));"}
BOX, BALL = 3, 4  # draw numbers of corpus/still_life


def hook(name, functions, parameters=""):
    """A hook with functions of these bodies."""
    path = SCRATCH / f"{name}.cl"
    path.write_text(parameters + "".join(
        f"struct relume_{FUNCTIONS[f][0]} {f}(struct relume_{FUNCTIONS[f][1]}, struct relume_parameters "
        f"parameters)\n{{\n{body}\n}}\n"
        for f, body in functions.items()))
    return path


def picture(name, functions=None, *options, parameters="", channels="RGB"):
    """Rendered with such a hook, in display codes."""
    given = ("--hook", hook(name, functions, parameters)) if functions else ()
    must(
        relume("render", TRACE, "-f", 1, "-o", SCRATCH / f"{name}.####.exr", "--encoding", "display", *given, *options,
               timeout=280))
    return exr.Image(SCRATCH / f"{name}.0001.exr", list(channels))


def differing(a, b, channels="RGB", most=0.0):
    """Pixels with a channel that differs by more than `most`."""
    return sum(
        any(not abs(a.at(c, x, y) - b.at(c, x, y)) <= most
            for c in channels)
        for y in range(a.height)
        for x in range(a.width))


record(TRACE, corpus("still_life"), "--frames", "2", "--size", "160x120", options=())
PIXELS = 160 * 120
SHADOW = [f"shadow.{c}" for c in "RGB"]
plain = picture("plain", channels=["R", "G", "B", "id", "Z", "gl.R", "gl.G", "gl.B", *SHADOW])
shaded = [(x, y) for y in range(120) for x in range(160) if min(plain.at(c, x, y) for c in SHADOW) < 1]
check(len(shaded) > 500, f"{len(shaded)} pixels are in shadow")

# Any hit: no surface for any ray; none for shadow rays; none in mirrors.
none = picture("none", {"any_hit": "return relume_ignore();", **SKY},
               channels=["R", "G", "B", "gl.R", "gl.G", "gl.B", "Z"])
check(differing(none, plain, ("gl.R", "gl.G", "gl.B", "Z")) == 0, "gl.* and Z are unchanged")
here = [(x, y) for y in range(120) for x in range(160) if plain.at("id", x, y) in (BOX, BALL)]
check(all(none.at(c, x, y) == v for x, y in here for c, v in (("R", .25), ("G", .5), ("B", 1))),
      "the sky shows instead")
bright = picture("bright", {"any_hit": "return hit.shadow ? relume_ignore() : relume_go_on();"},
                 channels=["R", "G", "B", *SHADOW])
check(all(bright.at(c, x, y) == 1 for x, y in shaded for c in SHADOW), "shadow rays pass")
check(
    differing(picture("accept", {"any_hit": "return relume_go_on();"}), plain) == 0,
    "accepting every hit leaves the picture unchanged")
mirrors = SCRATCH / "mirrors.look.yaml"
mirrors.write_text("surfaces:\n  - { match: { draws: '2' }, reflect: 0.5 }\n")
seen, unseen = (picture(name, functions, "--look", mirrors) for name, functions in (("seen", None), (
    "unseen", {"any_hit": (f"return hit.depth > 0 && hit.draw == {BALL} ? relume_ignore() : relume_go_on();")})))
floor = [(x, y) for y in range(120) for x in range(160) if plain.at("id", x, y) == 2]
changed = sum(seen.at("G", x, y) > unseen.at("G", x, y) + 0.02 for x, y in floor)
check(changed > 25 and differing(seen, unseen) <= len(floor),
      f"the floor no longer mirrors the green ball: {changed} pixels of {len(floor)}")

# Light: all of it; none; and only green, in the scene and in a mirror.
whole, dark, green = (picture(name, {"light": f"return relume_color((float4)({color}, 0.0f));"}, "--look", mirrors)
                      for name, color in (("whole", "1, 1, 1"), ("dark", "0, 0, 0"), ("green", "0, 1, 0")))
check(differing(whole, seen) == 0, "unchanged light leaves the picture unchanged")
check(differing(dark, seen, most=0.1) > PIXELS / 5, "without light it is dark")
check(differing(green, seen, "G") == 0 and differing(green, dark, "RB") == 0, "each colour of the light is independent")
half = picture("half", {"light": "return beam.position.x < 0.0f ? relume_go_on() : relume_color((float4)(0.0f));"})
check(
    differing(half, plain)
    and not any(half.at(c, x, y) != plain.at(c, x, y) for x in range(60) for y in range(120) for c in "RGB"),
    "the left of the picture keeps its light")

# Intersection: a box given by its six planes equals the drawn box; and a sphere is as near as the ball.
traced = picture("traced", {"ray_generation": "return pixel.ray;"}, "--look", mirrors, channels="RGBZ")
CHOSEN = SCRATCH / "chosen.look.yaml"
CHOSEN.write_text(mirrors.read_text() +
                  f"  - match: {{ draws: '{BOX}' }}\n    parameters: [ {{ name: chosen, value: [1] }} ]\n")
PARAMETER = "#pragma relume parameter int chosen = 0\n"
BOUNDS = "return parameters.chosen ? object.box : relume_no_box();"
SLABS = """	const float4 a = (crossing.object.box.lower - crossing.ray.origin) / crossing.ray.direction, b = (crossing.object.box.upper - crossing.ray.origin) / crossing.ray.direction;
	const float4 in_at = min(a, b), out_at = max(a, b);
	const float in = max(in_at.x, max(in_at.y, in_at.z)), out = min(out_at.x, min(out_at.y, out_at.z)), t = in < crossing.least ? out : in;
	const float4 middle = (crossing.ray.origin + t * crossing.ray.direction - 0.5f * (crossing.object.box.lower + crossing.object.box.upper)) /
	                      (crossing.object.box.upper - crossing.object.box.lower), size = fabs(middle);
	const float most = max(size.x, max(size.y, size.z));

	if (in > out || t < crossing.least || t > crossing.most)
		return relume_ignore();
	return relume_surface(t, (float4)(size.x == most ? middle.x : 0.0f, size.y == most ? middle.y : 0.0f, size.z == most ? middle.z : 0.0f, 0.0f));"""
same = picture("slabs", {"bounds": BOUNDS, "intersection": SLABS}, "--look", CHOSEN, parameters=PARAMETER,
               channels="RGBZ")
missing = picture("hollow", {"bounds": BOUNDS, "intersection": "return relume_ignore();"}, "--look", CHOSEN,
                  parameters=PARAMETER, channels="RGBZ")
check(
    differing(same, traced, most=0.01) < PIXELS / 100,
    f"a box given by its planes is that box: {differing(same, traced, most=0.01)} pixels differ")
check(
    differing(same, traced, "Z", most=0.001) < PIXELS / 200,
    f"at the same distance: {differing(same, traced, 'Z', most=0.001)} pixels differ")
gone = differing(missing, traced, most=0.01)
check(gone > sum(plain.at("id", x, y) == BOX for y in range(120) for x in range(160)),
      f"without hits the box is gone, with its shadow and in the mirror: {gone}")
CHOSEN.write_text(CHOSEN.read_text().replace(f"'{BOX}'", f"'{BALL}'"))
CHOSEN.write_text(CHOSEN.read_text().replace("chosen", "sphere"))
ball = picture("ball", None, "--hook", ROOT / "corpus/hooks/sphere.cl", "--look", CHOSEN)
check(
    differing(ball, traced, most=0.03) < PIXELS / 50,
    f"a sphere in place of a ball of many faces: {differing(ball, traced, most=0.03)} pixels differ")

# The reference device compiles the same text.
for name in ("cutout", "distance", "gobo"):
    rules = ROOT / f"corpus/hooks/{name}.look.yaml"
    options = ("--hook", ROOT / f"corpus/hooks/{name}.cl", *(("--look", rules) if rules.exists() else ()))
    pair = [
        picture(f"{name}_{device}", None, *options, "--device", device, channels="RGBZ")
        for device in ("cpu", "reference")
    ]
    check(
        differing(*pair, "RGBZ", most=0.004) < PIXELS / 1000,
        f"{name}: {differing(*pair, 'RGBZ', most=0.004)} pixels differ from the reference device's")

# Invalid hooks.
for name, functions, words in (("lone", {"bounds": "return object.box;"}, "defines bounds without intersection"),
                               ("other", {"intersection": "return relume_ignore();"},
                                "defines intersection without bounds")):
    done = relume("hook", "--check", hook(name, functions))
    check(done.returncode == 3 and words in done.stderr, f"{name}: {done.returncode}, {done.stderr}")
done = relume("hook", "--check", "--device", "reference", hook("member", {"any_hit": "\n\treturn hit.colour;"}))
check(done.returncode == 3 and "member.cl:4:" in done.stderr,
      f"the reference device names the line: {done.returncode}, {done.stderr}")
for example in ("cutout", "gobo", "sphere", "distance", "boxes"):
    done = relume("hook", "--check", ROOT / f"corpus/hooks/{example}.cl")
    check(done.returncode == 0 and "it runs" in done.stdout, f"{example}: {done.stdout}{done.stderr}")
finish()
