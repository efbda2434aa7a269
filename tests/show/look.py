#!/usr/bin/python3
"""tests/show/look.py BUILD (as `make show-look`): results of `relume look` on lightmapped levels of corpus/rooms whose
lights are known, and on corpus/tricks: number of lights, their errors, and the cost. Also the roles it assigns,
compared with labels written by hand (roles.py)."""
import json
import math
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

import roles

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LEVELS = 20
PLACE, STRENGTH, TRICK, FLIP, ALBEDO = 0.02, 0.1, 0.001, 0.05, 0.01


def numbers(text, key):
    found = re.search(rf"^ +{key}: \[([^]]*)\]", text, re.M)
    return [float(x) for x in found[1].split(",")] if found else None


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


def solved_lights(text):
    """[(position, colour)] of lights recovered from lightmaps, and the ambient light."""
    rules = re.split(r"^  - ", text.partition("\nlights:")[2].partition("\nworld:")[0], flags=re.M)
    lights = [(numbers(r, "position")[:3], numbers(r, "diffuse"))
              for r in rules
              if r.startswith(("role: light of lightmaps", "role: light of vertex colours"))]
    ambient = [
        numbers(r, "ambient")
        for r in rules
        if r.startswith(("role: ambient light of lightmaps", "role: ambient light of vertex colours"))
    ]
    return lights, ambient[0] if ambient else None


def into_world(truth, position):
    """Transform a place of the level into world space, which is the first frame's eye space."""
    turned, start = math.radians(truth["start_yaw"]), truth["start"]
    x, y, z = (p - s for p, s in zip(position, start))
    return [math.cos(turned) * x + math.sin(turned) * z, y, -math.sin(turned) * x + math.cos(turned) * z]


def compare_lights(truth, text):
    """Pair found lights with true ones, nearest first: the numbers found, missed and invented; errors relative to the
    level's size and the lights' strength."""
    lights, ambient = solved_lights(text)
    left, found, off, strength_off = list(lights), 0, 0.0, 0.0
    for light in truth["lights"]:
        place = into_world(truth, light["position"])
        best = min(left, key=lambda l: distance(l[0], place), default=None)
        if best is None or distance(best[0], place) > PLACE * truth["size"]:
            continue
        left.remove(best)
        found += 1
        off = max(off, distance(best[0], place) / truth["size"])
        strength_off = max(strength_off, *(abs(a - b) / b for a, b in zip(best[1], light["color"])))
    ambient_off = max(abs(a - truth["ambient"]) for a in ambient) / truth["ambient"] if ambient else 1.0
    return {
        "found": found, "missed": len(truth["lights"]) - found, "invented": len(left), "off": off,
        "strength_off": strength_off, "ambient_off": ambient_off
    }


def run(*args):
    return subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)


def must(done):
    """Require that a command succeeds, or exit with its name and how it ended, because a killed command prints no
    message."""
    if done.returncode:
        end = f"signal {-done.returncode}" if done.returncode < 0 else f"code {done.returncode}"
        print(f"{' '.join(done.args)}: ended with {end}: {done.stderr.strip() or 'no message'}", file=sys.stderr,
              flush=True)
        sys.exit(1)


def study(build, work, program, *options):
    """Record a program and study it; returns the rules and the study's processor seconds."""
    trace, rules = work / "x.trace", work / "x.look.yaml"
    for old in work.glob("x.*"):
        old.unlink()
    must(
        run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", trace, "--", build / "corpus" / program,
            *options))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    must(run(build / "relume", "look", trace, "-o", rules))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return rules.read_text(), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def textures_alone(build, work, seed, cut):
    """A level's picture with only its textures, which Mesa draws identically: the reference for albedo.

    cut: "none", or "white" where walls are cut into small triangles because their vertex colours carry the light.
    """
    trace = work / "bare.trace"
    for old in work.glob("bare.*"):
        old.unlink()
    must(
        run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", trace, "--ref", "color,depth", "--",
            build / "corpus/rooms", "--seed", seed, "--frames", 2, "--animate", "camera", "--lighting", cut))
    must(run(build / "relume", "render", trace, "-f", 1, "-o", work / "bare/x.####.exr", "--aov", "gl,Z"))
    scored = json.loads(run(build / "relume", "diff", trace, work / "bare", "--json", "-").stdout)
    state = next(f for f in scored["frames"] if f["frame"] == 1)["gates"]["R1"]["state"]
    if state != "passed":
        sys.exit(f"seed {seed}: textures alone are not as Mesa draws them: R1 {state}")
    return Image(work / "bare/x.0001.exr", {f"gl.{c}" for c in "RGB"}).planes


def albedo_error(bare, albedo):
    """The largest difference between a pixel's albedo and its texture."""
    return max(abs(a - b) for c in "RGB" for p, q in zip(bare[f"gl.{c}"], albedo[f"albedo.{c}"]) for a, b in zip(p, q))


def true_rules(truth, text):
    """The rules found, with their lights replaced by the level's true ones."""
    lights = [(truth["ambient"], (0, 0, 0), (0, 1, 0, 0))]
    lights += [(0, light["color"], (*into_world(truth, light["position"]), 1)) for light in truth["lights"]]
    listed = "".join(
        f"  - on: unlit\n    space: world\n    position: {list(at)}\n    ambient: {[ambient] * 3}\n    diffuse: "
        f"{list(color)}\n"
        "    specular: [0, 0, 0]\n    attenuation: [0, 0, 1]\n" for ambient, color, at in lights)
    return text.partition("\nlights:")[0] + "\nlights:\n" + listed + "world:" + text.partition("\nworld:")[2]


def relight(build, work, truth, text):
    """A level relit by the lights found, compared with the same level under its true lights: mean FLIP, and the file
    with albedo."""
    for name, rules in (("true", true_rules(truth, text)), ("relit", text)):
        (work / "y.look.yaml").write_text(rules)
        must(
            run(build / "relume", "render", work / "x.trace", "-f", 1, "-o", work / name / "x.####.exr", "--look",
                work / "y.look.yaml", "--aov", "gl,albedo"))
    scored = json.loads(
        run(build / "relume", "diff", work / "true", work / "relit", "--channel", "beauty", "--json", "-").stdout)
    return scored["frames"][0]["info"]["beauty_flip"], Image(work / "relit/x.0001.exr",
                                                             {f"albedo.{c}" for c in "RGB"}).planes


def main(build):
    rows, bad, textures = [], 0, {}

    def row(what, figure, bar, passed):
        nonlocal bad
        bad += passed is False
        rows.append({"what": what, "figure": figure, "bar": bar, "peer": None, "passed": passed})
        print(f"{what}: {figure}" + (f" (bar: {bar})" if bar else ""), flush=True)

    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        for lighting in ("multitexture", "pass", "colors"):
            scores, seconds = [], 0.0
            for seed in range(LEVELS):
                truth = work / "truth.json"
                text, took = study(build, work, "rooms", "--seed", seed, "--lights", 1 + seed % 6, "--frames", 2,
                                   "--animate", "camera", "--lighting", lighting, "--truth", truth)
                scores.append(compare_lights(json.loads(truth.read_text()), text))
                seconds += took
                score = scores[-1]
                score["flip"], albedo = relight(build, work, json.loads(truth.read_text()), text)
                cut = "white" if lighting == "colors" else "none"
                if (seed, cut) not in textures:
                    textures[seed, cut] = textures_alone(build, work, seed, cut)
                score["albedo_off"] = albedo_error(textures[seed, cut], albedo)
                print(
                    f"{lighting}, seed {seed}: {score['found']} found, {score['missed']} missed, {score['invented']} "
                    f"invented; off by {score['off']:.5f} of "
                    f"the size, {score['strength_off']:.4f} of the strength, {score['ambient_off']:.4f} of the "
                    f"ambient, {score['albedo_off']:.4f} of the albedo; FLIP {score['flip']:.4f}; {took:.2f} s",
                    flush=True)
            total = {key: sum(s[key] for s in scores) for key in ("found", "missed", "invented")}
            row(f"{lighting}: lights of {LEVELS} levels found, missed, invented",
                ", ".join(str(n) for n in total.values()), "none missed or invented", not total["missed"]
                and not total["invented"])
            row(f"{lighting}: largest position error, relative to the level's size",
                f"{max(s['off'] for s in scores):.4f}", PLACE,
                max(s["off"] for s in scores) <= PLACE)
            row(f"{lighting}: largest error of strength", f"{max(s['strength_off'] for s in scores):.4f}", STRENGTH,
                max(s["strength_off"] for s in scores) <= STRENGTH)
            row(f"{lighting}: largest mean FLIP of a relit level", f"{max(s['flip'] for s in scores):.4f}", FLIP,
                max(s["flip"] for s in scores) <= FLIP)
            off = max(s["albedo_off"] for s in scores)
            row(f"{lighting}: largest error of albedo against the texels as Mesa filters them", f"{off:.4f}", ALBEDO,
                off <= ALBEDO)
            row(f"{lighting}: processor seconds of a study", f"{seconds / LEVELS:.2f}", None, None)
        for kind, key, true in (("planar", "position", (2, 2.5, -7, 1)), ("zpass", "position", (2, 2.5, -7, 1)),
                                ("zfail", "position", (2, 2.5, -7, 1)), ("directional", "position",
                                                                         (0.4364358, 0.8728716, 0.2182179,
                                                                          0)), ("mirror", "plane", (0, 0, 1, 11))):
            found = numbers(study(build, work, "tricks", kind, "--frames", 3)[0], key) or [1e9] * 4
            off = distance(found, true) / distance(true, (0, 0, 0, 0))
            row(f"tricks {kind}: {'plane' if key == 'plane' else 'light'} off by", f"{off:.2g}", TRICK, off <= TRICK)
        roles.score(build, work, row)
    (build / "show").mkdir(parents=True, exist_ok=True)
    (build / "show/look.json").write_text(
        json.dumps({"name": "look", "command": "make show-look", "rows": rows}, indent=1))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
