#!/usr/bin/python3
"""tests/show/denoise.py BUILD [--quick] (as `make show-denoise`): 16 denoised samples against many, compared with no
denoiser and with OIDN.

Runs in a virtual environment that has Intel's Open Image Denoise (pyoidn) and NVIDIA's FLIP (flip-evaluator). All
denoisers get the same file; OIDN reads its beauty, albedo and normals. FLIP is the mean over the picture, computed on
sRGB codes.

Flicker is measured over FRAMES frames with a moving camera and with a moving light: FLIP of each frame against the same
frame with the previous frame's error. A constant error does not flicker.

`relume denoise --oidn` and `relume render --oidn`, which is confined, load the same OIDN, and must give its pictures.

Bars: the error of each denoised still picture is at most 1.1 times OIDN's; both films flicker less than without a
denoiser, and less with neighbouring frames than without; --oidn differs from OIDN by at most 1 / 1000.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import flip_evaluator
import numpy
import pyoidn
from display import need_display
from exr_numpy import Image

SIZE, FILM_SIZE = "128x96", "64x48"
SCENES = {
    "box": ("cornell", []), "spheres": ("spheres", []), "still life": ("still_life", []),
    "box, mirror": ("cornell", ["--mirror"])
}
FILMS = {"camera": ["--animate", "camera"], "light": ["--animate", "light"]}
SAMPLES, MANY, FILM_MANY, FRAMES = 16, 4096, 256, 48


def run(*command, env=None):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, errors="replace",
                          check=False, env=env)
    if done.returncode:
        sys.exit(f"{command[0]} exits with {done.returncode}:\n{done.stdout[-1500:]}{done.stderr[-1500:]}")


def planes(path, *names):
    found = Image(path).planes
    return numpy.stack([found[name].astype("f4") for name in names], -1)


def colors(path):
    return planes(path, *"RGB")


def shown(picture):
    x = numpy.clip(picture, 0, 1)
    return numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055).astype("f4")


def flip(truth, picture):
    return float(flip_evaluator.evaluate(shown(truth), shown(picture), "LDR")[1])


def by_oidn(path):
    return pyoidn.denoise(colors(path), albedo=planes(path, *(f"albedo.{c}" for c in "RGB")),
                          normal=planes(path, *(f"N.{c}" for c in "XYZ")), hdr=True)


def flicker(truths, pictures):
    """Each frame's error, added to the next frame's truth, and that next frame."""
    return float(
        numpy.mean([flip(truths[i + 1] + pictures[i] - truths[i], pictures[i + 1]) for i in range(len(truths) - 1)]))


def record(build, folder, program, size, frames, options):
    run(build / "relume", "record", "-o", folder / "x.trace", "--", build / "corpus" / program, "--frames", frames + 1,
        "--size", size, *options)


def render(build, folder, name, frames, samples, *more, env=None):
    run(build / "relume", "render", folder / "x.trace", "-f", frames, "-o", folder / name, "--mode", "path",
        "--samples", samples, *more, env=env)


def loaded(build, rows):
    """OIDN loaded by relume, compared with OIDN itself."""
    env = os.environ | {"LD_LIBRARY_PATH": str(pathlib.Path(pyoidn.__file__).parent / "oidn/lib")}
    with tempfile.TemporaryDirectory(prefix="relume-") as scratch:
        folder = pathlib.Path(scratch)
        record(build, folder, "cornell", SIZE, 1, [])
        render(build, folder, "noisy.exr", 1, SAMPLES)
        render(build, folder, "render.exr", 1, SAMPLES, "--oidn", env=env)
        run(build / "relume", "denoise", folder / "noisy.exr", "-o", folder / "denoise.exr", "--oidn", env=env)
        own, noisy = by_oidn(folder / "noisy.exr"), colors(folder / "noisy.exr")
        most = {n: float(numpy.abs(colors(folder / f"{n}.exr") - own).max()) for n in ("render", "denoise")}
    passed = max(most.values()) <= 1e-3 < float(numpy.abs(noisy - own).max())
    print(
        f"\n--oidn differs from OIDN by {most['render']:.5f} in relume render, by {most['denoise']:.5f} in relume "
        f"denoise, at most",
        flush=True)
    rows.append({
        "what": "--oidn against OIDN itself, largest difference of a pixel: render; denoise",
        "figure": f"{most['render']:.5f}; {most['denoise']:.5f}", "bar": "0.001", "peer": None, "passed": passed
    })
    return passed


def stills(build, many, rows):
    good = True
    print(
        f"{'FLIP at ' + SIZE:16}{'noisy':>9}{'ours':>9}{'OIDN':>9}{'OIDN, no guides':>17}   mean squared errors: "
        f"noisy, ours, OIDN"
    )
    for name, (program, options) in SCENES.items():
        with tempfile.TemporaryDirectory(prefix="relume-") as scratch:
            folder = pathlib.Path(scratch)
            record(build, folder, program, SIZE, 1, options)
            render(build, folder, "truth.exr", 1, many, "--aov", "gl")
            render(build, folder, "noisy.exr", 1, SAMPLES)
            run(build / "relume", "denoise", folder / "noisy.exr", "-o", folder / "clean.exr")
            truth, noisy, clean = (colors(folder / f"{n}.exr") for n in ("truth", "noisy", "clean"))
            oidn, alone = by_oidn(folder / "noisy.exr"), pyoidn.denoise(noisy, hdr=True)
        figures = [flip(truth, p) for p in (noisy, clean, oidn, alone)]
        squares = [float(((p - truth) ** 2).mean()) for p in (noisy, clean, oidn)]
        passed = figures[1] <= 1.1 * figures[2]
        good &= passed
        print(
            f"{name:16}{figures[0]:9.4f}{figures[1]:9.4f}{figures[2]:9.4f}{figures[3]:17.4f}   "
            f"{', '.join(f'{s:.6f}' for s in squares)}",
            flush=True)
        rows.append({
            "what": f"{name}: FLIP of {SAMPLES} samples denoised against {many}", "figure": f"{figures[1]:.4f}",
            "bar": f"{1.1 * figures[2]:.4f}",
            "peer": f"OIDN {figures[2]:.4f} (without guides {figures[3]:.4f}); noisy {figures[0]:.4f}", "passed": passed
        })
    return good


def films(build, many, frames, rows):
    good = True
    print(
        f"\n{f'flicker, {frames} frames':16}{'noisy':>9}{'alone':>9}{'in time':>9}{'OIDN':>9}   FLIP: noisy, alone, "
        f"in time, OIDN"
    )
    for name, options in FILMS.items():
        with tempfile.TemporaryDirectory(prefix="relume-") as scratch:
            folder, span = pathlib.Path(scratch), f"1-{frames}"
            record(build, folder, "cornell", FILM_SIZE, frames, options)
            render(build, folder, "truth/####.exr", span, many, "--aov", "gl")
            render(build, folder, "noisy/####.exr", span, SAMPLES, "--aov", "reflect,refract,albedo,N,Z,motion")
            run(build / "relume", "denoise", folder / "noisy", "-o", folder / "alone/####.exr", "--no-time")
            run(build / "relume", "denoise", folder / "noisy", "-o", folder / "time/####.exr")
            told = {
                n: [colors(folder / n / f"{i:04}.exr")
                    for i in range(1, frames + 1)]
                for n in ("truth", "noisy", "alone", "time")
            }
            told["oidn"] = [by_oidn(folder / "noisy" / f"{i:04}.exr") for i in range(1, frames + 1)]
        kinds = ("noisy", "alone", "time", "oidn")
        figures = {n: flicker(told["truth"], told[n]) for n in kinds}
        means = [float(numpy.mean([flip(t, p) for t, p in zip(told["truth"], told[n])])) for n in kinds]
        passed = figures["time"] < figures["alone"] < figures["noisy"]
        good &= passed
        print(
            f"{name:16}" + "".join(f"{figures[n]:9.4f}" for n in kinds) + "   " + ", ".join(f"{m:.4f}" for m in means),
            flush=True)
        rows.append({
            "what": f"flicker over {frames} frames, moving {name}: single frames; with neighbours",
            "figure": f"{figures['alone']:.4f}; {figures['time']:.4f}",
            "bar": f"below {figures['noisy']:.4f}; below single frames",
            "peer": f"OIDN {figures['oidn']:.4f}; noisy {figures['noisy']:.4f}", "passed": passed
        })
    return good


def main(build, quick):
    need_display()
    build, rows = build.resolve(), []
    good = stills(build, 256 if quick else MANY, rows)
    good &= films(build, 64 if quick else FILM_MANY, 6 if quick else FRAMES, rows)
    good &= loaded(build, rows)
    out = build / "show" / "denoise.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps({"name": "denoise", "command": "make show-denoise", "rows": rows}, indent=1) + "\n")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), "--quick" in sys.argv[2:]))
