#!/usr/bin/python3
"""relume pick: its output for a pixel agrees with `scene`, and a rule that it writes changes only that surface."""
import collections
import json

from exr import Image
from helpers import SCRATCH, check, corpus, finish, must, record, relume

MOST = 5 # surfaces per program


def plane(image, name):
    return [value for row in image.planes[name] for value in row]


def surfaces(image, scene):
    """Pixels by the number of the instance visible there."""
    firsts = [instance["draw"] for instance in scene["instances"]]
    found = collections.defaultdict(list)
    for pixel, draw in enumerate(plane(image, "id")):
        if draw:
            found[max(i for i, first in enumerate(firsts) if first <= draw)].append(pixel)
    return found


def check_surface(trace, scene, image, instance, found):
    pixels = found[instance]
    what = f"{trace.stem}, draw {scene['instances'][instance]['draw']}"
    middle = pixels[len(pixels) // 2]
    rule = must(relume("pick", trace, "-f", 1, f"{middle % image.width},{middle // image.width}")).stdout
    mine = scene["instances"][instance]
    material = scene["materials"][mine["material"]]
    textures = [
        scene["textures"][u["texture"]] for u in scene["units"][material["unit_first"]:][:material["unit_count"]]
    ]
    check(f"draw {mine['draw']}: {mine['call']}, call {mine['call_number']}" in rule, f"{what}: its call: {rule}")
    check(f"mesh {scene['meshes'][mine['mesh']]['hash']}: " in rule, f"{what}: its mesh: {rule}")
    check(all(f"texture {t['hash']}: " in rule and f"{t['target']} {t['base_format']}" in rule for t in textures),
          f"{what}: its textures: {rule}")
    check(("lit by" in rule) == bool(material["lighting"]), f"{what}: its material: {rule}")
    mode = material["color_material"] in ("GL_FRONT", "GL_FRONT_AND_BACK") and material["color_material_mode"]
    for part, modes in ("diffuse", ("GL_DIFFUSE", "GL_AMBIENT_AND_DIFFUSE")), ("specular", ("GL_SPECULAR", )):
        check((f"{part} from the vertices" in rule) == bool(material["lighting"] and mode in modes),
              f"{what}: its {part} colour: {rule}")

    file = SCRATCH / "rule.yaml"
    file.write_text(rule)
    said = must(relume("render", trace, "-f", 1, "-o", SCRATCH / "mirror.####.exr", "--look", file,
                       "--no-cache")).stderr
    check("rule 1 matches 1 draw in 1 of 1 frame" in said, f"{what}: matches one draw: {said}{rule}")
    # An emissive surface is brighter by that amount, and no other surface changes.
    file.write_text(rule.replace("reflect: 0.3", "emission: [0, 1, 0]"))
    must(
        relume("render", trace, "-f", 1, "-o", SCRATCH / "shining.####.exr", "--aov", "relight,id", "--look", file,
               "--no-cache"))
    shining = Image(SCRATCH / "shining.0001.exr")
    shines = {
        i for i, (with_it, without) in enumerate(zip(plane(shining, "relight.G"), plane(image, "relight.G")))
        if with_it != without
    }
    blended = {
        pixel for i in found if scene["materials"][scene["instances"][i]["material"]]["blend"] for pixel in found[i]
    }  # these are transparent, and the surface is visible through them
    others = shines - set(pixels) - blended
    check(shines and not others,
          f"{what}: {len(shines)} pixels shine, of {len(pixels)}; {len(others)} belong to other surfaces")
    check(len(shines) > 0.9 * len(pixels), f"{what}: {len(shines)} of its {len(pixels)} pixels shine")
    twins = [
        i for i in scene["instances"] if i["mesh"] == mine["mesh"] and scene["materials"][i["material"]] == material
    ]
    check(("draws: " in rule) == (len(twins) > 1),
          f"{what}: a draw number only if necessary, since it holds for one frame only: {rule}")
    return "draws: " in rule


shared = 0 # rules that need a draw number to match only one surface
for program in ("blocks", "courtyard"):
    trace = SCRATCH / f"{program}.trace"
    record(trace, corpus(program), "--frames", "2", "--size", "160x120", options=())
    must(relume("render", trace, "-f", 1, "-o", SCRATCH / f"{program}.####.exr", "--aov", "relight,id"))
    image = Image(SCRATCH / f"{program}.0001.exr")
    scene = json.loads(must(relume("scene", trace, "--json", "-f", 1)).stdout)
    found = surfaces(image, scene)
    check(found, f"{program}: surfaces are visible")
    for instance in sorted(found, key=lambda i: -len(found[i]))[:MOST]:
        shared += check_surface(trace, scene, image, instance, found)
    text = must(relume("scene", trace, "-f", 1)).stdout
    for instance in scene["instances"]:
        line = next((line for line in text.splitlines() if line.startswith(f"draw {instance['draw']}: ")), "")
        check(f"mesh {scene['meshes'][instance['mesh']]['hash'][:8]}, {instance['call']}" in line,
              f"{program}: scene names meshes by hashes: {line}")
    numbers = [t for t in scene["textures"] if not t["base_format"].startswith("GL_")
               ] + [m for m in scene["materials"] if not m["depth_func"].startswith("GL_")]
    check(not numbers, f"{program}: scene names GL's tokens: {numbers}")

    for pixel, text in ((f"{image.width},0", "is not there"), ("12", "is no pixel"), ("a,b", "is no pixel"),
                        ("1,2,3", "is no pixel")):
        done = relume("pick", trace, "-f", 1, pixel)
        check(done.returncode == 2 and text in done.stderr and not done.stdout,
              f"{pixel}: {done.returncode}, {done.stderr}")
    empty = next((i for i, draw in enumerate(plane(image, "id")) if not draw), None)
    if empty is not None:
        done = relume("pick", trace, "-f", 1, f"{empty % image.width},{empty // image.width}")
        check(done.returncode == 2 and "nothing is drawn" in done.stderr and not done.stdout,
              f"an empty pixel: {done.returncode}, {done.stderr}")
    check(relume("pick", trace, "-f", 7, "0,0").returncode == 2, "a missing frame")

check(shared, "one rule needed a draw number")
finish()
