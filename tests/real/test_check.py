#!/usr/bin/python3
# limit: 1200 s
"""`relume devices --check`: every family on every installed OpenCL implementation must draw like the C twins. Also: the
family that `relume render` uses after one loses work items, crashes or hangs; and a damaged stored outcome."""
import json
import os
import pathlib
import re

from helpers import BUILD, RELUME, SCRATCH, check, corpus, finish, must, record, relume, run

FAMILIES = ["packets", "binary", "compressed"]
SCENES = ["opaque", "gl", "blended", "stencil", "mirror", "glass", "ao", "path", "linear"]
# Compile kernels once for all tests.
ENV = dict(os.environ, POCL_KERNEL_CACHE="1")


def fake(**more):
    return dict(ENV, LD_PRELOAD=str(BUILD / "tests/real/failing_cl.so"), **more)


def checked(cache, env=ENV, *options):
    """Run --check; returns the exit code, devices as JSON, and the output."""
    done = run(RELUME, "devices", "--check", "--json", "--cache", cache, *options, env=env, timeout=1000)
    try:
        return done.returncode, json.loads(done.stdout), done.stderr
    except ValueError:
        check(False, f"--check leaves no JSON: exit code {done.returncode}: {done.stderr}")
        finish()


def states(device):
    return {family["kernels"]: family["state"] for family in device["families"]}


# --- The matrix: device x family x scene, each implementation separately.
for vendor in (pathlib.Path(name) for name in os.environ.get("RELUME_VENDORS", "").split(":") if name):
    folder = SCRATCH / vendor.stem
    folder.mkdir()
    (folder / vendor.name).write_text(vendor.read_text())
    env = dict(ENV, OCL_ICD_VENDORS=str(folder), OPENCL_VENDOR_PATH=str(folder))
    if run(RELUME, "devices", env=env).returncode:
        print(f"{vendor.name}: no device here")
        continue
    code, devices, said = checked(SCRATCH / "matrix", env)
    check(code == 0 and not said, f"{vendor.name}: --check ends with {code}: {said}")
    for device in devices:
        check([f["kernels"] for f in device["families"]] == FAMILIES,
              f"families of {device['name']}: {device['families']}")
        for family in device["families"]:
            check(list(family["scenes"]) == SCENES, f"scenes: {list(family['scenes'])}")
            for scene, state in family["scenes"].items():
                check(state == "right", f"{device['name']}, {family['kernels']}, {scene}: {state}")
            check(family["frame_ms"] > 0 and family["compile_s"] >= 0,
                  f"{device['name']}, {family['kernels']}: times {family}")

# --- A device of another type: packets are skipped, and the other families are right.
as_gpu = SCRATCH / "as-gpu"
code, (device,), said = checked(as_gpu, fake(AS_TYPE="gpu"))
check(code == 0 and not said and states(device) == {"packets": "passed over", "binary": "right", "compressed": "right"},
      f"as a GPU: {code}, {device}, {said}")
check(set(device["families"][0]["scenes"].values()) == {"not tried"}, f"packets on a GPU: {device['families'][0]}")

# --- Effect on render, with PoCL.
trace = SCRATCH / "two.trace"
record(trace, corpus("two_triangles"), "--frames", "1", options=())


def render(cache, *options, env=ENV):
    out = SCRATCH / "frames"
    for old in out.glob("*.exr"):
        old.unlink()
    done = relume("render", trace, "-o", out / "x.#.exr", "--progress", "none", *options,
                  *(("--cache", cache) if cache else ()), env=env)
    return done, [p.read_bytes() for p in out.glob("*.exr")]


def said_once(done, *words):
    return done.stderr.count("\n") == 1 and all(word in done.stderr for word in words)


done, want = render(SCRATCH / "nothing")
check(done.returncode == 0 and not done.stderr, f"without an outcome: {done.stderr}")

done, found = render(as_gpu, "--kernels", "packets", env=fake(AS_TYPE="gpu"))
check(done.returncode == 0 and found == want and not done.stderr, f"packets on a GPU on request: {done.stderr}")

# The family chosen for a CPU loses lanes: another one is used, and render reports it once; the pictures are the same.
LOST = fake(EDIT="(uint)(lanes >> i) & 1u|(uint)(lanes >> i) & i & 1u")
lost = SCRATCH / "lost"
code, (device,), said = checked(lost, LOST)
check(code == 1 and states(device) == {"packets": "wrong", "binary": "right", "compressed": "right"},
      f"packets lose lanes: {code}, {device}")
scenes = device["families"][0]["scenes"]
check(scenes["ao"] == "wrong" and set(scenes.values()) <= {"right", "wrong"},
      f"shadow packets lose lanes: {scenes}")
check(device["kernels"] in ("binary", "compressed"), f"packets lose lanes, and the device runs {device['kernels']}")
listed = must(relume("devices", "--cache", lost, env=ENV)).stdout
check(f"kernels: {device['kernels']}, as checked" in listed, f"the list names render's choice: {listed}")
done, found = render(lost, env=LOST)
check(
    done.returncode == 0
    and said_once(done, f"--kernels {device['kernels']}", "packets", "relume devices --check", "wrong"),
    f"packets are wrong: {done.stderr}")
check(found == want, "another family after an outcome: the picture differs")
done, found = render(lost, "--kernels", "packets")
check(done.returncode == 0 and found == want and said_once(done, "warning", "--kernels packets", "wrong"),
      f"--kernels packets all the same: {done.stderr}")
done, found = render(lost, "--kernels", "binary")
check(done.returncode == 0 and found == want and not done.stderr, f"--kernels binary, which is right: {done.stderr}")
done, found = render(lost, "--device", "reference")
check(done.returncode == 0 and found and not done.stderr, f"the reference device has no outcome: {done.stderr}")
done, found = render(None, "--no-cache")
check(done.returncode == 0 and found == want and not done.stderr, f"--no-cache: {done.stderr}")

# An outcome that is damaged, cut or from another driver is ignored; the next check rewrites it.
(kept,) = lost.glob("*.outcome")
whole = kept.read_bytes()
for what, data in (("damaged", whole[:60] + bytes([whole[60] ^ 1]) + whole[61:]), ("cut", whole[:100]), ("empty", b"")):
    kept.write_bytes(data)
    done, found = render(lost)
    check(done.returncode == 0 and found == want and not done.stderr,
          f"a {what} outcome: exit code {done.returncode}, {[len(f) for f in found]} bytes: {done.stderr}")
done, found = render(lost, env=fake(AS_DRIVER="2.0"))
check(done.returncode == 0 and found and not done.stderr, f"another driver: {done.stderr}")
kept.write_bytes(b"")
code, (device,), said = checked(lost, fake(DIE="compressed", HANG="occlude_packet"), "--timeout", "60")
check(code == 1 and states(device) == {"packets": "late", "binary": "right", "compressed": "failed"},
      f"one crashes, one hangs: {code}, {device}")
# Kernels that were launched with it, if any, are listed too: the driver may have been executing them.
check(re.search(r"SIGABRT in .*camera_compressed", device["families"][2]["where"]),
      f"the kernel that crashes is named: {device['families'][2]}")
check(device["kernels"] == "binary", f"one crashes, one hangs, and the device runs {device['kernels']}")
check(len(list(lost.glob("*.outcome"))) == 1 and kept.read_bytes() != b"", "a damaged outcome is written again")
done, found = render(lost)
check(done.returncode == 0 and found == want and said_once(done, "not done in time", "--kernels binary"),
      f"one crashes, one hangs: {done.stderr}")

# If no family is right: an error that names the way out.
code, (device,), said = checked(SCRATCH / "none", fake(DIE="resolve"))
check(code == 5 and device["kernels"] == "none" and "--device reference" in said,
      f"no family is right: {code}, {device}, {said}")
done, found = render(SCRATCH / "none")
check(done.returncode == 5 and not found and said_once(done, "--device reference", "relume devices --check"),
      f"no family is right: {done.returncode}, {done.stderr}")
done, found = render(SCRATCH / "none", "--device", "reference")
check(done.returncode == 0 and found and not done.stderr, f"no family is right, --device reference: {done.stderr}")
done, found = render(SCRATCH / "none", "--kernels", "binary")
check(done.returncode == 0 and found == want and said_once(done, "warning"),
      f"no family is right, one is requested: {done.stderr}")

for options, words in ((("--device", "no such name"), "relume devices"), (("--timeout", "soon"), "--timeout")):
    done = relume("devices", "--check", *options)
    check(done.returncode == 2 and done.stderr.count("\n") == 1 and words in done.stderr, f"{options}: {done.stderr}")
finish()
