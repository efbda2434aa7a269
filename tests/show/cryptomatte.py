#!/usr/bin/python3
"""tests/show/cryptomatte.py BUILD (as `make show-cryptomatte`): mattes that Blender's compositor extracts from our
frames, compared with channel id.

Two programs are recorded and rendered with --aov cryptomatte. Blender's Cryptomatte node extracts each object of the
three manifests by its name. A draw's matte must be 1 where channel id has its number and 0 elsewhere. The matte of a
mesh or texture must be 1 where `relume scene` lists draws that use it.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy
from display import need_display
from exr_numpy import Image

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAMS = {"still life": "still_life", "spheres": "spheres"}
SIZE = "160x120"


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, errors="replace",
                          check=False)
    if done.returncode:
        sys.exit(f"{command[0]} exits with {done.returncode}:\n{done.stdout[-1500:]}{done.stderr[-1500:]}")
    return done.stdout


def manifests(image):
    """{layer: [names]}"""
    text = {key: value[1].decode() for key, value in image.header.items() if key.startswith("cryptomatte/")}
    return {
        text[key]: list(json.loads(text[key.replace("/name", "/manifest")])) for key in text if key.endswith("/name")
    }


def draws_of(scene, layer, name):
    """The numbers in channel id of the draws that belong to an object."""
    def of(instance):
        material = scene["materials"][instance["material"]]
        if layer == "CryptoMesh":
            return scene["meshes"][instance["mesh"]]["hash"]
        return scene["textures"][scene["units"][material["unit_first"]]
                                 ["texture"]]["hash"] if material["unit_count"] else "untextured"
    if layer == "CryptoDraw":
        return {int(name.split()[1])}
    first = [instance["draw"] for instance in scene["instances"]] + [scene["n_draws"] + 1]
    return {
        draw for i, instance in enumerate(scene["instances"]) if of(instance) == name
        for draw in range(first[i], first[i + 1])
    }


def compare(build, program):
    """[(layer, objects, pixels that differ)], Blender's version"""
    with tempfile.TemporaryDirectory(prefix="relume-") as scratch:
        folder = pathlib.Path(scratch)
        trace, frame, wanted = folder / "x.trace", folder / "x.exr", folder / "wanted.json"
        run(build / "relume", "record", "-o", trace, "--", build / "corpus" / program, "--frames", "2", "--size", SIZE)
        run(build / "relume", "render", trace, "-f", "1", "-o", frame, "--mode", "gl", "--aov", "gl,id,cryptomatte")
        scene = json.loads(run(build / "relume", "scene", "--json", "-f", "1", trace))
        image = Image(frame)
        names = manifests(image)
        wanted.write_text(json.dumps(names))
        said = run("blender", "--background", "--factory-startup", "--python",
                   ROOT / "tests/show/cryptomatte_in_blender.py", "--", frame, wanted, folder / "mattes")
        report = re.search(r"^MATTES (.*)$", said, re.MULTILINE)
        if not report:
            sys.exit(f"Blender made no mattes:\n{said[-1500:]}")
        rows = []
        for layer, objects in names.items():
            wrong = 0
            for i, name in enumerate(objects):
                planes = Image(folder / f"mattes/{layer}.{i}.exr").planes
                matte = planes[next(iter(planes))]
                truth = numpy.isin(image.planes["id"], list(draws_of(scene, layer, name)))
                if not truth.any():
                    sys.exit(f"{program}: no pixel shows {name} of {layer}, although the manifest lists it")
                wrong += int((matte != truth).sum())
            rows.append((layer, len(objects), wrong))
        return rows, json.loads(report.group(1))["version"]


def main(build):
    need_display()
    build, rows, good = build.resolve(), [], True
    print(f"{'program, layer':32}{'objects':>9}{'pixels that differ':>20}")
    for name, program in PROGRAMS.items():
        found, version = compare(build, program)
        for layer, objects, wrong in found:
            print(f"{name + ', ' + layer:32}{objects:9}{wrong:20}", flush=True)
            good &= wrong == 0
            rows.append({
                "what": f"{name}, {layer}: pixels of {objects} mattes that differ from the frame", "figure": wrong,
                "bar": 0, "peer": f"Blender {version}", "passed": wrong == 0
            })
    out = build / "show" / "cryptomatte.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(
        json.dumps({"name": "cryptomatte", "command": "make show-cryptomatte", "rows": rows}, indent=1) + "\n")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
