#!/usr/bin/python3
"""test_device_faults.py [BUILD] (with BUILD as `make show-device-faults`): devices with little memory, with a watchdog,
and failing calls.

If a frame needs more memory than the device has, it is drawn in smaller bands; if a watchdog would kill a launch, it is
split. Both must give the same bytes. If that does not help, or if an OpenCL call fails, the run ends with exit code 5
and one line; files that exist are complete. `make show-device-faults` tries every call; the test tries about one in
twenty.

limit: 300 s
"""
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shutil
import sys
import tempfile

if len(sys.argv) > 1:
    os.environ["RELUME_BUILD"] = str(pathlib.Path(sys.argv[1]).resolve())
    os.environ.setdefault("TMPDIR", tempfile.mkdtemp(prefix="relume-device-faults-"))

from helpers import BUILD, ROOT, SCRATCH, check, corpus, finish, must, record, relume  # noqa: E402
import exr  # noqa: E402

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/check"))
import host  # noqa: E402

SHIM = BUILD / "tests/real/failing_cl.so"
LOST = ("-5", "-4", "-2", "-36"
        )  # CL_OUT_OF_RESOURCES, CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_DEVICE_NOT_AVAILABLE, CL_INVALID_COMMAND_QUEUE
SHOW = len(sys.argv) > 1
EVERY = 1 if SHOW else 20
rows = []


def planes(folder):
    return {p.name: exr.Image(p).planes for p in sorted(folder.iterdir())} if folder.is_dir() else {}


def files(folder):
    return {p.name: p.read_bytes() for p in folder.iterdir()} if folder.is_dir() else {}


def lines_of(done):
    return [line for line in done.stderr.splitlines() if line]


def render(trace, name, env, *options):
    return relume("render", trace, "-o", SCRATCH / name / "x.####.exr", "-j", "1", "--no-cache", "--progress", "none",
                  *options, env=env, timeout=250)


# --- Little memory, and a watchdog: on top of PoCL -------------------------------------------------------------------

scene = SCRATCH / "scene.trace"
record(scene, corpus("still_life"), "--frames", "2", options=())


def fake(**more):
    return dict(os.environ, LD_PRELOAD=str(SHIM), **more)


COUNT = SCRATCH / "count"
FRAMES = ("-f", "0-1")
must(render(scene, "whole", fake(AS_TYPE="gpu", COUNT_CALLS=str(COUNT)), *FRAMES))
whole = files(SCRATCH / "whole")
check(len(whole) == 2, f"frames {list(whole)}")
_, peak, largest = map(int, COUNT.read_text().split())
SMALL = {
    "a little less memory": {"AS_TYPE": "gpu", "AS_MEMORY": str(peak - 1)},
    "85 % of the memory": {"AS_TYPE": "gpu", "AS_MEMORY": str(int(0.85 * peak))},
    "85 % of the memory, a CPU": {"AS_MEMORY": str(int(0.85 * peak))},
    "smaller buffers": {"AS_TYPE": "gpu", "AS_BUFFER": str(largest - 1)},
    "launches of 1000 work items": {"AS_TYPE": "gpu", "MOST_ITEMS": "1000"},
    "work items of 60 us, and a watchdog": {"AS_TYPE": "gpu", "ITEM_NS": "60000"},
    "one buffer that cannot be made": {
        "FAIL_CALL": "25", "FAIL_NAME": "clCreateBuffer", "FAIL_CODE": "-4", "AS_TYPE": "gpu"
    },
    "one launch that cannot be queued": {"FAIL_CALL": "30", "FAIL_NAME": "clEnqueueNDRangeKernel", "AS_TYPE": "gpu"},
}
for what, env in SMALL.items():
    folder = what.replace(" ", "_")
    done = render(scene, folder, fake(**env), *FRAMES)
    same = files(SCRATCH / folder) == whole
    check(done.returncode == 0 and not done.stderr, f"{what}: exit code {done.returncode}: {done.stderr}")
    check(same, f"{what}: the picture differs")
    rows.append({
        "what": f"a device with {what}", "figure": "the same bytes" if same else "another picture",
        "bar": "the same bytes", "peer": "", "passed": done.returncode == 0 and same
    })
# Too little for the smallest band; work items so slow that every launch is killed.
for what, env, words in (("100 KB of memory", {"AS_MEMORY": "100000"}, "are needed on this device, which has 0"),
                         ("2 MiB of memory", {"AS_MEMORY": str(2 << 20)}, "are needed on this device, which has 2"),
                         ("buffers of 2 KB", {"AS_BUFFER": "2000"}, "makes none of more than 0"),
                         ("launches of 100 work items", {"MOST_ITEMS": "100"}, "CL_OUT_OF_RESOURCES"),
                         ("a watchdog that kills all", {"ITEM_NS": "1000000000"}, "CL_INVALID_COMMAND_QUEUE")):
    folder = what.replace(" ", "_")
    done = render(scene, folder, fake(AS_TYPE="gpu", **env), *FRAMES)
    check(done.returncode == 5 and len(lines_of(done)) == 1 and words in done.stderr,
          f"{what}: exit code {done.returncode}: {done.stderr}")
    check(not files(SCRATCH / folder), f"{what}: files were written: {list(files(SCRATCH / folder))}")
    needed = re.search(r"(\d+) MiB are needed on this device, which has (\d+)", done.stderr)
    check(not needed or int(needed[1]) > int(needed[2]), f"{what}: needs more than available: {done.stderr}")

# --- Every OpenCL call that may fail: a device in this process, which starts quickly ---------------------------------


def try_call(trace, want, kind, n, gone, code):
    """The fault in the outcome when call n fails; "" if there is none."""
    folder = f"{trace.stem}-{kind}-{n}-{gone}"
    env = host.environment(BUILD, ["-O0", "-march=native"], [SHIM], FAIL_CALL=str(n), FAIL_CODE=code)
    if gone:
        env["FAIL_GONE"] = "1"
    if kind == "gpu":
        env["AS_TYPE"] = kind
    try:
        done = render(trace, folder, env, *FRAMES, "--no-sandbox")
    except Exception as error:  # pylint: disable=broad-except
        return f"{error}"
    got = planes(SCRATCH / folder)
    shutil.rmtree(SCRATCH / folder, ignore_errors=True)
    torn = [name for name, image in got.items() if want.get(name) != image]
    if torn:
        return f"torn, or another picture: {torn}: {done.stderr}"
    if done.returncode == 0:  # a refused program or kernel costs one line: another family draws the same
        taken_over = len(lines_of(done)) == 1 and "renders with --kernels" in done.stderr
        return "" if got.keys() == want.keys() and (not done.stderr
                                                    or taken_over) else f"exit code 0, {list(got)}: {done.stderr}"
    return "" if done.returncode == 5 and len(lines_of(done)) == 1 else f"exit code {done.returncode}: {done.stderr}"


def try_calls(trace, kind):
    """Render with each call failing, once and from then on. Returns the number of tries and the faults."""
    env = host.environment(BUILD, ["-O0", "-march=native"], [SHIM], COUNT_CALLS=str(COUNT))
    if kind == "gpu":
        env["AS_TYPE"] = kind
    name = f"{trace.stem}-{kind}"
    must(render(trace, name, env, *FRAMES, "--no-sandbox"))
    want, n_calls = planes(SCRATCH / name), int(COUNT.read_text().split()[0])
    check(len(want) == 2, f"{name}: frames {list(want)}")
    cases = [(n, gone, LOST[(n + gone) % len(LOST)])
             for n in range(1 + (random.randrange(EVERY)), n_calls + 1, EVERY)
             for gone in (0, 1)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        wrong = [(case, what)
                 for case, what in zip(cases, pool.map(lambda c: try_call(trace, want, kind, *c), cases))
                 if what]
    return len(cases), wrong


if shutil.which("clang"):
    calls = SCRATCH / "calls.trace"
    record(calls, BUILD / "tests/real/targets", options=())
    for kind in ("cpu", "gpu"):
        tried, wrong = try_calls(calls, kind)
        check(tried and not wrong,
              f"calls that fail on a {kind}: {len(wrong)} of {tried} end wrongly; (call, gone, code): {wrong[:5]}")
        rows.append({
            "what": f"OpenCL calls that fail on a {kind}: ends other than exit code 5 with one line, or the same "
                    f"picture",
            "figure": f"{len(wrong)} of {tried}", "bar": "0", "peer": "", "passed": not wrong
        })

if SHOW:
    (BUILD / "show").mkdir(exist_ok=True)
    (BUILD / "show/device-faults.json").write_text(
        json.dumps({"name": "device-faults", "command": "make show-device-faults", "rows": rows}, indent=1) + "\n")
    for row in rows:
        print(f"{row['what']}: {row['figure']} (bar: {row['bar']}): {'passed' if row['passed'] else 'FAILED'}")
finish()
