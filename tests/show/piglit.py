#!/usr/bin/python3
"""tests/show/piglit.py BUILD record|parity [PART-OF-A-NAME...] (`make show-piglit-record`, `make show-piglit-parity`):
the fixed-function part of piglit.

record: every program runs once bare and once under the recorder; the verdicts, including those of subtests, must be the
same. If they differ, the program runs bare twice more; if its bare verdicts disagree, it is unsteady and does not
count. parity: the recordings of that campaign (made first if this recorder has made none) are rendered, and the last
frame of each is scored against the program's own picture: R1, R1b, R2 and R3. Programs that draw with shaders or ARB
programs are listed separately, and so are pictures of a single colour, which prove little.

Programs run as under `piglit run --no-concurrency`, in a window. piglit never swaps, so a frame ends where a program
reads the pixels that it judges. Recordings are in BUILD/show/piglit, all outcomes in BUILD/show/piglit.tsv and
piglit-parity.tsv. Needs a display: run under tests/xvfb.sh.
"""
import ast
import collections
import gzip
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from replayed import REF_COLOR, records  # noqa: E402

PIGLIT = next(iter(pathlib.Path("/usr/lib").glob("*/piglit")), pathlib.Path("/usr/lib/piglit"))
GROUPS = re.compile(
    r"spec@(!opengl "
    r"(1\.[0-5]|2\.[01])|arb_(depth_texture|draw_buffers|map_buffer_range|multisample|occlusion_query|pixel_buffer_object"
    r"|point_parameters|point_sprite|provoking_vertex|texture_compression|texture_cube_map|texture_env_crossbar|texture_rectangle"
    r"|vertex_array_object|vertex_buffer_object)|apple_vertex_array_object|ati_draw_buffers"
    r"|ext_(fog_coord|framebuffer_blit|framebuffer_object|packed_depth_stencil|texture_compression_s3tc|texture_env_combine"
    r"|texture_lod_bias|texture_srgb|texture_swizzle|vertex_array_bgra)|mesa_pack_invert|nv_primitive_restart"
    r"|nv_texture_env_combine4|sgis_generate_mipmap|3dfx_texture_compression_fxt1)@")
LIMIT_S = 40        # some hang on llvmpipe even without a recorder
RENDER_LIMIT_S = 120
MAX_TRACE_BYTES = 200 << 20
BAR_PARITY = 0.9
PROGRAM_CALLS = {"glLinkProgram", "glLinkProgramARB", "glProgramStringARB", "glEndFragmentShaderATI"}


def find_tests(parts, groups=GROUPS, lists=(("opengl", "gl"),), versions=None):
    """[(name, command)] from the suite's lists and their kinds of tests, each command once. versions: of GLSL,
    compatibility profile only."""
    tests, seen = [], set()
    for test, kind in ((test, kind)
                       for file, kind in lists
                       for test in xml.etree.ElementTree.parse(gzip.open(PIGLIT / "tests" /
                                                                         f"{file}.xml.gz")).getroot().iter("Test")
                       if test.get("type") == kind):
        name, options = test.get("name"), {option.get("name"): option.get("value") for option in test}
        if "command" not in options or not groups.match(name):
            continue
        if versions and (options.get("api") != "'compat'" or options.get("shader_version") not in versions):
            continue
        command = tuple(
            str(PIGLIT / word) if kind == "shader" and "/" in word else word
            for word in ast.literal_eval(options["command"]))
        if not (PIGLIT / "bin" / command[0]).exists():
            continue  # listed, but missing from Debian's package
        if command not in seen and (not parts or any(part in name for part in parts)):
            seen.add(command)
            tests.append((name, command))
    return tests


def run(command, limit_s):
    """(exit code or "timeout", output)."""
    child = subprocess.Popen(list(map(str, command)), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, start_new_session=True,
                             env=dict(os.environ, PIGLIT_SOURCE_DIR=str(PIGLIT)))
    try:
        out, _ = child.communicate(timeout=limit_s)
        return child.returncode, out.decode(errors="replace")
    except subprocess.TimeoutExpired:
        os.killpg(child.pid, signal.SIGKILL)
        out, _ = child.communicate()
        return "timeout", out.decode(errors="replace")


def verdict(code, output):
    """One line: the verdict, the subtests' verdicts and, after an abnormal end, its cause."""
    result, subtests = "none", {}
    for line in re.findall(r"^PIGLIT: (\{.*\})\s*$", output, re.M):
        said = json.loads(line)
        result = said.get("result", result)
        subtests.update(said.get("subtest", {}))
    if code == "timeout":
        result = "timeout"
    elif code < 0 or code >= 128:
        result = f"signal {-code if code < 0 else code - 128}"
    return " ".join([result] + [f"{name}={subtests[name]}" for name in sorted(subtests)])


def fingerprint(build):
    return hashlib.sha256((build / "librelume.so").read_bytes()).hexdigest()


def campaign(build, tests, base):
    shutil.rmtree(base, ignore_errors=True)
    base.mkdir(parents=True)
    rows, begin = [], time.monotonic()
    for number, (name, command) in enumerate(tests, 1):
        program = [PIGLIT / "bin" / command[0], *command[1:], "-auto"]
        row = {"name": name, "command": " ".join(command), "frames": 0, "bare": verdict(*run(program, LIMIT_S))}
        if row["bare"].startswith("timeout"):
            row |= {"recorded": "-", "state": "hangs without the recorder"}
        else:
            work = base / re.sub(r"\W+", "_", name)
            work.mkdir()
            code, out = run([
                build / "relume", "record", "-o", work / "x.trace", "--frame-end", "readpixels", "--ref", "color,depth",
                "--max-size", MAX_TRACE_BYTES, "--", *program
            ], LIMIT_S * 2)
            row["recorded"] = verdict(code, out)
            row["frames"] = max([int(n) for n in re.findall(r"x\.trace: (\d+) frames?", out)] or [0])
            row["state"] = "same"
            if row["recorded"] != row["bare"]:
                again = {verdict(*run(program, LIMIT_S)) for _ in range(2)} | {row["bare"]}
                row["state"] = "unsteady" if len(again) > 1 else "changed"
                (work / "output").write_text(out)
        rows.append(row)
        if row["state"] not in ("same", "unsteady") or number % 25 == 0 or number == len(tests):
            print(
                f"{number}/{len(tests)} {time.monotonic() - begin:.0f} s: {name}: {row['state']}" +
                (f" ({brief(row['bare'])} -> {brief(row['recorded'])})" if row["state"] == "changed" else ""),
                flush=True)
    (base / "runs.json").write_text(json.dumps({"fingerprint": fingerprint(build), "rows": rows}, indent=1))
    return rows


def recorded_rows(build, tests, base):
    """Rows from a campaign of this recorder, or from a new campaign."""
    try:
        kept = json.loads((base / "runs.json").read_text())
    except (OSError, ValueError):
        kept = {"rows": [], "fingerprint": None}
    if kept["fingerprint"] != fingerprint(build):
        kept["rows"] = []
    names = {name for name, _ in tests}
    rows = [row for row in kept["rows"] if row["name"] in names]
    return rows if len(rows) == len(tests) else campaign(build, tests, base)


def brief(said):
    """A verdict without the passing subtests."""
    result, *subtests = said.split(" ")
    odd = [s for s in re.findall(r"\S[^=]*=\w+", " ".join(subtests)) if not s.endswith("=pass")]
    return " ".join([result, *odd]) + (f" of {said.count('=')} subtests" if "=" in said else "")


def write_table(path, columns, rows):
    with open(path, "w", encoding="utf-8") as out:
        for row in [dict(zip(columns, columns)), *rows]:
            out.write("\t".join(str(row.get(c, "")) for c in columns) + "\n")


def one_colour(path, frame):
    """1 if a reference frame has only one colour."""
    return any(number == frame and pixels == pixels[:4] * (width * height)
               for number, width, height, pixels in records(path, REF_COLOR))


def score(build, work, row):
    """Add the score of its last frame to a row."""
    last, relume = str(row["frames"] - 1), build / "relume"
    row["frame"] = last
    code, out = run([relume, "info", "--json", "--all", work / "x.trace"], RENDER_LIMIT_S)
    try:
        info = json.loads(out)
    except ValueError:
        info = {"calls_by_name": [], "unsupported": [{"call": "unreadable"}]}
    row["programs"] = any(call["call"] in PROGRAM_CALLS for call in info["calls_by_name"])
    row["left_out"] = "; ".join(call["call"] for call in info["unsupported"])[:300]
    row["one_colour"] = one_colour(work / "x.ref", int(last))
    shutil.rmtree(work / "frames", ignore_errors=True)
    code, out = run([
        relume, "render", work / "x.trace", "--allow-incomplete", "--mode", "gl", "-f", last, "-o",
        work / "frames" / "x.####.exr"
    ], RENDER_LIMIT_S)
    (work / "log").write_text(out)
    if code != 0:
        row |= {"parity": "not rendered", "why": f"exit {code}"}
        return
    done = subprocess.run([relume, "diff", work / "x.trace", work / "frames", "-f", last, "--json", "-"],
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)
    try:
        frame = json.loads(done.stdout)["frames"][0]
        states = {gate: frame["gates"][gate]["state"] for gate in ("R1", "R1b", "R2", "R3")}
    except (ValueError, KeyError, IndexError):
        row |= {"parity": "not scored", "why": (done.stderr.strip().splitlines() or ["?"])[-1][:200]}
        return
    failed = [gate for gate, state in states.items() if state == "failed"]
    row["parity"] = "fails" if failed or states["R3"] != "passed" else "passes"
    row["why"] = " ".join(failed) + "".join(f"; {b}" for b in frame.get("blame", [])[:1])
    row["fidelity"] = f"{frame['fidelity']:.5f}"


def show(build, name, rows, target):
    (build / "show" /
     f"{name}.json").write_text(json.dumps({"name": name, "command": f"make {target}", "rows": rows}, indent=1) + "\n")
    for row in rows:
        mark = {True: "holds", False: "FAILS", None: "-    "}[row["passed"]]
        print(f"{mark}  {row['what']}: {row['figure']}" + (f" (bar: {row['bar']})" if row["bar"] else ""))
    return 1 if any(row["passed"] is False for row in rows) else 0


def main(build, what, *parts):
    build = pathlib.Path(build).resolve()
    if not (PIGLIT / "bin").is_dir():
        sys.exit("piglit is not installed: make build/deps.piglit")
    base = build / "show" / "piglit"
    tests = find_tests(parts)
    peer = "piglit on Mesa llvmpipe"
    if what == "record":
        rows = campaign(build, tests, base)
        write_table(build / "show" / "piglit.tsv", ("name", "command", "bare", "recorded", "state", "frames"),
                    [row | {"bare": brief(row["bare"]), "recorded": brief(row["recorded"])} for row in rows])
        ran = [row for row in rows if not row["bare"].startswith("timeout")]
        verdicts = collections.Counter(row["bare"].split()[0] for row in ran)
        changed = [row["name"] for row in rows if row["state"] == "changed"]
        unsteady = [row["name"] for row in rows if row["state"] == "unsteady"]
        print("without the recorder:", ", ".join(f"{n} {v}" for v, n in verdicts.most_common()),
              f"; {len(rows) - len(ran)} hang")
        for name in unsteady:
            print(f"unsteady without the recorder: {name}")
        return show(build, "piglit-record", [{
            "what": f"verdicts of {len(ran)} programs that changed under the recorder", "figure": len(changed),
            "bar": "0", "peer": peer, "passed": not changed and bool(ran)
        }], "show-piglit-record")
    rows = [row for row in recorded_rows(build, tests, base) if row["bare"].split()[0] == "pass" and row["frames"]]
    begin = time.monotonic()
    for number, row in enumerate(rows, 1):
        score(build, base / re.sub(r"\W+", "_", row["name"]), row)
        if row["parity"] != "passes" or number % 25 == 0 or number == len(rows):
            told = f"{number}/{len(rows)} {time.monotonic() - begin:.0f} s: {row['name']}: {row['parity']} {row['why']}"
            print(told[:160], flush=True)
        write_table(build / "show" / "piglit-parity.tsv",
                    ("name", "command", "frame", "parity", "why", "fidelity", "programs", "one_colour", "left_out"),
                    rows[:number])
    shown = []
    for title, chosen, bar in (
            ("last frames of fixed-function programs that pass R1 to R3",
             [r for r in rows if not r["programs"] and not r["one_colour"]], BAR_PARITY),
            ("the same, pictures of one colour", [r for r in rows if not r["programs"] and r["one_colour"]], None),
            ("programs that draw with shaders", [r for r in rows if r["programs"]], None)):
        good = sum(r["parity"] == "passes" for r in chosen)
        share = good / len(chosen) if chosen else 0
        shown.append({
            "what": title, "figure": f"{good} of {len(chosen)} ({100 * share:.1f} %)",
            "bar": f"{100 * bar:.0f} %" if bar else None, "peer": peer, "passed": share >= bar if bar else None
        })
    return show(build, "piglit-parity", shown, "show-piglit-parity")


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
