#!/usr/bin/python3
"""tests/show/relit.py BUILD [NAME...] (as `make show-relit`): programs of the corpus as their raster frame, as the beauty without rules, and as
the beauty under the rules that `relume look` finds, side by side in BUILD/show/relit/NAME.png, to be looked at. Gate N must pass: no
frame is darker than its shadows explain. Channels of OpenGL's own picture must be the same in both beauties."""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAMS = {**{f"tricks-{kind}": ("tricks", kind) for kind in ("planar", "directional", "zpass", "zfail", "mirror")},
            **{f"rooms-{lighting}": ("rooms", "--seed", 5, "--lighting", lighting, "--mirror", "--shadow", "--environment", "cube")
               for lighting in ("multitexture", "pass", "opengl")},
            "spheres": ("spheres",), "still_life": ("still_life",), "closed_hall": ("closed_hall",), "arena": ("arena",)}
FRAME = 1


def run(*args):
    done = subprocess.run([str(a) for a in args], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1, 4):
        sys.exit(f"{' '.join(map(str, args))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def sheet(frames, out):
    """Raster, beauty, relit: in display colours, side by side."""
    columns = []
    for name, file, channels in (("gl", frames[0], "gl.R,gl.G,gl.B"), ("beauty", frames[0], "R,G,B"), ("relit", frames[1], "R,G,B")):
        picture = out.with_name(f"{out.stem}.{name}.png")
        run("oiiotool", file, "--ch", channels, "--colorconvert", "linear", "sRGB", "-o", picture)
        columns.append(picture)
    run("oiiotool", *columns, "--mosaic:pad=4", "3x1", "-o", out)
    for picture in columns:
        picture.unlink()


def gate(build, trace, folder):
    scored = json.loads(run(build / "relume", "diff", trace, folder, "--json", "-"))["frames"]
    frame = next(f for f in scored if f["frame"] == FRAME)
    return frame["gates"]["N"]["state"], frame["gates"]["R1"]["state"]


def main(build, only):
    rows, bad, out = [], 0, build / "show/relit"
    out.mkdir(parents=True, exist_ok=True)
    for name, program in PROGRAMS.items():
        if only and name not in only:
            continue
        with tempfile.TemporaryDirectory() as folder:
            work, frames = pathlib.Path(folder), []
            trace = work / "x.trace"
            run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", trace, "--ref", "color,depth", "--", build / "corpus" / program[0],
                *program[1:], "--frames", FRAME + 1)
            for kind, look in (("beauty", ()), ("relit", ("--look", "auto"))):
                run(build / "relume", "render", trace, "-f", FRAME, "-o", work / kind / "x.####.exr", *look)
                frames.append(work / kind / f"x.{FRAME:04d}.exr")
            sheet(frames, out / f"{name}.png")
            harm, raster = gate(build, trace, work / "relit")
        passed = harm == "passed" and raster == "passed"
        bad += not passed
        rows.append({"what": f"{name}: gates N, R1 of the relit frame", "figure": f"{harm}, {raster}", "bar": "passed", "peer": None, "passed": passed})
        print(f"{name}: gate N {harm}, gate R1 {raster}; look at {out}/{name}.png", flush=True)
    (build / "show/relit.json").write_text(json.dumps({"name": "relit", "command": "make show-relit", "rows": rows}, indent=1))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), sys.argv[2:]))
