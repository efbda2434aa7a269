#!/usr/bin/python3
# limit: 300 s
"""Devices as listed by `relume devices` and named by --device; one that lacks memory; one of two that fails during a
run."""
import json
import os
import pty
import re
import subprocess

from helpers import BUILD, RELUME, SCRATCH, check, corpus, finish, must, record, relume

trace = SCRATCH / "two.trace"
FRAMES = 40
record(trace, corpus("two_triangles"), "--frames", str(FRAMES), options=())


def fake(**more):
    return dict(os.environ, LD_PRELOAD=str(BUILD / "tests/real/failing_cl.so"), **more)


def files(folder):
    return {p.name: p.read_bytes() for p in folder.iterdir()} if folder.is_dir() else {}


def render(folder, *options, env=None):
    return relume("render", trace, "-o", SCRATCH / folder / "x.{frame}.exr", *options, env=env)


def devices(env=None):
    return json.loads(must(relume("devices", "--json", env=env)).stdout)


must(render("whole", "-f", "0-1"))
whole = files(SCRATCH / "whole")

# The listed properties, and how devices can be named.
for kind, family in (("cpu", "packets"), ("gpu", "compressed"), ("accelerator", "compressed")):
    env = None if kind == "cpu" else fake(AS_TYPE=kind)
    listed = devices(env)
    check(all(d["type"] == kind and d["kernels"] == family for d in listed), f"{kind}: {listed}")
    text = must(relume("devices", env=env)).stdout
    check(
        all(
            re.search(rf"^{d['number']}  {kind}  .*{re.escape(d['name'])}.* kernels: {family} ", text, re.M)
            for d in listed), text)
    # A device of another type runs other kernels, in other groups, and gives the same pictures.
    for choice in ("0", kind, kind.upper(), listed[0]["name"][:12]):
        must(render(f"{kind}-{choice}", "-f", "0-1", "--device", choice, env=env))
        check(files(SCRATCH / f"{kind}-{choice}").keys() == whole.keys(), f"--device {choice}: frames")
    other = {n for n, data in files(SCRATCH / f"{kind}-{kind}").items() if data != whole[n]}
    check(not other, f"a device of type {kind} writes other files: {other}")
done = must(relume("bench", "--models", "", "--repeat", 1, "--json", env=fake(AS_TYPE="gpu"), timeout=150))
measured = {figure["kernel"] for figure in json.loads(done.stdout)["figures"]}
check(
    "camera_compressed" in measured
    and not measured & {"camera_packet", "occlude_packet", "occlude_wide", "intersect_packet", "intersect_wide"},
    f"bench on a GPU: {sorted(measured)}")
for d in devices():
    check(d["memory_bytes"] >= d["buffer_bytes"] > 0 and d["width"] in (1, 4, 8, 16) and d["units"] > 0,
          f"device properties: {d}")
for choice in ("gpu", "accelerator", "77", "no such name"):
    done = render("none", "-f", "0", "--device", choice)
    check(done.returncode == 2 and "relume devices" in done.stderr and done.stderr.count("\n") == 1,
          f"--device {choice}: {done.stderr}")

# On a terminal, a line names each file that takes longer than a second to compile.
terminal, end = pty.openpty()
done = subprocess.run([RELUME, "render", trace, "-f", "0", "-o", SCRATCH / "slow.#.exr", "--no-cache"],
                      env=fake(SLOW_BUILD="1"), stderr=end, stdin=subprocess.DEVNULL, timeout=150, check=False)
os.close(end)
said = os.read(terminal, 65536).decode()
check(done.returncode == 0 and re.search(r"compiling kernels for this device, once: kernels/[\w/]+_packet.cl", said),
      f"slow to compile: {said}")
for style, lines in (("lines", 1), ("none", 0)): # printed once if there is no progress bar
    done = relume("render", trace, "-f", "0", "-o", SCRATCH / "slow.#.exr", "--no-cache", "--mode", "gl", "--progress",
                  style, env=fake(SLOW_BUILD="5"))
    check(done.returncode == 0 and done.stderr.count("compiling kernels for this device, once") == lines,
          f"slow to compile, --progress {style}: {done.stderr}")

# Missing memory is reported before it is used, in one line.
for name, words in (("AS_MEMORY", "are needed on this device, which has 2"), ("AS_BUFFER",
                                                                              "makes none of more than 2")):
    done = render("small", "-f", "0", "-j", "1", env=fake(**{name: str(5 << 19)}))
    lines = [line for line in done.stderr.splitlines() if line.startswith("relume: ")]
    check(done.returncode == 5 and len(lines) == 1 and words in lines[0],
          f"{name}: exit code {done.returncode}, {done.stderr}")
    check(not files(SCRATCH / "small"), f"{name}: files were written")

# Messages distinguish between no driver and a driver without a device.
(SCRATCH / "vendors").mkdir()
for name, env, words in (("no driver", {"OCL_ICD_VENDORS": str(SCRATCH / "vendors")},
                          "there is no driver here (CL_PLATFORM_NOT_FOUND)"),
                         ("no device", {"POCL_DEVICES": "none"},
                          "1 driver is installed, without a device here (CL_DEVICE_NOT_FOUND)")):
    done = render("none", "-f", "0", env=dict(os.environ, **env))
    check(done.returncode == 5 and words in done.stderr, f"{name}: exit code {done.returncode}, {done.stderr}")
    check(not files(SCRATCH / "none"), f"{name}: files were written")

# One of two devices fails during a run: the other takes over its frames, and every frame is written.
must(render("alone"))
two = fake(POCL_DEVICES="pthread pthread", FAIL_CALL="61", FAIL_NAME="clEnqueueNDRangeKernel", FAIL_GONE="1",
           FAIL_ONLY="1")
done = render("left", "--device", "all", "-j", "1", env=two)
check(done.returncode == 0, f"one of two devices fails: exit code {done.returncode}: {done.stderr[-600:]}")
check(
    done.stderr.count("CL_OUT_OF_RESOURCES") == 1 and done.stderr.count("not used again") == 1,
    f"the failure is reported once: {done.stderr[-600:]}")
shares = [int(n) for n in re.findall(r"^  device \d+: (\d+) frames?", done.stderr, re.MULTILINE)]
check(len(shares) == 2 and sum(shares) == FRAMES and min(shares) > 0, f"shares {shares}")
check(files(SCRATCH / "left") == files(SCRATCH / "alone"), "one of two devices fails: every frame is complete")
finish()
