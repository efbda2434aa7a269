#!/usr/bin/python3
# limit: 300 s
"""Hooks: a user's functions at stages of the tracer, on real OpenCL; and the messages for wrong ones."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import exr  # noqa: E402
from helpers import ROOT, SCRATCH, check, finish, must, relume  # noqa: E402

CORNELL = ROOT / "tests/golden/cornell.trace"
MIRRORS = SCRATCH / "mirrors.look.yaml"
MIRRORS.write_text("surfaces:\n  - { match: { lit: yes }, reflect: 0.3 }\n")
CLOSEST = "struct relume_request closest_hit(struct relume_hit hit, struct relume_parameters parameters)\n{\n%s\n}\n"
RAY = "struct relume_ray ray_generation(struct relume_pixel pixel, struct relume_parameters parameters)\n{\n%s\n}\n"
MISS = "struct relume_request miss(struct relume_miss missed, struct relume_parameters parameters)\n{\n%s\n}\n"


def hook(name, text):
    path = SCRATCH / f"{name}.cl"
    path.write_text(text)
    return path


def picture(name, *options, wanted=("R", "G", "B")):
    """Rendered with a hook; channels only if requested."""
    must(relume("render", CORNELL, "-f", 1, "-o", SCRATCH / f"{name}.####.exr", *options, timeout=280))
    return exr.Image(SCRATCH / f"{name}.0001.exr", wanted) if wanted else None


def same(name, other):
    """Whether all numbers of all channels are equal."""
    a, b = (exr.Image(SCRATCH / f"{n}.0001.exr") for n in (name, other))
    return a.names == b.names and all(a.planes[name] == b.planes[name] for name in a.names)


def differing(a, b, channels="RGB", most=0.0):
    """Share of pixels with a channel that differs by more than `most`."""
    places = [(x, y) for y in range(0, a.height, 3) for x in range(0, a.width, 3)]
    return sum(any(abs(a.at(c, x, y) - b.at(c, x, y)) > most for c in channels) for x, y in places) / len(places)


ALBEDO = ("albedo.R", "albedo.G", "albedo.B")
plain = picture("plain", wanted=("R", "G", "B", "gl.R", "gl.G", "gl.B", "Z", "id", *ALBEDO))

# A hook that returns the built-in's colour.
repeat = ROOT / "corpus/hooks/repeat.cl"
for name, options in (("repeat", ()), ("mirrors", ("--look", MIRRORS)), ("path", ("--mode", "path", "--aov", "gl"))):
    picture(name, *options, wanted=None)
    picture(f"{name}_hook", *options, "--hook", repeat, wanted=None)
    check(same(name, f"{name}_hook"), f"{name}: every channel is the same")
check(not same("mirrors", "repeat"), "different pictures are noticed")

# Colours, parameters of a frame and of a draw, rays, and missing surfaces.
tint = hook(
    "tint",
    "#pragma relume parameter color tint = 0 1 0\n" + CLOSEST % "\treturn relume_color(hit.color * parameters.tint);")
green = picture("green", "--hook", tint, wanted=list(plain.planes))
middle = plain.width // 3, plain.height // 2
check(
    green.at("R", *middle) == 0 and green.at("G", *middle) == plain.at("G", *middle),
    "a closest hit's colour is the pixel's")
check(differing(plain, green, ("gl.R", "gl.G", "gl.B", "Z", "id")) == 0, "gl.* and Z are unchanged")
look = SCRATCH / "tint.look.yaml"
draw = int(plain.at("id", *middle))
look.write_text(
    f"parameters:\n  - {{ name: tint, value: [0, 0, 1] }}\nsurfaces:\n  - match: {{ draws: '{draw}' }}\n    "
    f"parameters:\n"
    "      - { name: tint, value: [1, 0, 0] }\n")
red = picture("red", "--hook", tint, "--look", look)
others = [(x, y)
          for y in range(0, plain.height, 7)
          for x in range(0, plain.width, 7)
          if plain.at("id", x, y) not in (0, draw)]
check(red.at("R", *middle) == plain.at("R", *middle) and red.at("G", *middle) == 0, "a rule sets a draw's parameter")
ROUNDING = 1e-5 # beauty is the sum of 16-bit channels
check(
    others and all(abs(red.at("G", x, y)) < ROUNDING and red.at("B", x, y) > 10 * ROUNDING for x, y in others),
    f"the frame's parameter applies to {len(others)} other pixels: a mirror shows that draw beside its own dark blue")
look.write_text("parameters:\n  - { name: taint, value: [0, 0, 1] }\n")
done = relume("render", CORNELL, "-f", 1, "-o", SCRATCH / "x.####.exr", "--hook", tint, "--look", look)
check(done.returncode != 0 and "no parameter taint" in done.stderr, f"an unknown parameter: {done.stderr}")
sky = hook("sky",
           CLOSEST % "\treturn relume_ignore();" + MISS % "\treturn relume_color((float4)(0.25f, 0.5f, 1.0f, 0.0f));")
nothing = picture("nothing", "--hook", sky, "--encoding", "display")
check(all(nothing.at(c, *middle) == v for c, v in (("R", .25), ("G", .5), ("B", 1))),
      "no surface: the ray continues, and misses")
mirror = hook(
    "mirror", CLOSEST %
    ("\tif (hit.depth > 0)\n\t\treturn relume_go_on();\n\treturn relume_color_and_ray((float4)(0.0f), hit.direction - "
     "2.0f * "
     "dot(hit.direction, hit.normal) * hit.normal, (float4)(1.0f));"))
check(differing(plain, picture("mirror", "--hook", mirror)) > 0.3, "a ray sent by a hook hits other surfaces")
lit = hook(
    "lit", CLOSEST %
    ("\tfloat4 sum = (float4)(0.0f);\n\n\tfor (uint i = 0; i < relume_lights(&hit); i++)\n\t\tsum += "
     "relume_light(&hit, i).arrives;\n"
     "\treturn relume_color(sum * relume_albedo(&hit));"))
check(differing(plain, picture("lit", "--hook", lit)) > 0.3, "lights and albedo can be requested")

# Ray generation: the program's own camera rays give the same picture as the built-in camera, except at edges.
own = hook("own", RAY % "\treturn pixel.ray;")
traced = picture("traced", "--hook", own, wanted=("R", "G", "B", "Z", *ALBEDO))
check(
    differing(plain, traced, most=0.02) < 0.04,
    f"the same rays: {differing(plain, traced, most=0.02):.3f} of the pixels differ")
check(differing(plain, traced, "Z", most=0.02 * abs(plain.at("Z", *middle))) < 0.04, "and their distances")
check(differing(plain, traced, ALBEDO, most=0.02) < 0.04, "and the surfaces' albedo")
fisheye = picture("fisheye", "--hook", ROOT / "corpus/hooks/fisheye.cl")
check(all(fisheye.at(c, 0, 0) == 0 for c in "RGB"), "nothing beyond a fisheye's disk")
lens = picture("lens", "--hook", ROOT / "corpus/hooks/thin_lens.cl", "--samples", 2)
check(differing(plain, lens) > 0.2, "a lens blurs")

# Invalid hooks.
for options, words in ((("--mode", "gl", "--hook", own), "mode gl has no stage"), (("--mode", "diffuse", "--hook", own),
                                                                                   "mode diffuse has no stage")):
    done = relume("render", CORNELL, "-f", 1, "-o", SCRATCH / "x.####.exr", *options)
    check(done.returncode == 2 and words in done.stderr, f"{words}: {done.returncode}, {done.stderr}")
for example in ("toon", "car_paint"):
    done = relume("hook", "--check", ROOT / f"corpus/hooks/{example}.cl")
    check(done.returncode == 0 and "it runs" in done.stdout, f"{example}: {done.stdout}{done.stderr}")
for name, text, words in (("member", "\n" + CLOSEST % "\treturn relume_color(hit.colour);",
                           "member.cl:4:"), ("none", "float f(void) { return 1; }\n", "defines none"),
                          ("type", "/*\n*/\n#pragma relume parameter vector v = 1\n" + CLOSEST % "",
                           "line 3: there is no type vector"),
                          ("few", "#pragma relume parameter color v = 1 2\n" + CLOSEST % "",
                           "line 1: parameter v takes 3 numbers")):
    done = relume("hook", "--check", hook(name, text))
    check(done.returncode == 3 and words in done.stderr, f"{name}: {done.returncode}, {done.stderr}")
done = relume("render", CORNELL, "-f", 1, "-o", SCRATCH / "x.####.exr", "--hook", SCRATCH / "member.cl")
check(done.returncode != 0 and "member.cl:4:" in done.stderr and not (SCRATCH / "x.0001.exr").exists(),
      f"it does not render either: {done.stderr}")
endless = hook("endless",
               CLOSEST % "\tvolatile int i = 0;\n\n\twhile (i >= 0)\n\t\ti = (i + 1) % 7;\n\treturn relume_go_on();")
done = relume("hook", "--check", "--seconds", 15, endless)
check(done.returncode == 3 and "endless loop" in done.stderr, f"an endless loop: {done.returncode}, {done.stderr}")
finish()
