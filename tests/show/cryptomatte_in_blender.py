"""Run inside Blender: mattes of objects by the compositor's Cryptomatte node.

Arguments after --: an OpenEXR file, a JSON file with {layer: [names]}, the folder for the mattes: LAYER.N.exr for the
N-th name.
"""
import json
import pathlib
import shutil
import sys

import bpy
import numpy

if not hasattr(numpy, "bool"):  # Debian 12's Blender 3.4.1 uses an alias that NumPy 1.24 has removed
    numpy.bool = bool

path, wanted, folder = sys.argv[sys.argv.index("--") + 1:]
with open(wanted, encoding="utf-8") as file:
    wanted = json.load(file)
bpy.ops.wm.read_factory_settings(use_empty=True)
scene, image = bpy.context.scene, bpy.data.images.load(path)
scene.use_nodes = True
nodes, links = scene.node_tree.nodes, scene.node_tree.links
nodes.clear()
out = nodes.new("CompositorNodeOutputFile")
out.base_path = folder
out.format.file_format, out.format.color_depth, out.format.exr_codec = "OPEN_EXR", "32", "ZIPS"
out.file_slots.clear()
for layer, names in wanted.items():
    for i, name in enumerate(names):
        node = nodes.new("CompositorNodeCryptomatteV2")
        node.source, node.image, node.layer_name, node.matte_id = "IMAGE", image, layer, name
        out.file_slots.new(f"{layer}.{i}.")
        links.new(node.outputs["Matte"], out.inputs[-1])
shown, end = nodes.new("CompositorNodeImage"), nodes.new("CompositorNodeComposite")
shown.image = image
links.new(shown.outputs[0], end.inputs[0])
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
scene.camera = camera
with open(path, "rb") as file:
    window = file.read(65536)
at = window.index(b"dataWindow\0box2i\0") + 21
x0, y0, x1, y1 = (int.from_bytes(window[at + 4 * k:at + 4 * k + 4], "little", signed=True) for k in range(4))
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = x1 - x0 + 1, y1 - y0 + 1, 100
bpy.ops.render.render()
for file in pathlib.Path(folder).glob("*.*.*.exr"):  # the frame's number follows each name
    layer, i, _ = file.name.split(".", 2)
    shutil.move(file, file.with_name(f"{layer}.{i}.exr"))
print("\nMATTES " + json.dumps({"version": bpy.app.version_string}), flush=True)
