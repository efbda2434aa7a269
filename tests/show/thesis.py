#!/usr/bin/python3
"""tests/show/thesis.py BUILD (as `make show-thesis`): five scenes at 800 x 600, compared with the figures of a thesis
and with two renderers.

The scenes are those of a 2016 thesis on ray tracing for OpenGL programs: a Cornell box of 34 triangles; with a model of
100,000; the same with a mirror wall; with a box of glass; a columned hall of 262,267 triangles. The thesis gives frames
per second on a GTX 970 (and an Iris 6100); ours are from this machine, so the two are only shown side by side.

POV-Ray and Blender Cycles (1 sample per pixel, 4 bounces) render the same frame, exported by `relume export`. All three
run in turn on the same cores, and the ratios are theirs to ours. Two times are compared: the whole frame (decoding or
reading, building, tracing, writing), and tracing alone. For us, tracing is the time of tracer_render, including trees;
for POV-Ray it is its own "Trace Time". Cycles does not separate them: both are its render call, the second of two, with
data kept.
"""
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

from display import need_display

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/real"))
from glb import Glb  # noqa: E402

SCENES = {  # name: program, options, the thesis' frames per second on a GTX 970 and an Iris 6100
    "Cornell box": ("cornell", [], 264.19, 98.41),
    "box and mesh": ("cornell", ["--mesh"], 39.12, 23.86),
    "box and mesh, mirror": ("cornell", ["--mesh", "--mirror"], 33.93, 22.83),
    "box and mesh, glass": ("cornell", ["--mesh", "--glass"], 31.50, 16.41),
    "hall": ("hall", [], 11.01, 5.34),
}
FRAMES = 5
SHOWN = 2
ROUNDS = 3  # figures are their medians
BAR = 15  # minimum ratios to POV-Ray (whole frame) and to Cycles


def run(command, **more):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, errors="replace",
                          check=False, **more)
    if done.returncode:
        sys.exit(f"{command[0]} exits with {done.returncode}:\n{done.stdout[-1500:]}{done.stderr[-1500:]}")
    return done


def ours(build, trace, folder):
    """Frames per second: whole frames, and the tracer alone."""
    command = [
        build / "relume", "render", trace, "-o", folder / "####.exr", "-f", f"0-{FRAMES - 1}", "--progress", "json"
    ]
    run(command)  # compile the kernels before measuring
    begin = time.monotonic()
    run(command)
    whole = FRAMES / (time.monotonic() - begin)
    lines = run([*command, "--jobs", "1"]).stdout
    seconds = sorted(told["seconds"] for told in map(json.loads, lines.splitlines()) if told["event"] == "frame")
    if len(seconds) != FRAMES:
        sys.exit(f"{len(seconds)} of {FRAMES} frames reported their time:\n{lines}")
    return whole, 1 / seconds[FRAMES // 2]


# --- POV-Ray ---------------------------------------------------------------------------------------------------------

def transformed(m, p, w):
    return [m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k] * w for k in range(3)]


def vectors(rows):
    return f"{len(rows)}," + ",".join("<" + ",".join(f"{v:.7g}" for v in row) + ">" for row in rows)


def pov_mesh(glb, node, primitive, out):
    m, attributes = node["matrix"], primitive["attributes"]
    positions = [transformed(m, p, 1) for p in glb.values(attributes["POSITION"])]
    normals = [transformed(m, n, 0) for n in glb.values(attributes["NORMAL"])]
    index = [row[0] for row in glb.values(primitive["indices"])]
    material = glb.json["materials"][primitive["material"]]
    pbr, more = material["pbrMetallicRoughness"], material.get("extensions", {})
    colors = glb.values(attributes["COLOR_0"]) if "COLOR_0" in attributes else []
    out.write("mesh2 {\nvertex_vectors {" + vectors(positions) + "}\nnormal_vectors {" + vectors(normals) + "}\n")
    through = more.get("KHR_materials_transmission", {}).get("transmissionFactor", 0)
    base = pbr["baseColorFactor"]
    faces = [index[i:i + 3] for i in range(0, len(index), 3)]
    named = sorted({tuple(c[:3]) for c in colors})
    if named:  # faces have the colours of their first vertices
        out.write(f"texture_list {{{len(named)}," +
                  ",".join(f"texture {{pigment {{rgb <{c[0]:.5g},{c[1]:.5g},{c[2]:.5g}> transmit {through:.5g}}}}}"
                           for c in named) + "}\n")
        number = {c: i for i, c in enumerate(named)}
        out.write(f"face_indices {{{len(faces)}," + ",".join(
            f"<{a},{b},{c}>,{number[tuple(colors[a][:3])]}" for a, b, c in faces) + "}\n")
    else:
        out.write(f"face_indices {{{len(faces)}," + ",".join(f"<{a},{b},{c}>" for a, b, c in faces) + "}\n")
        out.write(f"pigment {{rgb <{base[0]:.5g},{base[1]:.5g},{base[2]:.5g}> transmit {through:.5g}}}\n")
    out.write(f"finish {{ambient 0.1 diffuse 0.8 reflection {{{pbr.get('metallicFactor', 0) * 0.9:.5g}}}}}\n")
    if through:
        out.write(
            f"finish {{reflection {{0, 1 fresnel on}} conserve_energy}} interior "
            f"{{ior {more['KHR_materials_ior']['ior']:.5g}}}\n"
        )
    out.write("}\n")


def write_pov(glb, path):
    """The frame as a POV-Ray scene in eye space, without textures, which spares POV-Ray the look-ups."""
    with open(path, "w", encoding="ascii") as out:
        out.write("#version 3.7;\nglobal_settings {assumed_gamma 1 max_trace_level 5}\n")
        camera = glb.json["cameras"][0]["perspective"]
        out.write(f"camera {{perspective location 0 direction -z right x*{camera['aspectRatio']:.6g} up y "
                  f"angle {math.degrees(2 * math.atan(math.tan(camera['yfov'] / 2) * camera['aspectRatio'])):.6g}}}\n")
        for node in glb.json["nodes"]:
            if "extensions" in node:
                m = node["matrix"]
                out.write(f"light_source {{<{m[12]:.6g},{m[13]:.6g},{m[14]:.6g}> rgb 1}}\n")
            if "mesh" in node:
                pov_mesh(glb, node, glb.json["meshes"][node["mesh"]]["primitives"][0], out)


def povray(glb, folder):
    write_pov(glb, folder / "scene.pov")
    begin = time.monotonic()
    said = run(
        ["povray", f"+I{folder}/scene.pov", f"+O{folder}/pov.png", "+W800", "+H600", "-A", "-D", "-GD", "+GR",
         "+GS"]).stderr
    whole = time.monotonic() - begin
    found = re.findall(r"Trace Time:.*\(([0-9.]+) seconds\)", said)
    if not found:
        sys.exit(f"POV-Ray does not report its trace time:\n{said[-1500:]}")
    return 1 / whole, 1 / max(float(found[-1]), 1e-3)


def blender(file, folder):
    said = run([
        "blender", "--background", "--factory-startup", "--python", ROOT / "tests/show/thesis_in_blender.py", "--",
        file, folder / "cycles.exr"
    ]).stdout
    found = re.search(r"^RENDERED (.*)$", said, re.MULTILINE)
    if not found:
        sys.exit(f"Blender did not render:\n{said[-1500:]}")
    told = json.loads(found.group(1))
    return 1 / told["seconds"][-1], told["version"]


def main(build):
    need_display()
    build = build.resolve()
    rows = []
    print(
        f"{'frames/s at 800 x 600':24}{'whole':>8}{'traced':>8}   {'GTX 970':>8}{'Iris':>8}   "
        f"{'POV whole':>10}{'traced':>8}"
        f"{'Cycles':>8}   ratios: POV whole, traced; Cycles")
    for name, (program, options, gtx, iris) in SCENES.items():
        with tempfile.TemporaryDirectory(prefix="relume-") as scratch:
            folder = pathlib.Path(scratch)
            trace, file = folder / "scene.trace", folder / "scene.glb"
            run([
                build / "relume", "record", "-o", trace, "--", build / "corpus" / program, "--frames", FRAMES,
                "--animate", "camera", *options
            ])
            run([build / "relume", "export", "-f", SHOWN, "-o", file, trace])
            rounds = [(*ours(build, trace, folder), *povray(Glb(file), folder), *blender(file, folder))
                      for _ in range(ROUNDS)]
            whole, traced, pov_whole, pov_traced, cycles = (statistics.median(column)
                                                            for column in list(zip(*rounds))[:5])
            version = rounds[0][5]
            keep = build / "show" / "thesis"
            keep.mkdir(parents=True, exist_ok=True)
            for kept, what in ((folder / f"{SHOWN:04d}.exr", "relume.exr"), (folder / "pov.png", "povray.png"),
                               (folder / "cycles.exr", "cycles.exr")):
                (keep / f"{name.replace(' ', '_').replace(',', '')}.{what}").write_bytes(kept.read_bytes())
        passed = whole / pov_whole >= BAR and traced / cycles >= BAR
        print(
            f"{name:24}{whole:8.2f}{traced:8.2f}   {gtx:8.2f}{iris:8.2f}   "
            f"{pov_whole:10.2f}{pov_traced:8.2f}{cycles:8.2f}   "
            f"{whole / pov_whole:.1f}x, {traced / pov_traced:.1f}x; {traced / cycles:.1f}x  "
            f"{'holds' if passed else 'FAILS'}",
            flush=True)
        rows.append({
            "what": f"{name}: ratio to POV-Ray (whole), ratio to Cycles",
            "figure": f"{whole / pov_whole:.1f}, {traced / cycles:.1f}", "bar": f"at least {BAR}",
            "peer": f"ours {whole:.2f}, {traced:.2f}; thesis {gtx} (GTX 970), {iris} (Iris 6100); POV-Ray "
                    f"{pov_whole:.2f}, {pov_traced:.2f}; "
            f"Cycles {version} {cycles:.2f}", "passed": passed
        })
    out = build / "show" / "thesis.json"
    out.write_text(json.dumps({"name": "thesis", "command": "make show-thesis", "rows": rows}, indent=1) + "\n")
    return 0 if all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
