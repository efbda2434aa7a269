"""Run inside Blender: import a .glb, render it twice with Cycles at 1 sample; prints the seconds of the second time."""
import json
import sys
import time

import bpy
import numpy

if not hasattr(numpy, "bool"):  # Debian 12's Blender 3.4.1 uses an alias that NumPy 1.24 has removed
    numpy.bool = bool

path, out = sys.argv[sys.argv.index("--") + 1:][:2]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=path)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = 1
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
scene.cycles.max_bounces = 4
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 800, 600, 100
scene.render.use_persistent_data = True
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.filepath = out
scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA")
seconds = []
for _ in range(2):
    begin = time.monotonic()
    bpy.ops.render.render(write_still=True)
    seconds.append(time.monotonic() - begin)
print("\nRENDERED " + json.dumps({"seconds": seconds, "version": bpy.app.version_string}), flush=True)
