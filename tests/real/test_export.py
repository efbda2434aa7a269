#!/usr/bin/python3
"""relume export: valid glTF 2.0 whose triangles equal those of `relume scene` in eye space, for two kinds of
recordings.
"""
import json
import math
import pathlib
import struct
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from glb import Glb  # noqa: E402
from helpers import BUILD, ROOT, SCRATCH, check, finish, must, record, relume  # noqa: E402

sys.path.insert(0, str(ROOT / "tests/show"))
from edit_trace import Trace  # noqa: E402

COLOR = 7


def expected_eye(scene):
    """Corners of the triangles of each draw that writes colour, in eye space; triangles with two equal corners cover
    nothing and are omitted."""
    found = {}
    for item in scene["instances"]:
        mesh, material = scene["meshes"][item["mesh"]], scene["materials"][item["material"]]
        if mesh["kind"] != "triangles" or not material["color_mask"] & COLOR:
            continue
        m, p = item["modelview"], mesh["position"]
        index = mesh["index"]
        whole = [v for i in range(0, len(index), 3) if len(set(index[i:i + 3])) == 3 for v in index[i:i + 3]]
        for v in whole:
            clip = [sum(m[4 * k + i] * p[4 * v + k] for k in range(4)) for i in range(4)]
            found.setdefault(f"draw {item['draw']}", []).append(tuple(c / clip[3] for c in clip[:3]))
    return found


def same(left, right):
    """The same corners; glTF may choose the first one and the winding."""
    def rows(corners):
        return sorted(sorted(corners[i:i + 3]) for i in range(0, len(corners), 3))
    size = max((abs(c) for corner in right for c in corner), default=0)
    return len(left) == len(right) and all(abs(a - b) <= 1e-5 * size for l, r in zip(rows(left), rows(right))
                                           for p, q in zip(l, r) for a, b in zip(p, q))


for trace, frame in ((ROOT / "tests/golden/cornell.trace", 1), (ROOT / "tests/golden/two_triangles.trace", 1)):
    out = SCRATCH / "new folder" / f"{trace.stem}.glb"
    must(relume("export", trace, "-f", frame, "-o", out))
    scene = json.loads(must(relume("scene", trace, "-f", frame, "--json", "--vertices")).stdout)
    try:
        glb = Glb(out)
    except ValueError as broken:
        check(False, f"{trace.stem}: {broken}")
        continue
    exported, expected = glb.triangles_eye(), expected_eye(scene)
    check(exported.keys() == expected.keys() and expected,
          f"{trace.stem}: draws {exported.keys()} of {expected.keys()}")
    check(all(same(exported.get(name, []), corners) for name, corners in expected.items()),
          f"{trace.stem}: triangles in eye space")
    lit = {
        light for m in scene["materials"] if m["lighting"]
        for light in range(m["light_first"], m["light_first"] + m["light_count"])
    }
    lights = glb.json.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    check(bool(lights) == bool(lit) and len(lights) <= len(lit), f"{trace.stem}: {len(lights)} lights of {len(lit)}")
    check(len(glb.json.get("cameras", [])) >= 1, f"{trace.stem}: a camera")
    # Candela: a white surface at the origin, facing the light, has the luminance of the light's colour, 683 cd/m^2 for
    # 1.
    corners = [corner for triangles in exported.values() for corner in triangles]
    for node in (n for n in glb.json["nodes"] if "KHR_lights_punctual" in n.get("extensions", {})):
        light = lights[node["extensions"]["KHR_lights_punctual"]["light"]]
        places = [min(c[k] for c in corners) + max(c[k] for c in corners) for k in range(3)]
        d2 = sum((node["matrix"][12 + k] - places[k] / 2) ** 2 for k in range(3))
        source = next(l for l in scene["lights"] if all(
            abs(l["position_eye"][k] - node["matrix"][12 + k]) < 1e-3 for k in range(3)))
        most = max(source["diffuse"][:3])
        want = 683 * (most / 12.92 if most <= 0.04045 else ((most + 0.055) / 1.055) ** 2.4)
        want /= sum(a * math.sqrt(d2) ** k for k, a in enumerate(source["attenuation"]))
        got = light["intensity"] / d2 / math.pi
        check(light["type"] == "point" and abs(got - want) < 0.01 * want,
              f"{trace.stem}: luminance {got}, expected {want}")


def turns(corners):
    """Triangles as sets of corners with their winding."""
    triangles = [[tuple(round(c, 4) for c in corner) for corner in corners[i:i + 3]] for i in range(0, len(corners), 3)]
    return sorted(min(t[k:] + t[:k] for k in range(3)) for t in triangles)


# A rotation must not mirror: 60 degrees about y, where the diagonal of the matrix alone has another sign.
turned = Trace(ROOT / "tests/golden/two_triangles.trace")
for rotate in turned.find("glRotatef"):
    for at, value in ((0, 60.0), (2, 1.0), (3, 0.0)):
        turned.change(rotate[at], value)
turned.save(SCRATCH / "turned.trace")
must(relume("export", SCRATCH / "turned.trace", "-f", 1, "-o", SCRATCH / "turned.glb"))
exported = Glb(SCRATCH / "turned.glb").triangles_eye()
expected = expected_eye(
    json.loads(must(relume("scene", SCRATCH / "turned.trace", "-f", 1, "--json", "--vertices")).stdout))
check(expected and all(turns(exported[name]) == turns(corners) for name, corners in expected.items()),
      f"winding of rotated triangles: {exported} {expected}")

done = relume("export", ROOT / "tests/golden/cornell.trace", "-f", 99999, "-o", SCRATCH / "none.glb")
check(done.returncode == 2 and "no frame 99999" in done.stderr,
      f"a missing frame: {done.returncode} {done.stderr}")
check(not list(SCRATCH.glob("none*")), "a failed export leaves nothing")

# Several textures: the one with colours is exported; the messages, and the file names.
units = SCRATCH / "units.trace"
record(units, BUILD / "tests/real/units", options=())
for frame, wanted in ((0, (4, 4)), (1, (4, 4)), (2, None)):
    file = SCRATCH / f"units{frame}.glb"
    done = must(relume("export", units, "-f", frame, "-o", file))
    glb = Glb(file)
    sizes = [
        struct.unpack_from(">II", glb.bin, glb.json["bufferViews"][image["bufferView"]]["byteOffset"] + 16)
        for image in glb.json.get("images", [])
    ]
    check(sizes == ([wanted] if wanted else []), f"frame {frame}: the texture of {wanted} texels: {sizes}")
    check(f"{file}: frame {frame}, " in done.stderr and "MiB" in done.stderr,
          f"the files written are listed: {done.stderr}")
done = relume("export", units, "-o", SCRATCH / "units.obj")
check(done.returncode == 2 and ".glb" in done.stderr and not (SCRATCH / "units.obj").exists(),
      f"an unknown file ending: {done.returncode} {done.stderr}")
finish()
