"""Roles that `relume look` assigns to draws, compared with labels written by hand (tests/look/labels.yaml): precision
and recall per role."""
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import numpy
import programs
import recording
import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SHARED = ROOT.parent / "shared/traces"
PRECISION, RECALL = 0.98, 0.9
# The labels' names for rules' roles; other roles do not classify a draw.
ROLES = {
    **{
        role: role for role in ("sky", "HUD", "particle", "view model", "planar shadow", "stencil mirror", "mirror", "decal", "blob shadow", "lightmap in a second unit", "lightmap pass")
    }, "shadow volume (z-pass)": "shadow volume", "shadow volume (z-fail)": "shadow volume"
}
DST_COLOR, SRC_COLOR, ZERO = "GL_DST_COLOR", "GL_SRC_COLOR", "GL_ZERO"
MAPPED = ("GL_SPHERE_MAP", "GL_REFLECTION_MAP")


def fullness(rows):
    """Volume spanned by the vectors, relative to the largest they could span; by Gaussian elimination."""
    rows, volume, most = [list(r) for r in rows], 1.0, 1.0
    for r in rows:
        most *= sum(x * x for x in r) ** 0.5
    for i in range(len(rows)):
        pivot = max(range(i, len(rows)), key=lambda k: abs(rows[k][i]))
        if not rows[pivot][i]:
            return 0.0
        if pivot != i:
            rows[i], rows[pivot], volume = rows[pivot], rows[i], -volume
        volume *= rows[i][i]
        for k in range(i + 1, len(rows)):
            share = rows[k][i] / rows[i][i]
            rows[k] = [a - share * b for a, b in zip(rows[k], rows[i])]
    return volume / most if most else 0.0


def modelview_kind(m):
    columns = [m[4 * c:4 * c + 4] for c in range(4)]
    three = fullness([c[:3] for c in columns[:3]])
    if all(c[3] == 0 for c in columns[:3]):
        singular = abs(three) < 1e-4
    else:
        far = sum(x * x for x in columns[3][:3]) ** 0.5 or 1
        scaled = [[(x * far if r == 3 else x) / (far if c == 3 else 1)
                   for r, x in enumerate(column)]
                  for c, column in enumerate(columns)]
        singular = abs(fullness(scaled)) < 1e-5
    return "singular" if singular else "mirrored" if three < 0 else "plain"


def state(scene, instance, camera):
    """The properties that rules match, for an instance of `relume scene --json --vertices`."""
    m, view = scene["materials"][instance["material"]], scene["views"][instance["view"]]
    units = scene["units"][m["unit_first"]:m["unit_first"] + m["unit_count"]]
    p = view["projection"]
    return {
        "instance": instance, "camera": camera, "points": scene["meshes"][instance["mesh"]]["position"],
        "mesh": scene["meshes"][instance["mesh"]]["hash"],
        "texture": [scene["textures"][u["texture"]]["hash"]
                    for u in units], "lit": bool(m["lighting"]), "textured": bool(units), "units": len(units),
        "blended": bool(m["blend"]), "alpha_tested": bool(m["alpha_test"]), "depth_tested": bool(m["depth_test"]),
        "stencil_tested": bool(m["stencil_test"]), "parallel": p[3] == 0 and p[7] == 0 and p[11] == 0,
        "environment_mapped": any(mode in MAPPED
                                  for u in units
                                  for mode in u["gen_mode"][:3]), "multiplies": bool(m["blend"])
        and (m["blend_src_rgb"], m["blend_dst_rgb"]) in ((DST_COLOR, ZERO), (ZERO, SRC_COLOR)),
        "modelview": modelview_kind(instance["modelview"])
    }


def camera_of(scene, world):
    """Transform from the world into a frame's eye space, from the first mesh of the list `world` that the frame draws;
    None if it draws none."""
    for anchor in world:
        for instance in scene["instances"]:
            if scene["meshes"][instance["mesh"]]["hash"].startswith(str(anchor["mesh"])):
                return matrix(instance["modelview"]) @ numpy.linalg.inv(matrix(anchor["at"]))
    return None


def matrix(numbers16):
    return numpy.array(numbers16, float).reshape(4, 4).T


def lies_in(plane, has):
    """1 if most points of a draw lie in a plane of the world, by the rule of look/draws/plane.c."""
    points = matrix(has["instance"]["modelview"]) @ numpy.array(has["points"], float).reshape(-1, 4).T
    off = abs(numpy.array(plane) @ numpy.linalg.inv(has["camera"]) @ points)
    return (off <= 1e-3 * abs(points).sum(axis=0)).mean() >= 0.9


def matches(wanted, has):
    for key, value in wanted.items():
        if key == "mesh" and not has["mesh"].startswith(str(value)):
            return False
        if key == "texture" and not any(t.startswith(str(value)) for t in has["texture"]):
            return False
        if key == "in_plane" and not (has["camera"] is not None and lies_in(value, has)):
            return False
        if key not in ("mesh", "texture", "in_plane") and has[key] != value:
            return False
    return True


def numbers(text):
    return {
        n for part in text.split(",") for first, _, last in [part.partition("-")]
        for n in range(int(first),
                       int(last or first) + 1)
    }


def run(*args):
    return subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=True).stdout


def trace_of(entry, build, work):
    """The recording for an entry of the labels, made if missing; None if it cannot be made."""
    if "trace" in entry:
        trace = SHARED / f"{entry['trace']}.trace"
        return trace if trace.exists() else None
    if "record" in entry:
        program, *options = entry["record"]
        run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", work / "labelled.trace", "--",
            build / "corpus" / program, *options)
        return work / "labelled.trace"
    known = {p.name: p for p in programs.OPEN}
    program = known.get(entry["program"]) or programs.xscreensaver(entry["program"])
    if not shutil.which(program.command[0], path=f"{os.environ['PATH']}:/usr/games:/usr/libexec/xscreensaver"):
        return None
    folder = work / program.name
    script = f"import pathlib, programs, recording; recording.record({str(build / 'relume')!r}, {program!r}, pathlib.Path({str(folder)!r}))"
    script = script.replace("Program(", "programs.Program(", 1)
    subprocess.run([ROOT / "tests/xvfb.sh", sys.executable, "-c", script], stdin=subprocess.DEVNULL,
                   capture_output=True, check=True, cwd=ROOT / "tests/show",
                   env=dict(os.environ, PATH=f"{os.environ['PATH']}:/usr/games:/usr/libexec/xscreensaver"))
    return recording.find(folder)


def compare(entry, trace, build, work):
    """(role, true role) of each draw in the labelled frame: the role found, and that of the label; None means ordinary
    world geometry."""
    rules = work / "labelled.look.yaml"
    run(build / "relume", "look", trace, "-o", rules)
    found_rules = yaml.safe_load(rules.read_text())
    rules = found_rules["surfaces"]
    frame = entry["frame"]
    if frame == "last": # the program is played, so frame numbers depend on the machine's speed
        frame = int(re.search(r"^frames +(\d+)", run(build / "relume", "info", trace), re.M)[1]) - 2
    scene = json.loads(run(build / "relume", "scene", trace, "-f", frame, "--json", "--vertices"))
    camera = camera_of(scene, found_rules.get("world") or [])
    for instance in scene["instances"]:
        if not scene["materials"][instance["material"]]["color_mask"] & 7:
            continue # the draw is not visible
        has, found, label = state(scene, instance, camera), None, None
        for rule in rules:
            if rule.get("role") in ROLES and matches(rule.get("match", {}), has):
                found = ROLES[rule["role"]]
        for l in entry["labels"]:
            if instance["draw"] in numbers(l["draws"]) if "draws" in l else matches(l["where"], has):
                label = l["role"]
        yield found, label


def score(build, work, row):
    """Print a row for the precision and one for the recall of each role; row(what, figure, bar, passed)."""
    counts = collections.defaultdict(lambda: [0, 0, 0]) # right, found, labelled
    for entry in yaml.safe_load((ROOT / "tests/look/labels.yaml").read_text()):
        name = entry.get("trace") or entry.get("program") or " ".join(str(x) for x in entry["record"][:2])
        trace = trace_of(entry, build, work)
        if not trace:
            print(f"{name}: missing, not compared", flush=True)
            continue
        seen = collections.Counter(compare(entry, trace, build, work))
        print(
            f"{name}: " + ("; ".join(f"{n} draws are {label or 'world'}, found {found or 'world'}"
                                     for (found, label), n in sorted(seen.items(), key=str)
                                     if found or label) or "no roles, none found"), flush=True)
        for (found, label), n in seen.items():
            counts[label][2] += n
            counts[found][1] += n
            counts[label][0] += n if found == label else 0
    for role, (right, found, labelled) in sorted(counts.items(), key=str):
        if role is None:
            continue
        row(f"{role}: precision, of {found} draws", f"{right / found:.3f}" if found else "none found", PRECISION,
            right >= PRECISION * found if found else None)
        if labelled:
            row(f"{role}: recall, of {labelled} draws", f"{right / labelled:.3f}", RECALL, right >= RECALL * labelled)
