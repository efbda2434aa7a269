#!/usr/bin/python3
"""tests/show/path.py BUILD [--many N] (as `make show-path`): error against time of mode path, compared with Blender's
Cycles, on five scenes.

Cycles renders the frame that `relume export` writes, with OpenGL's lighting: its attenuation of lights, the clear
colour as sky, no ambient light, Lambertian surfaces except for mirrors, glass and blending. Both renderers therefore
converge to the same picture. Bounces (4), the bound on fireflies (off) and the pixel filter (a box) are the same. Each
renderer is compared with itself at MANY samples: the mean squared error over the squared mean. MANY can be 65,536 if
hours are available (--many 65536); the default fits into ten minutes. The noise of the references is printed; it raises
all errors alike.

Time is processor time of all threads, which other load changes little. Start-up is excluded on both sides: Cycles' time
is that of its second render call; ours is the time of N samples minus that of two, times N / (N - 2), because the
second sample loads kernels that the first does not need. For short runs the least of three is used.

Bars: in the time that Cycles takes for SAMPLES, our error is below its own on the box and the hall. On the box, where
both scenes are numerically identical, the references agree within their noise. Our error at that time is interpolated
between sample counts on logarithmic scales.
"""
import json
import math
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

import numpy
from display import need_display
from exr_numpy import Image

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SIZE = (96, 72)
SCENES = {  # name: program, options
    "box": ("cornell", []), "box, mirror": ("cornell", ["--mesh", "--mirror"]), "spheres": ("spheres", []),
    "still life": ("still_life", []), "hall": ("hall", [])
}
COUNTS, SAMPLES, MANY = (4, 16, 64), 16, 1024
BARRED, EQUAL = ("box", "hall"), ("box",)


def run(command):
    """The command's output, and its processor seconds."""
    def used():
        told = resource.getrusage(resource.RUSAGE_CHILDREN)
        return told.ru_utime + told.ru_stime
    before = used()
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, errors="replace",
                          check=False)
    if done.returncode:
        sys.exit(f"{command[0]} exits with {done.returncode}:\n{done.stdout[-1500:]}{done.stderr[-1500:]}")
    return done.stdout, used() - before


def colors(path):
    planes = Image(path).planes
    return numpy.stack([planes[c].astype("f8") for c in "RGB"])


def error(picture, truth):
    return float(((picture - truth) ** 2).mean() / truth.mean() ** 2)


def ours(build, trace, folder, many):
    """{samples: (seconds, picture)}"""
    def render(samples):
        out = folder / f"ours.{samples}.exr"
        _, seconds = run([
            build / "relume", "render", trace, "-f", "1", "-o", out, "--mode", "path", "--clamp", "0", "--samples",
            samples, "--aov", "gl"
        ])
        return colors(out), seconds
    render(2)  # compile the kernels before measuring
    start = min(render(2)[1] for _ in range(3))
    found = {}
    for samples in (*COUNTS, many):
        times = [render(samples) for _ in range(3 if samples <= SAMPLES else 1)]
        seconds = min(seconds for _, seconds in times)
        found[samples] = max(seconds - start, 1e-3) * samples / (samples - 2), times[0][0]
    return found


def cycles(build, trace, folder, many):
    file, frame = folder / "scene.glb", folder / "scene.json"
    run([build / "relume", "export", "-f", "1", "-o", file, trace])
    frame.write_text(run([build / "relume", "scene", "--json", "-f", "1", trace])[0])
    said, _ = run([
        "blender", "--background", "--factory-startup", "--python", ROOT / "tests/show/path_in_blender.py", "--", file,
        frame, folder / "cycles", *COUNTS, many
    ])
    told = re.search(r"^RENDERED (.*)$", said, re.MULTILINE)
    if not told:
        sys.exit(f"Blender did not render:\n{said[-1500:]}")
    told = json.loads(told.group(1))
    return {int(n): (seconds, colors(folder / f"cycles.{n}.exr"))
            for n, seconds in told["seconds"].items()}, told["version"]


def curve(found, many):
    """[(seconds, error)] by number of samples."""
    return [(found[n][0], error(found[n][1], found[many][1])) for n in COUNTS]


def at_time(points, seconds):
    """The error at a time, extrapolated or interpolated from the two nearest points."""
    i = min(max(sum(s < seconds for s, _ in points), 1), len(points) - 1)
    (s0, e0), (s1, e1) = points[i - 1:i + 1]
    return math.exp(math.log(e0) + math.log(e1 / e0) * math.log(seconds / s0) / math.log(s1 / s0))


def apart(mine, theirs, noise):
    """The relative difference of the pictures' means, and the mean squared difference without edge pixels, with the
    part that noise explains."""
    mean = float(mine.mean() / theirs.mean() - 1)
    off = ((mine - theirs) ** 2).mean(0) / theirs.mean() ** 2
    return mean, float(numpy.sort(off.ravel())[:off.size * 9 // 10].mean()), noise


def main(build, many):
    need_display()
    build, rows, good = build.resolve(), [], True
    print(
        f"{SIZE[0]} x {SIZE[1]} pixels; seconds of the processor and error at {', '.join(map(str, COUNTS))} samples, "
        f"against {many}"
    )
    for name, (program, options) in SCENES.items():
        with tempfile.TemporaryDirectory(prefix="relume-") as scratch:
            folder = pathlib.Path(scratch)
            trace = folder / "scene.trace"
            run([
                build / "relume", "record", "-o", trace, "--", build / "corpus" / program, "--frames", "2", "--size",
                "x".join(map(str, SIZE)), *options
            ])
            mine = ours(build, trace, folder, many)
            theirs, version = cycles(build, trace, folder, many)
        here, there = curve(mine, many), curve(theirs, many)
        seconds, bar = there[COUNTS.index(SAMPLES)]
        figure = at_time(here, seconds)
        passed = figure < bar if name in BARRED else None
        good &= passed is not False
        for who, points in (("Relume", here), ("Cycles", there)):
            print(f"{name if who == 'Relume' else '':14}{who:8}" + "".join(f"{s:9.2f} s {e:8.5f}" for s, e in points),
                  flush=True)
        # noise falls at least in proportion to the number of samples
        noise = sum(points[-1][1] * COUNTS[-1] / many for points in (here, there))
        mean, off, noise = apart(mine[many][1], theirs[many][1], noise)
        same = abs(mean) < 0.005 and off < 3 * noise if name in EQUAL else None
        good &= same is not False
        print(
            f"{'':14}at {seconds:.2f} s {figure:.5f} and {bar:.5f}: {bar / figure:.2f} times lower; references: means "
            f"{100 * mean:+.2f} % apart, "
            f"pixels {off:.6f}, their noise {noise:.6f}", flush=True)
        rows.append({
            "what": f"{name}: error at the time that Cycles takes for {SAMPLES} samples, against {many}",
            "figure": f"{figure:.5f}", "bar": f"below {bar:.5f}" if name in BARRED else None,
            "peer": f"Cycles {version} {bar:.5f} in {seconds:.2f} s", "passed": passed
        })
        rows.append({
            "what": f"{name}: difference of references: mean; mean square over nine tenths of the pixels",
            "figure": f"{100 * mean:+.2f} %; {off:.6f}", "bar": f"0.5 %; {3 * noise:.6f}" if name in EQUAL else None,
            "peer": None, "passed": same
        })
    out = build / "show" / "path.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps({"name": "path", "command": "make show-path", "rows": rows}, indent=1) + "\n")
    return 0 if good else 1


if __name__ == "__main__":
    asked = sys.argv[2:]
    sys.exit(main(pathlib.Path(sys.argv[1]), int(asked[1]) if asked[:1] == ["--many"] else MANY))
