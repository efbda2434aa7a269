#!/usr/bin/python3
"""test_host.py [BUILD] (with BUILD as `make show-host`): the kernels' text compiled to processor code by clang.

host_cl.c is an OpenCL device in this process. Kernels are compiled for it with every freedom that OpenCL C leaves to a
device, one build after the other. Each build must agree with the C twins: `tiny` with every family, to the bit if the
build rounds like the twins, and the tests of tests/check that compare devices with twins. UndefinedBehaviorSanitizer
checks the first build; new buffers and variables have poisoned contents.

The test runs two builds. `make show-host` runs all of them, and frames of recordings too.

limit: 300 s
"""
import json
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "tests/real"), str(ROOT / "tests/check")]
import exr  # noqa: E402
import host  # noqa: E402

SHOW = len(sys.argv) > 1
BUILD = pathlib.Path(sys.argv[1] if SHOW else os.environ.get("RELUME_BUILD", ROOT / "build")).resolve()
SCRATCH = pathlib.Path(os.environ.get("TMPDIR", "/tmp"))
FAMILIES = ("packets", "binary", "compressed")
SANITIZE = ["-fsanitize=undefined,float-cast-overflow", "-fsanitize-minimal-runtime"]

# Builds: options, environment, whether results equal the twins' to the bit.
BUILDS = {
    "sanitized, not optimised": (["-O0", *SANITIZE], {}, True),
    "this processor, other NaN, zeros and ulps": (["-O0", "-march=native", "-ffp-contract=on", "-DHOST_OTHERWISE"],
                                                  {"HOST_CL_FLUSH": "1"}, False),
}
if SHOW:
    BUILDS |= {
        "optimised, contraction where the pragma allows it": (["-O2", "-march=native", "-ffp-contract=on"], {}, True),
        "vectors of the language alone": (["-O1", "-DLANES_PORTABLE"], {}, True),
        "AVX2, sanitized, nothing inlined": (["-O1", "-mavx2", "-mfma", "-fno-inline", *SANITIZE], {}, True),
        "AVX2, nothing inlined, all optimised": (["-O3", "-mavx2", "-mfma", "-fno-inline"], {}, True),
        "SSE2, other NaN, zeros and ulps": (["-O2", "-DHOST_OTHERWISE"], {"HOST_CL_FLUSH": "1"}, False),
        "quotients by reciprocals": (["-O2", "-march=native", "-freciprocal-math"], {}, False),
    }
TESTS = ("rays", "camera", "shade", "compose")
RECORDINGS = ("golden/cornell.trace", "golden/two_triangles.trace") if SHOW else ()

if not shutil.which("clang"):
    print("no clang here: kernels are not compiled for this processor")
    sys.exit(77)
checks, wrong = [], []


def run(*command, env=None):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, errors="replace", env=env
                          or os.environ, check=False)
    return done.returncode, done.stdout, done.stderr


def check(good, what):
    checks.append(what)
    if not good:
        wrong.append(what)
        print(f"wrong: {what}", flush=True)


def pictures(text):
    """Lines of tiny about a picture, without the hash and with it."""
    return re.findall(r"^((?:packets|binary|compressed) .*), (all channels .*)$", text, re.MULTILINE)


def frame(trace, *options, env=None):
    folder = pathlib.Path(tempfile.mkdtemp(dir=SCRATCH))
    code, _, said = run(BUILD / "relume", "render", ROOT / "tests" / trace, "-f", "0", "-o", folder / "x.#.exr",
                        "--no-cache", "--no-sandbox", *options, env=env)
    return code, said, folder / "x.0.exr"


def try_build(name, options, more, exact):
    env = host.environment(BUILD, options, **more)
    for family in FAMILIES:
        code, out, said = run(BUILD / "tests/bench/tiny", "0", family, env=env)
        want = pictures(run(BUILD / "tests/bench/tiny", "reference", family)[1])
        got = pictures(out)
        check(code == 0 and len(got) == len(want) > 0, f"{name}: tiny {family} ends with {code}: {said[:2000]}")
        check(got == want if exact else len(got) == len(want), f"{name}: tiny {family}: {got}, the twins have {want}")
    for test in TESTS:
        code, out, said = run(BUILD / "tests/check" / f"test_{test}", env=dict(env, CK_RUN_CASE="devices"))
        check(code == 0 and "Checks: 0" not in out, f"{name}: check/test_{test}: {out[-2000:]}{said[-2000:]}")
    for trace in RECORDINGS:
        _, _, want = frame(trace, "--device", "reference")
        for family in FAMILIES:
            code, said, got = frame(trace, "--kernels", family, env=env)
            check(code == 0, f"{name}: {trace} with {family}: {said}")
            check(not exact or planes(got) == planes(want),
                  f"{name}: {trace} with {family}: the picture differs from the twins'")


def planes(path):
    image = exr.Image(path)
    return image.names, image.planes


for title, (flags, extra, same) in BUILDS.items():
    before = len(wrong)
    try_build(title, flags, extra, same)
    if SHOW:
        print(f"{title}: {'agrees' if len(wrong) == before else 'does not agree'}", flush=True)
if SHOW:
    version = run("clang", "--version")[1].splitlines()[0]
    row = {"what": f"kernels built {len(BUILDS)} ways for {platform.machine()}: comparisons with the C twins that fail",
           "figure": f"{len(wrong)} of {len(checks)}", "bar": "0", "peer": version, "passed": not wrong}
    out = BUILD / "show/host.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps({"name": "host", "command": "make show-host", "rows": [row]}, indent=1) + "\n")
    print(f"{row['what']}: {row['figure']} (bar: {row['bar']}; {row['peer']})")
print(f"{100 * (len(checks) - len(wrong)) // len(checks)}%: Checks: {len(checks)}, Failures: {len(wrong)}, Errors: 0")
sys.exit(1 if wrong else 0)
