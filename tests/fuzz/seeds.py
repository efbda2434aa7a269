"""Initial inputs of libFuzzer and of mutants: files made by Relume and other programs, in a folder
BUILD/fuzz/seeds_TARGET each."""
import gzip
import pathlib
import re
import struct
import subprocess
import sys

from mutate import unpack

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LOOK = b"""surfaces:
  - match: { texture: 3fa1, mesh: 90c2, draws: "1-3,5", call: glCallList, list: 5, program: no, lit: yes, textured: yes, blended: no,
             alpha_tested: no, depth_tested: yes, stencil_tested: no, environment_mapped: no, units: 2, multiplies: no, parallel: no,
             modelview: plain, in_plane: [0, 1, 0, -2] }
    reflect: 0.2
    transmit: 0.8
    ior: 1.5
    absorb: [0.2, 0, 0]
    roughness: 0.05
    emission: [0, 0, 0]
    shadows: yes
    passes: suns
    mirrors: yes
    near: yes
    role: floor
    why: seen
    confidence: 0.9
  - { lit: yes, dome: no, left_out: yes, solid: yes, lightmap: 1, vertex_light: yes, shadow_unit: 0, shaded: no }
world:
  - { mesh: 90c2, at: [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1] }
unseen:
  - { frame: 1, draws: "3-7,12" }
lights:
  - { light: 0, off: no }
  - { position: [0, 5, 0, 1], object: 90c2, on: unlit, diffuse: [1, 1, 1], ambient: [0, 0, 0], specular: [1, 1, 1], attenuation: [1, 0, 0],
      spot: { direction: [0, 0, -1], cutoff: 30, exponent: 0 }, radius: 0.3 }
sky: { reach: 20, up: [0, 1, 0], space: eye, light: [1, 1, 1], ground: [0.5, 0.5, 0.5], lit: 0.5, unlit: no }
gloss: { share: 1 }
spare: no
replace: yes
"""
RULES = b"""baseline: approved
presets:
  - name: soft
    codes: 3
    bars: [{ gate: R1, figure: 1, fail: 2, warn: 1 }]
  - name: softer
    inherits: soft
    ignore: [{ x: 0, y: 0, width: 10, height: 5 }]
rules:
  - match: "gear*"
    frames: 1-10x2
    preset: softer
    channel: gl
    channels: [R, G]
    effects: [{ effect: shadow, low: 1, high: 90 }]
flaky:
  - { match: gears, frames: 7, gates: [R1, P], reason: noise, expires: 2030-01-01 }
"""
BASELINE = b"""format: relume-baseline
version: 1
device: dev
trace: 0123456789abcdef0123456789abcdef
relume: 1.0
settings: 0123456789abcdef
approved_by: someone
approved_at: 2026-01-01
reason: looked at
frames:
  - { frame: 1, width: 4, height: 3, channels: "R:0123456789abcdef" }
  - { frame: 2, width: 4, height: 3, file: frame.0002.exr, channels: "A:0123456789abcdef R:0123456789abcdef" }
"""
# Two frames of 2 x 2 pixels, colour and depth (capture/format/ref.h), in a Snappy block with one literal.
REF = b"RELREF2\n" + b"".join(
    struct.pack("<IIIQQ", kind, 2, 2, frame, 18) + b"\x10\x3c" + bytes(range(16))
    for frame in (3, 4)
    for kind in (1, 2))
REF += struct.pack("<IIIQQQ", 0x101, 2, 2, 5, 26, 8) + b"\x10\x3c" + bytes(range(16))
# Memory of eight pages, with the third one missing, and a call of each kind (fuzz_recorder.c).
RECORDER = bytes([0xfb, *b"a text" * 20]).ljust(256, b"\0") + b"".join(
    struct.pack("<BBHi5i", what, wild, 8000, 300, 0x1908, 0x1401, 16, 16, 1) for what in range(8) for wild in (0, 1, 9))
FARM = b"x.trace\0-f\0001-50x5\0-o\0x.####.exr\0--chunk\00010\0--sbatch=--partition=night\0--for\0slurm\0--\0--mode\0gl\0"


def read_pack(path):
    """The inputs in a file: for each, its length as 32 bits, low byte first, and its bytes."""
    data, at, parts = path.read_bytes() if path.exists() else b"", 0, []
    while at < len(data):
        size = int.from_bytes(data[at:at + 4], "little")
        parts.append(data[at + 4:at + 4 + size])
        at += 4 + size
    return parts


VERBS = 10  # in fuzz_verbs.c
SCENE, STATES = 1, 9  # verbs that build a whole frame, and all frames
STREAM = 128  # flag in the same byte: a stream without a container


def record(build, folder):
    """Recordings of our programs, two frames each (panels: all), with reference frames."""
    folder.mkdir(parents=True, exist_ok=True)
    for program in [
            *(build / "corpus").iterdir(), *(build / "tests/real").glob("*"), *(build / "tests/real/panels").iterdir()
    ]:
        if program.is_dir() or "." in program.name or program.name.startswith("test_"):
            continue
        subprocess.run([
            "timeout", "5", build / "relume", "record", "-o", folder / f"{program.name}.trace", "--ref", "color,depth",
            "--", program, "--frames", "2"
        ], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)


def cut_panels(build, folder):
    """Recordings of panels, one frame each: their calls are the most varied, and short recordings are mutated more
    often."""
    cut = folder / "cut"
    cut.mkdir(exist_ok=True)
    for program in (build / "tests/real/panels").glob("*.d"):
        trace = folder / f"{program.stem}.trace"
        for frame in range(12):
            if trace.exists() and subprocess.run(
                [build / "relume", "trim", trace, "-f",
                 str(frame), "-o", cut / f"{trace.stem}.{frame}.trace"], check=False, stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode:
                break
    return sorted(cut.glob("*.trace"))


def made_traces(build, traces, out):
    """The kept inputs of `calls`, `glsl` and `arb`, as recordings."""
    folder = traces / "made"
    folder.mkdir(exist_ok=True)
    for what in ("traces", "programs"):
        subprocess.run([build / "tests/fuzz/make_seeds", what, folder], check=False)
    for number, trace in enumerate(sorted(folder.iterdir())):
        stream = bytes(unpack(trace.read_bytes(), 1 << 16)[:1 << 16])
        (out["replay"] / trace.stem).write_bytes(stream)
        for verb in (STATES, number % STATES):
            (out["verbs"] / f"{trace.stem}.{verb}").write_bytes(bytes([STREAM | verb]) + stream)


def pictures(build, traces, out):
    """Frames by Relume, and conversions by oiiotool; the first byte of each is the number of its name's ending
    (fuzz_oiio.c)."""
    trace = ROOT / "tests/golden/two_triangles.trace"
    subprocess.run(
        [build / "relume", "render", trace, "-o", traces / "frame.####.exr", "-f", "0", "--device", "reference"],
        check=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for frame in traces.glob("frame.*.exr"):
        (out["exr"] / frame.name).write_bytes(frame.read_bytes())
    first = next(traces.glob("frame.*.exr"), None)
    for number, ending in enumerate(("png", "jpg", "tif", "exr", "bmp", "tga", "gif", "hdr", "webp", "psd", "dds",
                                     "sgi", "pnm", "ico", "dpx", "cin")):
        made = traces / f"x.{ending}"
        if first:
            subprocess.run(["oiiotool", first, "--ch", "R,G,B", "--resize", "24x16", "-o", made], check=False,
                           stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if made.exists():
            (out["oiio"] / ending).write_bytes(bytes([number]) + made.read_bytes())
    for compression in ("none", "rle", "zips", "zip", "piz", "pxr24", "b44", "dwaa"):
        made = traces / f"{compression}.exr"
        if first:
            subprocess.run(
                ["oiiotool", first, "--ch", "R,G,B", "--resize", "24x16", "--compression", compression, "-o", made],
                check=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if made.exists():
            (out["exr"] / made.name).write_bytes(made.read_bytes())
            (out["oiio"] / made.name).write_bytes(b"\3" + made.read_bytes())


def assembly():
    """The texts of ARB assembly programs in tests' sources."""
    for path in [*(ROOT / "tests/real/panels").glob("*.c"), ROOT / "tests/gl/test_programs.c"]:
        literals = re.sub(r'"\s*\n\s*"', "", path.read_text())
        for text in re.findall(r'"(!!ARB[vf]p1\.0(?:[^"\\]|\\.)*)"', literals):
            yield text.replace("\\n", "\n")


def make_seeds(build, folder):
    """Run once; the folders' names end with the targets' names."""
    names = ("calls", "replay", "container", "verbs", "index", "snapshot", "ref", "exr", "oiio", "look", "rules",
             "baseline", "json", "gltf", "tree", "outcome", "farm", "recorder", "glsl", "arb")
    out = {name: folder / f"seeds_{name}" for name in names}
    done = folder / "seeds_made"
    if done.exists():
        return
    for path in out.values():
        path.mkdir(parents=True, exist_ok=True)
    traces = folder / "traces"
    record(build, traces)
    golden, panels = list((ROOT / "tests/golden").glob("*.trace")), cut_panels(build, traces)
    made_traces(build, traces, out)
    for trace in [*golden, *traces.glob("*.trace"), *panels]:
        data = trace.read_bytes()
        try:
            stream = unpack(data, 1 << 16)[:1 << 16]
        except (AssertionError, IndexError):
            continue
        (out["replay"] / trace.stem).write_bytes(stream)
        if len(data) <= 1 << 16:
            (out["container"] / trace.stem).write_bytes(data)
            (out["verbs"] / trace.stem).write_bytes(bytes([len(data) % VERBS]) + data)
        if trace in panels:
            for verb in (SCENE, STATES):
                (out["verbs"] / f"{trace.stem}.{verb}").write_bytes(bytes([verb]) + data)
    for number, trace in enumerate(golden):
        stream = bytes(unpack(trace.read_bytes()))
        (out["container"] / f"{trace.stem}.gz").write_bytes(gzip.compress(stream))
        subprocess.run(["brotli", "-f", "-o", out["container"] / f"{trace.stem}.br", "-"], input=stream,
                       check=False) if pathlib.Path("/usr/bin/brotli").exists() else None
        for verb in range(VERBS):
            (out["verbs"] / f"{trace.stem}.{verb}").write_bytes(bytes([verb]) + trace.read_bytes())
        subprocess.run([build / "tests/fuzz/make_seeds", "index", trace, out["index"] / str(number)], check=False)
    subprocess.run([build / "tests/fuzz/make_seeds", "snapshot", out["snapshot"]], check=False)
    subprocess.run([build / "tests/fuzz/make_seeds", "tree", out["tree"] / "whole"], check=False)
    for ref in sorted(traces.glob("*.ref"), key=lambda path: path.stat().st_size)[:8]:
        (out["ref"] / ref.stem).write_bytes(ref.read_bytes()[:100_000])
    pictures(build, traces, out)
    for number, calls in enumerate(read_pack(HERE / "kept_calls")[::5]):
        (out["gltf"] / str(number)).write_bytes(number.to_bytes(4, "little") + calls)
    for number, text in enumerate(assembly()):
        (out["arb"] / str(number)).write_bytes(bytes([text.startswith("!!ARBvp")]) + text.encode())
    (out["look"] / "all").write_bytes(LOOK)
    (out["rules"] / "all").write_bytes(RULES)
    (out["baseline"] / "all").write_bytes(BASELINE)
    (out["ref"] / "small").write_bytes(REF)
    (out["farm"] / "all").write_bytes(FARM)
    (out["json"] / "text").write_bytes("a \"b\" \\ \n\x01 äöü € 😀".encode() + b"\xff\xc0\x80\xed\xa0\x80")
    (out["recorder"] / "all").write_bytes(RECORDER)
    (out["outcome"] / "one").write_bytes(bytes(1 + 3 * 80))
    done.touch()


if __name__ == "__main__":
    make_seeds(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[1]).resolve() / "fuzz")
