"""Run inside Blender: import the .glb files named after "--", and print a line of JSON for each with the imported
objects and the messages."""
import json
import logging
import sys

import bpy
import numpy

if not hasattr(numpy, "bool"):  # Debian 12's Blender 3.4.1 uses an alias that NumPy 1.24 has removed
    numpy.bool = bool

said = []


class Listener(logging.Handler):
    def emit(self, record):
        if record.levelno >= logging.WARNING:
            said.append(record.getMessage())


logging.getLogger().addHandler(Listener())
for name in ("glTFImporter", "io_scene_gltf2"):
    logging.getLogger(name).addHandler(Listener())
for path in sys.argv[sys.argv.index("--") + 1:]:
    said.clear()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    try:
        bpy.ops.import_scene.gltf(filepath=path)
    except RuntimeError as error:
        said.append(str(error))
    meshes = [o.data for o in bpy.data.objects if o.type == "MESH"]
    print(
        "\nIMPORTED " + json.dumps({
            "objects": len(meshes), "triangles": sum(len(p.vertices) - 2
                                                     for m in meshes
                                                     for p in m.polygons), "cameras": sum(o.type == "CAMERA"
                                                                                          for o in bpy.data.objects),
            "lights": sum(o.type == "LIGHT"
                          for o in bpy.data.objects), "images": sum(i.has_data or i.size[0] > 0
                                                                    for i in bpy.data.images), "said": said
        }), flush=True)
