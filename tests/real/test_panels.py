#!/usr/bin/python3
# limit: 400 s
"""The modes, functions, operands and terms of the specification's chapters, one panel each, must be drawn as Mesa draws
them: tests/real/panels/. Not included: the colour maps of glDrawPixels (those of glTexImage2D are). Arguments select
programs by name.
"""
import sys

from helpers import AS_SHOWN, SCRATCH, check, check_alone, check_same_pictures, diff, finish, must, on_display, render

PROGRAMS = {
    "light": ("attenuation", "spots", "terms", "shininess", "sides", "normals", "many lights", "flat shading",
              "short normals"),
    "fog": ("modes", "colours", "lit", "points, lines, rectangles", "distances"),
    "texture": ("environments", "combiner functions", "combiner operands", "generated coordinates", "cube maps"),
    "fragment": ("blend factors", "more blend factors", "blend equations", "tests", "stencil", "stencil of two sides",
                 "user planes", "near plane", "alpha at the reference"),
    "line": ("strips", "kinds", "cut", "shared corners", "unfilled polygons", "edge flags", "short ones", "textured"),
    "compression": ("plain images", "their alpha", "parts", "levels", "alpha of levels", "copies of the screen",
                    "YCbCr"),
    "pixel": ("formats", "packed types", "storage", "transfer", "indices", "zoom", "depths and stencils",
              "copies of these", "later stages", "transfer to textures", "indices to textures",
              "in lists"),
    "point": ("attenuated", ),
    "program": ("instructions", "bindings", "textures", "fragments", "last bits"),
    "ati_shader": ("instructions", "arguments", "destinations", "sources", "textures"),
    "vertex_program": ("instructions", "bindings", "addresses", "results", "attributes", "uses", "extremes"),
    "shader": ("functions", "statements", "state", "textures", "vertices", "places", "scenes", "several buffers"),
}


def check_kernels(trace, number):
    """A frame must equal Mesa's with every family of kernels."""
    for kernels in (("--device", "reference"), ("--kernels", "binary")):
        folder = SCRATCH / kernels[1]
        render(trace, folder, *AS_SHOWN, *kernels, "-f", number)
        _, score = diff(trace, folder, "-f", number)
        check(score["frames"][0]["failing_pixels"] == 0,
              f"frame {number} with {kernels[1]}: {score['frames'][0]['failing_pixels']} pixels fail")


NEEDS = {"YCbCr": "GL_MESA_ycbcr_texture"}  # extensions that Mesa may lack; the frame is then not drawn
extensions = must(on_display("glxinfo")).stdout


def drawn(frames):
    lacking = [what for what in frames if NEEDS.get(what, "") not in extensions]
    for what in lacking:
        print(f"not tested: {what}: this GL lacks {NEEDS[what]}")
    return [what for what in frames if what not in lacking]


OTHER_KERNELS = {"vertex_program": "5",
                 "program": "4"}  # a shader program's frame: depths unlike the projection's, to the last bit

for name in sys.argv[1:] or PROGRAMS:
    trace, _ = check_same_pictures(f"panels/{name}", drawn(PROGRAMS[name]))
    if "program" in name or "shader" in name: # these objects must be in the index
        check_alone(trace, 1, 3)
    if name in OTHER_KERNELS:
        check_kernels(trace, OTHER_KERNELS[name])
finish()
