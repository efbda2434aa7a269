#!/usr/bin/python3
"""tests/show/faults.py BUILD [PART-OF-A-NAME...] (as `make show-faults`): does relume diff find real faults, and only
those?

Records corpus/still_life live with its reference frames, renders and approves it. Then come 40 faults: either calls of
the recording are changed and it is rendered again (as a broken replayer or tracer would do), or the frame's file is
damaged. Each is scored against the unchanged recording and the approved frame. The gate for that fault must fail; if
the fault is in one draw, that draw must be blamed first. Then come 20 harmless variations, and none may fail. `idiff`
compares each with the approved frame, at the setting that works best on these very pairs.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import zlib

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/show"))
sys.path.insert(0, str(ROOT / "tests/real"))
from edit_trace import Trace  # noqa: E402
import exr_numpy as exr  # noqa: E402
from replayed import REF_COLOR, records  # noqa: E402

FRAME = 1
FLOOR, BOX, SPHERE, PYRAMID, FENCE, PANES = 2, 3, 4, 5, 6, (7, 8)  # draw numbers; 1 is the clear, and two draws blend
GL = {
    "DITHER": 0x0BD0, "LIGHT1": 0x4001, "BLEND": 0x0BE2, "ALPHA_TEST": 0x0BC0, "DEPTH_TEST": 0x0B71, "FOG": 0x0B60,
    "LIGHTING": 0x0B50, "CW": 0x0900, "FLAT": 0x1D00, "ONE": 1, "REPLACE": 0x1E01, "NEAREST": 0x2600, "LINEAR": 0x2601,
    "CLAMP_TO_EDGE": 0x812F, "LINE": 0x1B01, "TEXTURE_2D": 0x0DE1, "POSITION": 0x1203, "SHININESS": 0x1601,
    "DIFFUSE": 0x1201, "AMBIENT_AND_DIFFUSE": 0x1602, "NORMALIZE": 0x0BA1, "FOG_END": 0x0B64, "LESS": 0x0201
}


# Edits of the recording. Each takes a Trace.

def enable(cap, instead="DITHER"):
    def edit(t):
        hits = [a for a in t.find("glEnable") if a[0].value == GL[cap]]
        assert hits
        for a in hits:
            t.change(a[0], GL[instead])
    return edit


def scalar(name, wanted, index, new):
    """Change argument `index` of the calls whose arguments `wanted` ({index: value}) match."""
    def edit(t):
        def matches(a):
            return all(abs(a[i].value - v) < 1e-5 for i, v in wanted.items())
        hits = [a for a in t.find(name) if matches(a)]
        assert hits, f"{name} {wanted}"
        for a in hits:
            t.change(a[index], new(a[index].value) if callable(new) else new)
    return edit


def vector(name, wanted, array, first, new):
    """Change the array argument of calls whose arguments match and whose array begins with `first`."""
    def edit(t):
        hits = [a for a in t.find(name) if all(a[i].value == v for i, v in wanted.items()) and
                all(abs(item.value - f) < 1e-5 for item, f in zip(a[array].value, first))]
        assert hits, f"{name} {wanted} {first}"
        for a in hits:
            for item, value in zip(a[array].value, new):
                t.change(item, value)
    return edit


def box_vertex(t):
    changed = 0
    for a in t.find("glVertexPointer") + t.find("glBufferData"):
        for v in a.values():
            if v.kind == "blob" and len(v.value) == 24 * 12:
                p = numpy.frombuffer(v.value, "<f4").copy()
                if abs(abs(p) - 0.7).max() < 1e-5:
                    p[::3][p[2::3] > 0] += 0.15
                    t.change(v, p.tobytes())
                    changed += 1
    assert changed


def floor_texel(t):
    for a in t.find("glTexCoord2f"):
        if abs(a[1].value) > 1.01:  # floor corners have larger coordinates; the fence has t of 0 and 1
            t.change(a[0], a[0].value + 1 / 16)


def half_pixel(t):
    for a in t.find("glFrustum"):
        for i in (0, 1):
            t.change(a[i], a[i].value + 0.8 / 800 / 2)


def tiny_shift(parts):
    def edit(t):
        for a in t.find("glFrustum"):
            for i in (0, 1):
                t.change(a[i], a[i].value + 0.8 / 800 / parts)
    return edit


def fence_texture(t):
    hits = t.find("glBindTexture")
    for a in hits[4:]:  # after the textures are created, in the order floor, fence, floor, fence
        t.change(a[1], 3 - a[1].value)


def specular_edges(t):
    for a in t.find("glMaterialf"):
        t.change(a[2], 10.0)


# Damage to the file. Each takes the frame as exr.Image, and may return bytes to write instead.

def layers(image, *names):
    return [(f"{n}.{c}" if n else c) for n in names for c in "RGB"]


def display(x):
    x = numpy.clip(x, 0, None)
    return numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def linear(x):
    return numpy.where(x <= 0.04045, x / 12.92, ((numpy.clip(x, 0, None) + 0.055) / 1.055) ** 2.4)


def rebuild(image):
    """The beauty that results from changed gl and effect channels, rounded as in the file."""
    for c in "RGB":
        p = {
            n: image.planes[f"{n}.{c}"].astype(numpy.float64)
            for n in ("gl", "shadow", "relight", "reflect", "refract")
            if f"{n}.{c}" in image.planes
        }
        image.planes[c] = (p["gl"] * p.get("shadow", 1) +
                           sum(p.get(n, 0) for n in ("relight", "reflect", "refract"))).astype(image.planes[c].dtype)


def on_gl(function):
    def damage(image):
        for c in layers(image, "gl"):
            image.planes[c] = function(image.planes[c].astype(numpy.float64)).astype(image.planes[c].dtype)
        rebuild(image)
    return damage


def put(channel, value, y=300, x=400):
    def damage(image):
        image.planes[channel][y, x] = value
    return damage


def every(function):
    def damage(image):
        for c in image.planes:
            image.planes[c] = numpy.ascontiguousarray(function(image.planes[c]))
    return damage


def drop_shadow(image):
    for c in layers(image, "shadow"):
        image.planes[c][:] = 1
    rebuild(image)


def lost_shadow_channel(image):
    for c in layers(image, "shadow"):
        image.planes[c][:] = 1


def unexplained(image):
    for c in layers(image, ""):
        image.planes[c][100:120, 100:130] += image.planes[c].dtype.type(0.1)


def swap_colors(image):
    for r, b in (("gl.R", "gl.B"), ("shadow.R", "shadow.B")):
        image.planes[r], image.planes[b] = image.planes[b], image.planes[r]
    rebuild(image)


def drop_id(image):
    del image.planes["id"]


def short(image):
    for c in image.planes:
        image.planes[c] = image.planes[c][:-1]


def black(image):
    for c in layers(image, "", "gl"):
        image.planes[c][:] = 0


def quantized_depth(image):
    image.planes["gl.depth"] = (numpy.round(image.planes["gl.depth"] * 4095) / 4095).astype("float32")


def stale_tile(image):
    other = exr.Image(image.path.parent.parent / "good" / "s.0000.exr")
    for c in image.planes:
        image.planes[c][480:544, 560:624] = other.planes[c][480:544, 560:624]


def stale(image):
    return (image.path.parent.parent / "good" / "s.0000.exr").read_bytes().replace(b"relume:frame\0string\0\1\0\0\x000",
                                                                                   b"relume:frame\0string\0\1\0\0\x001")


def wrong_number(image):
    return (image.path.parent.parent / "good" / "s.0000.exr").read_bytes()


def truncated(image):
    data = image.path.read_bytes()
    return data[:len(data) // 2]


MISSING = object()

# name, gates that must include a failure ("" if the frame's outcome is the fault), draw to blame (None: none), edit
FAULTS = [
    ("a box is not drawn", ("R3", "R4"), BOX, scalar("glDrawElements", {}, 1, 0)),
    ("a list is not found", ("R3", "R4"), SPHERE, scalar("glCallList", {0: 1}, 0, 99)),
    ("wrong textures", ("R1", "R3"), FLOOR, fence_texture),
    ("texture off by one texel", ("R1", ), FLOOR, floor_texel),
    ("texture not filtered", ("R1", "R1b"), FLOOR,
     scalar("glTexParameteri", {1: 0x2800, 2: GL["LINEAR"]}, 2, GL["NEAREST"])),
    ("texture clamped, not repeated", ("R1", "R3"), FLOOR, scalar("glTexParameteri", {1: 0x2802}, 2,
                                                                  GL["CLAMP_TO_EDGE"])),
    ("texture replaces, not modulates", ("R1", "R3"), FLOOR, scalar("glTexEnvi", {}, 2, GL["REPLACE"])),
    ("swapped winding", ("R3", "R5"), None, scalar("glFrontFace", {}, 0, GL["CW"])),
    ("a light is off", ("R1", ), None, enable("LIGHT1")),
    ("a light is elsewhere", ("R1", ), None, vector("glLightfv", {1: GL["POSITION"]}, 2, (-3, 6, 3), (3, 6, 3, 1))),
    ("a light of another colour", ("R1", ), None,
     vector("glLightfv", {1: GL["DIFFUSE"]}, 2, (0.3, 0.25), (0.2, 0.25, 0.3, 1))),
    ("half a pixel off", ("R2", "R5"), None, half_pixel),
    ("wrong blend function", ("R1b", "R3"), PANES, scalar("glBlendFunc", {}, 1, GL["ONE"])),
    ("no blending", ("R1", "R1b", "R3"), PANES, enable("BLEND")),
    ("no alpha test", ("R3", "R4"), FENCE, enable("ALPHA_TEST")),
    ("no depth test", ("R3", ), None, enable("DEPTH_TEST")),
    ("no fog", ("R1", "P"), None, enable("FOG")),
    ("fog ends elsewhere", ("R1", "P"), None, scalar("glFogf", {0: GL["FOG_END"]}, 1, 28.0)),
    ("wrong material", ("R1", ), BOX,
     vector("glMaterialfv", {1: GL["AMBIENT_AND_DIFFUSE"]}, 2, (0.8, 0.2), (0.8, 0.24, 0.15, 1))),
    ("wrong highlight", ("R1", ), SPHERE, scalar("glMaterialf", {1: GL["SHININESS"]}, 2, 20.0)),
    ("flat, not smooth", ("R1", ), None, scalar("glShadeModel", {}, 0, GL["FLAT"])),
    ("an object is elsewhere", ("R3", "R4", "R5"), SPHERE, scalar("glTranslatef", {0: 0.5, 2: -2}, 1, 0.06)),
    ("an object is turned", ("R3", "R4", "R5"), BOX, scalar("glRotatef", {0: 25}, 0, 29.0)),
    ("some vertices moved", ("R3", "R4", "R5"), BOX, box_vertex),
    ("wrong clear colour", ("R1", ), 0, scalar("glClearColor", {}, 0, 0.3)),
    ("wrong depth range", ("R5", ), None, scalar("glDepthRange", {}, 1, 0.9)),
    ("one NaN in a normal", ("V", ), None, put("N.X", numpy.nan)),
    ("one infinite pixel", ("V", ), None, put("R", numpy.inf)),
    ("another frame's number", ("V", ), None, wrong_number),
    ("one row is missing", ("V", ), None, short),
    ("a stale frame", ("R3", "R4"), None, stale),
    ("a stale tile", ("R1", "R3"), None, stale_tile),
    ("mirrored", ("R3", "R4"), None, every(lambda p: p[:, ::-1])),
    ("gamma twice", ("R1", "P"), None, on_gl(lambda p: linear(display(display(p))))),
    ("a drift of 1/255", ("B", ), None,
     on_gl(lambda p: linear(numpy.minimum(display(p) + 1 / 255, 1)))),  # R1 allows it, P must too
    ("a drift of 3/255", ("P", ), None, on_gl(lambda p: linear(numpy.minimum(display(p) + 3 / 255, 1)))),
    ("red and blue swapped", ("R1", "R3"), None, swap_colors),
    ("the shadows are gone", ("B", ), FLOOR, drop_shadow),
    ("shadows in the beauty alone", ("E1", ), FLOOR, lost_shadow_channel),
    ("light without a reason", ("E2", ), 0, unexplained),
    ("coarse depth", ("R5", ), None, quantized_depth),
]

# Harmless variations. Each takes the run and returns the reference, the frame's file, further options, and whether to
# compare with the approved frame. A variation that moves edges changes bytes on the approved device, which gate B
# reports by design.

def rendered(*options, env=None, edit=None, baseline=True, more=()):
    def vary(s, folder):
        trace = s.trace
        if edit:
            trace = folder / "s.trace"
            t = Trace(s.trace)
            edit(t)
            t.save(trace)
        return s.trace, s.render(trace, folder, *options, env=env), more, baseline and not edit
    return vary


def rewritten(function=None, more=(), baseline=True, **how):
    def vary(s, folder):
        image = exr.Image(s.good)
        if function:
            function(image)
        exr.write(folder / "s.0001.exr", image, **how)
        return s.trace, folder / "s.0001.exr", more, baseline
    return vary


def converted(*options):
    def vary(s, folder):
        s.run("oiiotool", s.good, *options, "-o", folder / "s.0001.exr")
        return s.trace, folder / "s.0001.exr", (), False
    return vary


def png_reference(s, folder):
    s.run(s.relume, "diff", s.trace, s.good.parent, "-f", FRAME, "--report", folder / "report")
    image = s.reference()
    (folder / "ref").mkdir()
    exr.write_png(folder / "ref" / "r.0001.png", image)
    return folder / "ref", shutil.copy(s.good, folder / "s.0001.exr"), (), True


def repacked(s, folder):
    Trace(s.trace).save(folder / "s.trace")  # different chunk sizes, no compression
    shutil.copy(s.trace.with_suffix(".ref"), folder / "s.ref")
    return folder / "s.trace", s.render(folder / "s.trace", folder), (), True


def noise(image):
    rng = numpy.random.default_rng(1)
    for c in layers(image, "gl"):
        p = image.planes[c].astype(numpy.float64)
        image.planes[c] = (p * (1 + 2.0 ** -11 * rng.uniform(-1, 1, p.shape))).astype(image.planes[c].dtype)
    rebuild(image)


def specks(image):
    rng = numpy.random.default_rng(2)
    hit = rng.random(image.planes["gl.R"].shape) < 0.01
    for c in layers(image, "gl"):
        p = image.planes[c].astype(numpy.float64)
        image.planes[c] = numpy.where(hit, linear(numpy.minimum(display(p) + 1 / 255, 1)),
                                      p).astype(image.planes[c].dtype)
    rebuild(image)


def clock(image):
    rng = numpy.random.default_rng(3)
    for c in layers(image, "gl"):
        image.planes[c][4:24, 4:104] = rng.random((20, 100))
    rebuild(image)


def ignored(s, folder):
    (folder / "c.yaml").write_text("rules:\n- ignore: [{x: 4, y: 4, width: 100, height: 20}]\n")
    return rewritten(clock, more=("--config", folder / "c.yaml"), baseline=False)(s, folder)


HARMLESS = [
    ("1 thread", rendered("--threads", "1")),
    ("2 threads", rendered("--threads", "2")),
    ("the scalar twins in C", rendered("--device", "reference")),
    ("PoCL's other driver", rendered(env={"POCL_DEVICES": "basic"})),
    ("PoCL without vectors across work-items", rendered(env={"POCL_WORK_GROUP_METHOD": "loops"})),
    ("PoCL with small work-groups", rendered(env={"POCL_MAX_WORK_GROUP_SIZE": "64"})),
    ("rendered after the frame before", rendered("-f", "0-1")),
    ("display numbers in the file", rendered("--encoding", "display", baseline=False)),
    ("fewer channels", rendered("--aov", "gl,id,shadow", baseline=False)),
    ("the trace in other chunks", repacked),
    ("uncompressed", rewritten()),
    ("other compression", rewritten(compression="zips")),
    ("rewritten by oiiotool as PIZ", converted("--compression", "piz")),
    ("tiles instead of lines", converted("--tile", "64", "64")),
    ("PNG reference", png_reference),
    ("edges off by 1/1000 pixel", rendered(edit=tiny_shift(1000))),
    ("edges off by 1/4000 pixel", rendered(edit=tiny_shift(-4000))),
    ("other last bits", rewritten(noise, baseline=False)),
    ("1 % of the pixels off by 1/255", rewritten(specks, baseline=False)),
    ("a clock that is ignored", ignored),
]


class Suite:
    def __init__(self, build):
        self.relume = build / "relume"
        self.work = build / "show" / "faults"
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)
        self.trace, self.base = self.work / "s.trace", self.work / "approved"
        self.log = open(self.work / "log", "w")
        self.run(ROOT / "tests/xvfb.sh", self.relume, "record", "-o", self.trace, "--ref", "color,depth", "--",
                 build / "corpus" / "still_life", "--frames", "2", "--animate", "camera")
        self.run(self.relume, "render", self.trace, "-f", "0-1", "-o", self.work / "good" / "s.####.exr")
        self.good = self.work / "good" / "s.0001.exr"
        self.run(self.relume, "approve", self.work / "good", self.base, "--by", "show-faults")

    def run(self, *command, env=None, check=True):
        command = [str(c) for c in command]
        self.log.write(f"$ {' '.join(command)}\n")
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, env=dict(os.environ, **(env or {})), timeout=600)
        self.log.write(done.stdout[-20000:] + done.stderr)
        self.log.flush()
        if check and done.returncode != 0:
            raise SystemExit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}")
        return done

    def render(self, trace, folder, *options, env=None):
        frames = () if "-f" in options else ("-f", FRAME)
        self.run(self.relume, "render", trace, "-o", folder / "s.####.exr", *frames, *options, env=env)
        return folder / "s.0001.exr"

    def reference(self):
        """The reference frame as codes, read from the .ref file."""
        for frame, width, height, pixels in records(self.trace.with_suffix(".ref"), REF_COLOR):
            if frame == FRAME:
                return numpy.frombuffer(pixels, "u1").reshape(height, width, 4)[::-1, :, :3]
        sys.exit(f"{self.trace}: no reference of frame {FRAME}")

    def score(self, reference, file, more=(), baseline=True):
        """One frame as --json reports it, and the exit code. Gate V scores frames of a changed trace only if the trace
        names the reference."""
        options = ("--baseline", self.base) if baseline else ()
        frames = reference.with_suffix(".ref") if reference.suffix == ".trace" else reference
        done = self.run(self.relume, "diff", frames, file.parent / "s.####.exr", "-f", FRAME, "--json", "-", *options,
                        *more, check=False)
        frame, = json.loads(done.stdout)["frames"]
        return done.returncode, frame


def make_fault(s, folder, what):
    """Write the frame's file with the fault applied."""
    path = folder / "s.0001.exr"
    if what.__module__ == __name__ and getattr(what, "__code__", None) and what.__code__.co_varnames[:1] == ("t",):
        trace = folder / "s.trace"
        t = Trace(s.trace)
        what(t)
        assert t.patches
        t.save(trace)
        return s.render(trace, folder)
    image = exr.Image(s.good)
    image.path = path
    shutil.copy(s.good, path)
    data = what(image)
    if data is None:
        exr.write(path, image)
    else:
        path.write_bytes(data)
    return path


def judge_fault(code, frame, gates, draw):
    failed = [g for g, v in frame["gates"].items() if v["state"] == "failed"]
    caught = code != 0 and any(g in failed for g in gates)
    named = draw is None or (frame["blame"] and frame["blame"][0]["draw"] in (draw if isinstance(draw, tuple) else
                                                                              (draw, )))
    first = f"draw {frame['blame'][0]['draw']}" if frame["blame"] else "-"
    return caught, named, " ".join(failed), first


def idiff_figures(good, other):
    """idiff's measure for each pixel: the largest difference of its channels; None if idiff fails at any setting."""
    try:
        a, b = exr.Image(good), exr.Image(other)
    except (ValueError, zlib.error, struct_error):
        return None
    if a.planes.keys() != b.planes.keys() or a.planes["R"].shape != b.planes["R"].shape:
        return None
    worst = numpy.zeros(a.planes["R"].shape)
    for c in a.planes:
        with numpy.errstate(invalid="ignore"):
            d = numpy.abs(a.planes[c].astype(numpy.float64) - b.planes[c])
        worst = numpy.fmax(worst, numpy.where(numpy.isnan(d), 0, d))
    return worst


from struct import error as struct_error  # noqa: E402


def best_idiff(s, pairs):
    """The setting with the most right answers, found by applying idiff's rule to colour channels and confirmed by idiff
    itself.
    """
    figures = [(idiff_figures(s.good_colors, p), bad) for p, bad in pairs]
    best = (-1, None)
    for fail in (0, 0.0005, 0.001, 0.002, 0.004, 0.008, 0.016, 0.03, 0.06, 0.12):
        for per_cent in (0, 0.01, 0.05, 0.1, 0.5, 1, 2, 5):
            for hard in (0.05, 0.1, 0.25, 0.5, 1, 1e9):
                right = 0
                for worst, bad in figures:
                    says = worst is None or 100 * (worst > fail).mean() > per_cent or worst.max() > hard
                    right += says == bad
                best = max(best, (right, (fail, per_cent, hard)), key=lambda x: x[0])
    fail, per_cent, hard = best[1]
    answers = []
    for path, bad in pairs:
        code = s.run("idiff", "-q", "-fail", fail, "-failpercent", per_cent, "-hardfail", hard, "-warn", 1e9,
                     s.good_colors, path, check=False).returncode
        answers.append((code not in (0, 1)) == bad)
    return f"-fail {fail:g} -failpercent {per_cent:g} -hardfail {hard:g}", answers


def colors(s, path, out):
    """Input for idiff: beauty and gl only, so that ids and positions have no influence. Unreadable files are passed as
    they are."""
    try:
        image = exr.Image(path)
    except (ValueError, zlib.error, struct_error):
        return path
    if "tiles" in image.header or "gl.R" not in image.planes:
        return path
    for c in [c for c in image.planes if c not in layers(image, "", "gl")]:
        del image.planes[c]
    exr.write(out, image)
    return out


def main(build, *parts):
    build = pathlib.Path(build).resolve()
    s = Suite(build)
    pairs, rows, counts = [], [], {"caught": 0, "named": 0, "nameable": 0, "quiet": 0, "faults": 0, "harmless": 0}
    s.good_colors = colors(s, s.good, s.work / "good.colors.exr")
    for i, (name, gates, draw, what) in enumerate(FAULTS):
        if parts and not any(p in name for p in parts):
            continue
        folder = s.work / f"fault{i + 1:02}"
        folder.mkdir()
        code, frame = s.score(s.trace, make_fault(s, folder, what))
        caught, named, failed, first = judge_fault(code, frame, gates, draw)
        counts["faults"] += 1
        counts["caught"] += caught
        counts["nameable"] += draw is not None
        counts["named"] += draw is not None and bool(named)
        wanted = "-" if draw is None else f"draw {draw}" if isinstance(draw, int) else " or ".join(map(str, draw))
        rows.append((caught and named, "fault", name, "or ".join(gates), failed, wanted, first))
        print(
            f"{'ok   ' if caught and named else 'WRONG'} {i + 1:2} {name:34} by {'/'.join(gates):10} failed: "
            f"{failed:28} "
            f"blame {wanted}: {first}", flush=True)
        pairs.append((colors(s, folder / "s.0001.exr", folder / "colors.exr"), True))
    for i, (name, vary) in enumerate(HARMLESS):
        if parts and not any(p in name for p in parts):
            continue
        folder = s.work / f"harmless{i + 1:02}"
        folder.mkdir()
        reference, path, more, baseline = vary(s, folder)
        code, frame = s.score(reference, pathlib.Path(path), more, baseline)
        failed = " ".join(g for g, v in frame["gates"].items() if v["state"] == "failed")
        quiet = code == 0 and frame["outcome"] == "passed"
        counts["harmless"] += 1
        counts["quiet"] += quiet
        rows.append((quiet, "harmless", name, "with B" if baseline else "", failed, "", ""))
        print(
            f"{'ok   ' if quiet else 'WRONG'} {i + 1:2} {name:44} {frame['outcome']} "
            f"{failed}{' (with B)' if baseline else ''}",
            flush=True)
        pairs.append((colors(s, pathlib.Path(path), folder / "colors.exr"), False))
    setting, answers = best_idiff(s, pairs)
    faults, quiet = sum(answers[:counts["faults"]]), sum(answers[counts["faults"]:])
    print(
        f"idiff at its best setting here ({setting}): {faults} of {counts['faults']} faults, {quiet} of "
        f"{counts['harmless']} "
        "harmless variations right")
    result = {
        "name": "faults", "command": "make show-faults", "table": rows, "rows": [{
            "what": "faults caught by the gate that is there for them",
            "figure": f"{counts['caught']} of {counts['faults']}", "bar": str(len(FAULTS)),
            "peer": f"idiff {setting}: {faults}", "passed": counts["caught"] == counts["faults"]
        }, {
            "what": "faults of one draw, blamed first", "figure": f"{counts['named']} of {counts['nameable']}",
            "bar": str(counts["nameable"]), "peer": None, "passed": counts["named"] == counts["nameable"]
        }, {
            "what": "harmless variations that pass", "figure": f"{counts['quiet']} of {counts['harmless']}",
            "bar": str(len(HARMLESS)), "peer": f"idiff {setting}: {quiet}",
            "passed": counts["quiet"] == counts["harmless"]
        }]
    }
    (build / "show" / "faults.json").write_text(json.dumps(result, indent=1) + "\n")
    for row in result["rows"]:
        print(
            f"{'holds' if row['passed'] else 'FAILS'}  {row['what']}: {row['figure']} (bar {row['bar']}); "
            f"{row['peer'] or ''}"
        )
    return 0 if all(row["passed"] for row in result["rows"]) else 1


if __name__ == "__main__":
    assert len(FAULTS) >= 40 and len(HARMLESS) >= 20
    sys.exit(main(*sys.argv[1:]))
