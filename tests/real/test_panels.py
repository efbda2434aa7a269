#!/usr/bin/python3
# limit: 300 s
"""
The modes, functions, operands and terms of the specification's chapters, a panel each, are drawn as Mesa draws them: tests/real/panels/.
Not among them: the colour maps of glDrawPixels (those of glTexImage2D are), and zooms of glCopyPixels that put a pixel's centre on an edge
between two.
"""
from helpers import check_alone, check_same_pictures, finish

PROGRAMS = {
    "light": ("attenuation", "spots", "terms", "shininess", "sides", "normals", "many lights", "flat shading"),
    "fog": ("modes", "colours", "lit", "points, lines, rectangles"),
    "texture": ("environments", "combiner functions", "combiner operands", "generated coordinates"),
    "fragment": ("blend factors", "more blend factors", "blend equations", "tests", "stencil", "stencil of two sides", "user planes"),
    "pixel": ("formats", "packed types", "storage", "transfer", "indices", "zoom", "depths and stencils", "what rectangles go through",
              "transfer to textures", "indices to textures"),
    "program": ("instructions", "bindings", "textures", "fragments"),
    "vertex_program": ("instructions", "bindings", "addresses", "results", "attributes", "uses", "extremes"),
    "shader": ("functions", "statements", "state", "textures", "vertices", "scenes", "several buffers"),
}

for name, frames in PROGRAMS.items():
    trace, _ = check_same_pictures(f"panels/{name}", frames)
    if "program" in name or name == "shader": # objects are in the index
        check_alone(trace, 1, 3)
finish()
