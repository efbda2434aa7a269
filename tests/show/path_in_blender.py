"""Run inside Blender: import a .glb, give it OpenGL's lighting, and render it with Cycles at several sample counts.

Arguments after --: the file, the same frame as printed by `relume scene --json`, the prefix of the pictures' names, the
sample counts. Prints the processor seconds of each.
"""
import json
import math
import sys
import time

import bpy
import mathutils
import numpy

if not hasattr(numpy, "bool"):  # Debian 12's Blender 3.4.1 uses an alias that NumPy 1.24 has removed
    numpy.bool = bool

path, told, out, *counts = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=path)
scene = bpy.context.scene
with open(told, encoding="utf-8") as file:
    told = json.load(file)


def linear(display):
    return display / 12.92 if display <= 0.04045 else ((display + 0.055) / 1.055) ** 2.4


def light_at(place):
    """The OpenGL light nearest to a place in Blender's coordinates, where z is up."""
    return min(
        told["lights"], key=lambda l: (mathutils.Vector(
            (l["position_eye"][0], -l["position_eye"][2], l["position_eye"][1])) - place).length)


def light_nodes(tree, strong):
    """Nodes for a light's emission: its colour attenuated with distance as in OpenGL, the product in sRGB codes. The
    Blender light itself is white."""
    def math_node(operation, *inputs):
        made = tree.nodes.new("ShaderNodeMath")
        made.operation = operation
        for socket, value in zip(made.inputs, inputs):
            if isinstance(value, (int, float)):
                socket.default_value = value
            else:
                tree.links.new(value, socket)
        return made.outputs[0]
    constant, linearly, squared = strong["attenuation"]
    distance, together = tree.nodes.new("ShaderNodeLightPath").outputs["Ray Length"], tree.nodes.new(
        "ShaderNodeCombineRGB")
    sums = math_node("MULTIPLY_ADD", math_node("MULTIPLY_ADD", distance, squared, linearly), distance, constant)
    for color, channel in zip(strong["diffuse"],
                              together.inputs):  # the upper segment of sRGB's curve, which covers all of these lights
        shown = math_node("ADD", math_node("DIVIDE", color / 1.055, sums), 0.055 / 1.055)
        tree.links.new(math_node("POWER", shown, 2.4), channel)
    return together.outputs[0]


world = bpy.data.worlds.new("cleared")
world.use_nodes = True
world.node_tree.nodes["Background"].inputs["Color"].default_value = [
    *(linear(c) for c in told["clears"][0]["color"][:3]), 1
]
scene.world = world
for item in [o for o in bpy.data.objects if o.type == "LIGHT"]:
    light, strong = item.data, light_at(item.matrix_world.translation)
    if light.type in ("POINT", "SPOT"):
        light.shadow_soft_size = 0
        light.use_nodes = True
        nodes = light.node_tree.nodes
        falloff = nodes.new("ShaderNodeLightFalloff")
        falloff.inputs["Strength"].default_value = 1
        light.node_tree.links.new(falloff.outputs["Constant"], nodes["Emission"].inputs["Strength"])
        light.node_tree.links.new(light_nodes(light.node_tree, strong), nodes["Emission"].inputs["Color"])
        light.color, light.energy = (1, 1, 1), 4 * math.pi**2  # a white surface that faces the light shows its colour
        if light.type == "SPOT":
            light.spot_blend = 0
for material in bpy.data.materials:
    # OpenGL's surfaces are Lambertian, unlike the principled shader; mirrors, glass and blended surfaces keep that
    # shader
    nodes, links = material.node_tree.nodes, material.node_tree.links
    node = next((n for n in nodes if n.type == "BSDF_PRINCIPLED"), None)
    if not node or any(node.inputs[name].is_linked or node.inputs[name].default_value != value
                       for name, value in (("Metallic", 0), ("Transmission", 0), ("Alpha", 1))):
        continue
    matte, color = nodes.new("ShaderNodeBsdfDiffuse"), node.inputs["Base Color"]
    matte.inputs["Color"].default_value = color.default_value
    if color.is_linked:
        links.new(color.links[0].from_socket, matte.inputs["Color"])
    for link in list(node.outputs["BSDF"].links):
        links.new(matte.outputs["BSDF"], link.to_socket)
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
scene.cycles.max_bounces = scene.cycles.diffuse_bounces = scene.cycles.glossy_bounces = scene.cycles.transmission_bounces = 4
scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0
scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 1
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = told["width"], told[
    "height"], 100
scene.render.use_persistent_data = True
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.image_settings.exr_codec = "ZIPS"
scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA")
scene.cycles.samples = 1
bpy.ops.render.render()
seconds = {}
for count in counts:
    scene.cycles.samples, scene.render.filepath = int(count), f"{out}.{count}.exr"
    begin = time.process_time()
    bpy.ops.render.render(write_still=True)
    seconds[count] = time.process_time() - begin
print("\nRENDERED " + json.dumps({"seconds": seconds, "version": bpy.app.version_string}), flush=True)
