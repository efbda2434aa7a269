#!/usr/bin/python3
"""tests/show/export.py BUILD: frames exported as glTF and imported by Blender, which must find everything and print no
warning.

The recordings are those in tests/golden, and those in ../shared/traces if that folder exists.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/real"))
from glb import Glb  # noqa: E402

FRAME = "5"


def in_blender(files):
    done = subprocess.run([
        "blender", "--background", "--factory-startup", "--python", ROOT / "tests/show/export_in_blender.py", "--",
        *files
    ], capture_output=True, text=True, errors="replace")
    found = [json.loads(line.split(" ", 1)[1]) for line in done.stdout.splitlines() if line.startswith("IMPORTED ")]
    if len(found) != len(files):
        sys.exit(f"Blender imported {len(found)} of {len(files)} files:\n{done.stdout}{done.stderr}")
    return found


def counts(glb):
    """Counts that Blender must report, from the default scene's nodes; it keeps unlit triangles and those without area."""
    nodes = [glb.json["nodes"][n] for n in glb.json["scenes"][glb.json["scene"]]["nodes"]]
    primitives = [glb.json["meshes"][n["mesh"]]["primitives"][0] for n in nodes if "mesh" in n]
    return {"objects": len(primitives), "cameras": sum("camera" in n for n in nodes),
            "lights": sum("extensions" in n for n in nodes),
            "triangles": sum(glb.json["accessors"][p["indices"]]["count"] // 3 for p in primitives if p["mode"] == 4)}


def main(build):
    rows, files, whole = [], [], []
    with tempfile.TemporaryDirectory(prefix="relume-") as scratch:
        traces = sorted((ROOT / "tests/golden").glob("*.trace")) + sorted(
            (ROOT.parent / "shared/traces").glob("*.trace"))
        for trace in traces:
            file = pathlib.Path(scratch, f"{trace.stem}.glb")
            frame = "1" if "golden" in trace.parts else FRAME
            subprocess.run([build / "relume", "export", "-f", frame, "-o", file, trace], check=True,
                           stderr=subprocess.DEVNULL)
            files.append(file)
        for file, found in zip(files, in_blender(files)):
            expected = counts(Glb(file))
            said = found.pop("said")
            arrived = all(found[key] == n for key, n in expected.items())
            whole.append(arrived and not said)
            figure = ", ".join(f"{found[key]} of {n} {key}" for key, n in expected.items()) + f", {len(said)} warnings"
            print(f"{file.stem}: {figure}" + "".join(f"\n    {line}" for line in said))
            rows.append(
                {"what": file.stem, "figure": figure, "bar": "all, 0 warnings", "peer": None, "passed": whole[-1]})
    version = subprocess.run(["blender", "--version"], capture_output=True, text=True).stdout.split("\n")[0]
    for row in rows:
        row["peer"] = version
    out = build / "show" / "export.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps({"name": "export", "command": "make show-export", "rows": rows}, indent=1))
    print(f"{sum(whole)} of {len(whole)} files arrive whole and without a warning")
    return 0 if all(whole) else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
