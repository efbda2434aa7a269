#!/usr/bin/env python3
"""tests/show/metrics.py BUILD (as `make show-metrics`, in its virtual environment): metrics against other
implementations.

Ten pairs of pictures: reference frames of two live recordings, each against five changed copies. FLIP is compared with
its authors' package; PSNR, SSIM and CIEDE2000 with scikit-image; MS-SSIM with its definition in SciPy; RMSE and MRSE
with NumPy; Yee's metric with idiff -p; HDR-FLIP with the authors' package at the same exposures. Then the time on one
core for one pair of 1920 x 1080.
"""
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

import numpy
import scipy.ndimage
import skimage.color
import skimage.metrics
import flip_evaluator

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/show"))
sys.path.insert(0, str(ROOT / "tests/real"))
import exr_numpy as exr  # noqa: E402
from replayed import REF_COLOR, records  # noqa: E402

MS_WEIGHTS = (0.0448, 0.2856, 0.3001, 0.2363, 0.1333)
SPEED_RUNS = 3


def run(*command, **more):
    done = subprocess.run([str(c) for c in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, timeout=900, **more)
    return done


def must(*command, **more):
    done = run(*command, **more)
    if done.returncode != 0:
        sys.exit(f"{command}: exit code {done.returncode}\n{done.stderr}")
    return done


def last_reference(path):
    """The last colour frame of a .ref file, as codes."""
    *_, (_, width, height, pixels) = records(path, REF_COLOR)
    return numpy.frombuffer(pixels, "u1").reshape(height, width, 4)[::-1, :, :3].copy()


def changed_copies(codes):
    rng = numpy.random.default_rng(7)
    f = codes.astype(numpy.float64)

    def rounded(x):
        return numpy.clip(numpy.round(x), 0, 255).astype("u1")

    yield numpy.roll(codes, 1, axis=1)
    yield rounded(f + rng.normal(0, 6, f.shape))
    yield rounded(255 * (f / 255) ** 1.1)
    yield rounded(scipy.ndimage.gaussian_filter(f, (1.2, 1.2, 0)))
    blot = codes.copy()
    blot[40:90, 60:150] = (200, 30, 160)
    yield blot


def linear(codes):
    x = codes / 255
    return numpy.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


def luma(codes):
    return codes.astype(numpy.float64) @ (0.2126, 0.7152, 0.0722)


def ssim_maps(a, b):
    """SSIM and its contrast-structure term, means over whole windows; computed from the definition with SciPy's filter."""
    def blur(x):
        return scipy.ndimage.gaussian_filter(x, 1.5, truncate=5 / 1.5)[5:-5, 5:-5]

    c1, c2 = 2.55 ** 2, 7.65 ** 2
    ma, mb = blur(a), blur(b)
    va, vb, cov = blur(a * a) - ma * ma, blur(b * b) - mb * mb, blur(a * b) - ma * mb
    cs = (2 * cov + c2) / (va + vb + c2)
    return (cs * (2 * ma * mb + c1) / (ma * ma + mb * mb + c1)).mean(), cs.mean()


def ms_ssim(a, b):
    result = 1
    for scale, weight in enumerate(MS_WEIGHTS):
        ssim, cs = ssim_maps(a, b)
        result *= max(ssim if scale == 4 else cs, 0) ** weight
        h, w = (a.shape[0] // 2 * 2, a.shape[1] // 2 * 2)
        a, b = ((x[:h:2, :w:2] + x[1:h:2, :w:2] + x[:h:2, 1:w:2] + x[1:h:2, 1:w:2]) / 4 for x in (a, b))
    return result


def lab(codes):
    # sRGB's primaries and white at full precision; scikit-image's own matrix is rounded to six digits
    m = numpy.array(((10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794),
                     (2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897),
                     (1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382)))
    t = linear(codes) @ m.T / m.sum(axis=1)
    f = numpy.where(t > (6 / 29) ** 3, numpy.cbrt(t), t / (3 * (6 / 29) ** 2) + 4 / 29)
    return numpy.stack((116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])), axis=-1)


def flip_mean(a, b, kind, parameters=None):
    """The mean of the error map returned by FLIP's authors' package, and the mean that the package reports.

    The package sums a million errors in single precision. If they are large, its mean differs by about 1e-4 from the
    mean of its map. The comparison uses the map's mean in double precision.
    """
    errors, own, _ = flip_evaluator.evaluate(a, b, kind, applyMagma=False, parameters=parameters or {})
    return float(numpy.mean(errors, dtype="f8")), float(own)


def oracles(a, b, path_a, path_b):
    ra, rb = linear(a), linear(b)
    delta = numpy.sort(skimage.color.deltaE_ciede2000(lab(a), lab(b)).ravel())
    seen = re.search(r"(\d+) pixels .*failed the perceptual test", run("idiff", "-p", path_a, path_b).stdout)
    return {
        "FLIP": flip_mean(a.astype("f4") / 255, b.astype("f4") / 255, "LDR")[0],
        "PSNR": skimage.metrics.peak_signal_noise_ratio(a, b, data_range=255),
        "SSIM": skimage.metrics.structural_similarity(luma(a), luma(b), gaussian_weights=True, sigma=1.5,
                                                      use_sample_covariance=False, data_range=255),
        "MS-SSIM": ms_ssim(luma(a), luma(b)),
        "RMSE": float(numpy.sqrt(((a.astype(float) - b) ** 2).mean()) / 255),
        "MRSE": float(((rb - ra) ** 2 / (ra ** 2 + 0.01)).mean()),
        "CIEDE2000 p95": float(delta[(len(delta) - 1) * 95 // 100]),
        "Yee": float(seen.group(1)) if seen else 0.0,
    }


def ours(frame):
    i = frame["info"]
    return {"FLIP": frame["gates"]["P"]["figures"][0]["value"], "PSNR": i["gl_psnr_db"], "SSIM": i["gl_ssim"],
            "MS-SSIM": i["beauty_ms_ssim"], "RMSE": i["gl_rmse"], "MRSE": i["gl_mrse"],
            "CIEDE2000 p95": i["beauty_ciede_p95"], "Yee": i["gl_yee"]}


def hdr_pair(build, work, trace):
    """HDR-FLIP of gate B: a rendered frame, made four times as bright, as if rendered by another device."""
    relume = build / "relume"
    must(relume, "render", trace, "-f", "0", "-o", work / "hdr" / "h.####.exr")
    must(relume, "approve", work / "hdr", work / "approved")
    image = exr.Image(work / "hdr" / "h.0000.exr")
    before = numpy.stack([image.planes[c].astype("f4") for c in "RGB"], axis=-1)
    rng = numpy.random.default_rng(3)
    for c in "RGB":
        p = image.planes[c].astype("f4")
        image.planes[c] = (4 * p * rng.uniform(0.8, 1.2, p.shape)).astype(image.planes[c].dtype)
    after = numpy.stack([image.planes[c].astype("f4") for c in "RGB"], axis=-1)
    image.header["relume:device"] = ("string", b"another device")
    (work / "hdr2").mkdir()
    exr.write(work / "hdr2" / "h.0000.exr", image)
    done = run(relume, "diff", "--baseline", work / "approved", work / "hdr2", "--json", "-")
    found = json.loads(done.stdout)["frames"][0]["gates"]["B"]["figures"][1]["value"]
    wanted, own = flip_mean(before, after, "HDR", {"startExposure": 0.083, "stopExposure": 3.557, "numExposures": 4})
    return abs(found - wanted), wanted, own


def cpu_seconds(function):
    before = os.times()
    function()
    after = os.times()
    return sum(after[:4]) - sum(before[:4])


def large(image):
    """The frame scaled to 1920 x 1080 by nearest neighbour."""
    h, w = image.planes["R"].shape
    y, x = numpy.arange(1080) * h // 1080, numpy.arange(1920) * w // 1920
    for c in image.planes:
        image.planes[c] = numpy.ascontiguousarray(image.planes[c][y][:, x])
    return image


def speed(build, work):
    image = large(exr.Image(work / "hdr" / "h.0000.exr"))
    exr.write(work / "ref.exr", image, compression="zips")
    rng = numpy.random.default_rng(5)
    for c in "RGB":
        p = image.planes[f"gl.{c}"].astype("f4")
        image.planes[f"gl.{c}"] = (p * rng.uniform(0.98, 1.02, p.shape)).astype("f2")
    exr.write(work / "traced.exr", image, compression="zips")
    pair = []
    for name in ("ref", "traced"):
        rgb = numpy.stack([exr.Image(work / f"{name}.exr").planes[f"gl.{c}"].astype("f8") for c in "RGB"], axis=-1)
        codes = numpy.round(
            255 * numpy.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * numpy.maximum(rgb, 0)**(1 / 2.4) - 0.055))
        pair.append(numpy.clip(codes, 0, 255).astype("u1"))
        exr.write_png(work / f"{name}.png", pair[-1])
    floats = [p.astype("f4") / 255 for p in pair]
    core = sorted(os.sched_getaffinity(0))
    os.sched_setaffinity(0, core[:1])
    times = {"relume diff": [], "FLIP": [], "idiff -p": []}
    for _ in range(SPEED_RUNS):
        times["relume diff"].append(
            cpu_seconds(lambda: run(build / "relume", "diff", work / "ref.exr", work / "traced.exr")))
        times["FLIP"].append(cpu_seconds(lambda: flip_evaluator.evaluate(floats[0], floats[1], "LDR")))
        times["idiff -p"].append(cpu_seconds(lambda: run("idiff", "-p", work / "ref.png", work / "traced.png")))
    os.sched_setaffinity(0, core)
    return {k: statistics.median(v) for k, v in times.items()}


def main(build):
    build = pathlib.Path(build).resolve()
    work = build / "show" / "metrics"
    shutil.rmtree(work, ignore_errors=True)
    for name in ("a", "b"):
        (work / name).mkdir(parents=True)
    pairs = []
    for name, program in (("still_life", [build / "corpus/still_life", "--frames", "1"]), ("glxgears", ["glxgears"])):
        must(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", work / f"{name}.trace", "--ref", "color",
             "--quit-after", 1, "--", *program)
        codes = last_reference(work / f"{name}.ref")
        pairs += [(codes, copy) for copy in changed_copies(codes)]
    for i, (a, b) in enumerate(pairs):
        exr.write_png(work / "a" / f"{i:04}.png", a)
        exr.write_png(work / "b" / f"{i:04}.png", b)
    scored = json.loads(run(build / "relume", "diff", work / "a", work / "b", "--yee", "--json", "-").stdout)["frames"]
    worst = {}
    for i, (a, b) in enumerate(pairs):
        wanted = oracles(a, b, work / "a" / f"{i:04}.png", work / "b" / f"{i:04}.png")
        found = ours(scored[i])
        print(f"pair {i}: " + ", ".join(f"{k} {found[k]:.7g} ({wanted[k]:.7g})" for k in wanted), flush=True)
        for k in wanted:
            worst[k] = max(worst.get(k, 0), abs(found[k] - wanted[k]))
    peers = {"FLIP": "flip-evaluator 1.7", "MS-SSIM": f"SciPy {scipy.__version__}, by definition", "Yee": "idiff -p",
             "RMSE": f"NumPy {numpy.__version__}", "MRSE": f"NumPy {numpy.__version__}"}
    rows = []
    for k, off in worst.items():
        bar = 1e-4 if k == "FLIP" else 1e-6
        rows.append({"what": f"{k}, 10 pairs: largest difference", "figure": f"{off:.2g}", "bar": f"{bar:g}",
                     "peer": peers.get(k, f"scikit-image {skimage.__version__}"), "passed": bool(off <= bar)})
    off, wanted, own = hdr_pair(build, work, work / "still_life.trace")
    rows.append({
        "what": f"HDR-FLIP of gate B, mean {wanted:.7g} (by its own float sum {own:.7g}): difference",
        "figure": f"{off:.2g}", "bar": "0.0001", "peer": "flip-evaluator 1.7", "passed": bool(off <= 1e-4)
    })
    sharma = run(build / "tests/unit/test_metrics")
    rows.append({
        "what": "CIEDE2000, Sharma's 34 pairs", "figure": "all within 5e-5" if sharma.returncode == 0 else "off",
        "bar": "5e-5, as printed", "peer": "Sharma, Wu and Dalal 2005", "passed": sharma.returncode == 0
    })
    times = speed(build, work)
    for peer in ("FLIP", "idiff -p"):
        ratio = times[peer] / times["relume diff"]
        rows.append({
            "what": f"1080p, all gates and FLIP twice, one core, CPU seconds: {times['relume diff']:.2f} against "
            f"{times[peer]:.2f}", "figure": f"{ratio:.2f} times as fast", "bar": ">= 1",
            "peer": {"FLIP": "flip-evaluator 1.7, evaluate() alone"}.get(peer, "idiff -p, PNG"), "passed": ratio >= 1
        })
    (build / "show" / "metrics.json"
     ).write_text(json.dumps({"name": "metrics", "command": "make show-metrics", "rows": rows}, indent=1) + "\n")
    for row in rows:
        print(
            f"{'holds' if row['passed'] else 'FAILS'}  {row['what']}: {row['figure']} (bar {row['bar']}; {row['peer']})"
        )
    return 0 if all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
