#!/usr/bin/python3
# limit: 900 s
"""OpenCL drivers that crash, hang or return garbage during `relume render`: another family of kernels takes over, one
line reports it, and the next run skips the failed family. If no family can draw a frame, only that frame fails. Signals
reach the worker process, and no process outlives the run."""
import collections
import json
import os
import pathlib
import signal
import subprocess
import time

from helpers import BUILD, RELUME, SCRATCH, check, corpus, finish, must, record, relume

SHIM = str(BUILD / "tests/real/failing_cl.so")
ENV = dict(os.environ, POCL_KERNEL_CACHE="1")  # compile kernels once for all tests
PACKETS = "camera_packet.cl"  # occurs only in the text of the packets' program
LIMIT = ("--timeout-driver", "5")
met = SCRATCH / "met"

trace = SCRATCH / "two.trace"
record(trace, corpus("two_triangles"), "--frames", "6", options=())
pixels = SCRATCH / "pixels.trace"
record(pixels, BUILD / "tests/real/pixels", options=())


def faulty(fault, **more):
    return dict(ENV, LD_PRELOAD=SHIM, FAULT=fault, FAULT_MET=str(met), **more)


def n_met():
    return len(met.read_text().splitlines()) if met.exists() else 0


def render(of, cache, env, *options):
    """Render into an empty folder; returns the output and all files, including hidden ones."""
    out = SCRATCH / "frames"
    out.mkdir(exist_ok=True)
    for old in out.iterdir():
        old.unlink()
    cached = ("--cache", SCRATCH / cache) if cache else ("--no-cache",)
    done = relume("render", of, "-o", out / "x.#.exr", "--progress", "none", *cached, *options, env=env, timeout=300)
    return done, {p.name: p.read_bytes() for p in out.iterdir()}


def one_line(done, code, *words):
    return done.returncode == code and done.stderr.count("\n") == 1 and all(word in done.stderr for word in words)


want = {}
for family in ("compressed", "binary", "packets"):  # also fills PoCL's cache
    done, want[family] = render(trace, "sound", ENV, "--kernels", family)
    check(done.returncode == 0 and len(want[family]) == 6 and not done.stderr, f"{family}: {done.stderr}")
check(want["packets"] == want["binary"], "families draw the same")
want = want["binary"]

# --- Another family takes over --------------------------------------------------------------------------------------

CASES = {
    "abort in clBuildProgram": (f"abort,build,{PACKETS}", {}, (), "SIGABRT in kernels/frame/whole_packet.cl"),
    "exit in clBuildProgram": (f"exit,build,{PACKETS}", {}, (), "ended the process in kernels/frame/whole_packet.cl"),
    "hang in clBuildProgram": (f"hang,build,{PACKETS}", {}, LIMIT, "hung in kernels/frame/whole_packet.cl"),
    "rubbish from clBuildProgram": (f"code,build,{PACKETS}", {}, (), "(-12345) for kernels/frame/whole_packet.cl"),
    "fault in clCreateKernel": ("segv,create,camera_packet", {}, (), "SIGSEGV in camera_packet"),
    "rubbish from clCreateKernel": ("code,create,camera_packet", {}, (), "(-12345) for camera_packet"),
    "abort in a kernel": ("abort,launch,camera_packet", {}, (), "SIGABRT in camera_packet"),
    "fault in a thread of the driver": ("segv,thread,camera_packet", {}, (), "SIGSEGV in "),
    "abort in a thread of the driver": ("abort,thread,camera_packet", {}, (), "camera_packet"),
    "hang in a kernel": ("hang,launch,camera_packet", {}, LIMIT, "hung in camera_packet"),
    "endless loop in a kernel": ("spin,launch,camera_packet", {}, LIMIT, "hung in camera_packet"),
    "rubbish from a kernel": ("code,launch,camera_packet", {}, (), "(-12345) for camera_packet"),
    "abort in the tenth launch": ("abort,launch,,10", {"FAULT_WITH": "packet"}, (), "SIGABRT"),
    "hang in the tenth launch": ("hang,launch,,10", {"FAULT_WITH": "packet"}, LIMIT, "hung"),
    "rubbish from the tenth launch": ("code,launch,,10", {"FAULT_WITH": "packet"}, (), "(-12345)"),
}
for i, (what, (fault, more, options, words)) in enumerate(CASES.items()):
    cache = f"cache{i}"
    met.unlink(missing_ok=True)
    done, found = render(trace, cache, faulty(fault, **more), *options)
    check(one_line(done, 0, "warning", "--kernels binary", "packets", words),
          f"{what}: exit code {done.returncode}: {done.stderr}")
    check(found == want, f"{what}: other pictures, or other files: {list(found)}")
    check(n_met() == 1, f"{what}: met {n_met()} times")
    done, found = render(trace, cache, faulty(fault, **more), *options)
    check(one_line(done, 0, "warning", "--kernels binary", "packets", words),
          f"{what}, again: exit code {done.returncode}: {done.stderr}")
    check(found == want and n_met() == 1, f"{what}, again: met {n_met()} times, files {list(found)}")

listed = must(relume("devices", "--device", "0", "--cache", SCRATCH / "cache0", env=ENV)).stdout
check("kernels: binary, as packets failed: SIGABRT in kernels/frame/whole_packet.cl" in listed,
      f"the list names it: {listed}")
done, found = render(trace, "cache0", faulty(f"abort,build,{PACKETS}", AS_DRIVER="99"))
check(one_line(done, 0, "--kernels binary") and found.keys() == want.keys(), f"another driver: {done.stderr}")
before = n_met()
done, found = render(trace, "cache0", dict(ENV, LD_PRELOAD=SHIM, AS_DRIVER="100"))
check(done.returncode == 0 and not done.stderr and found.keys() == want.keys(),
      f"a driver that is repaired: {done.stderr}")

# Both of the first two families.
met.unlink(missing_ok=True)
done, found = render(trace, "two", faulty(f"abort,build,{PACKETS};abort,launch,camera_wide"))
check(
    one_line(done, 0, "--kernels compressed", "binary", "camera_wide") and found == want and n_met() == 2,
    f"two families: {n_met()}: {done.stderr}")
done, found = render(trace, "two", faulty(f"abort,build,{PACKETS};abort,launch,camera_wide"))
check(
    one_line(done, 0, "--kernels compressed") and found == want and n_met() == 2,
    f"two families, again: {n_met()}: {done.stderr}")

# Nothing is stored if one family is requested.
for _ in range(2):
    met.unlink(missing_ok=True)
    done, found = render(trace, None, faulty("abort,launch,camera_packet"))
    check(one_line(done, 0, "--kernels binary") and found == want and n_met() == 1, f"--no-cache: {done.stderr}")
done, found = render(trace, "asked", faulty("abort,launch,camera_packet"), "--kernels", "packets")
check(
    one_line(done, 5, "--kernels packets", "SIGABRT in camera_packet") and not found,
    f"--kernels packets: exit code {done.returncode}: {done.stderr}")

# --- No family is left ------------------------------------------------------------------------------------------------

for what, fault, again in (("all programs", "abort,build,", 0), ("all launches", "abort,launch,", 3)):
    met.unlink(missing_ok=True)
    for n in (3, 3 + again):
        done, found = render(trace, what.replace(" ", "-"), faulty(fault))
        check(one_line(done, 5, "packets failed", "binary failed", "compressed failed", "--device reference"),
              f"{what}: {done.returncode}: {done.stderr}")
        check(not found and n_met() == n, f"{what}: met {n_met()} times, expected {n}; files {list(found)}")
done, found = render(trace, "all-programs", ENV, "--device", "reference")
check(done.returncode == 0 and len(found) == 6 and not done.stderr, f"--device reference: {done.stderr}")

# --- In the middle of a run -----------------------------------------------------------------------------------------

done, found = render(trace, "middle", faulty("abort,launch,camera_packet,4"), "-j", "1", "--progress", "json")
events = [json.loads(line) for line in done.stdout.splitlines()]
count = collections.Counter(e["frame"] for e in events if e["event"] == "frame")
check(one_line(done, 0, "--kernels binary") and found == want, f"in the middle: {done.stderr}")
check(
    count == {i: 1 for i in range(6)} and [e["event"] for e in events].count("begin") == 1 and events[-1]["done"] == 6,
    f"each frame is reported once: {done.stdout}")

done, whole = render(pixels, "sound", ENV, "--mode", "gl")
done, found = render(pixels, "alone", faulty("abort,launch,gather"), "--mode", "gl")
missing = set(whole) - set(found)  # frame 3 reads pixels; frames replayed for it may fail, too
check(done.returncode == 5 and "x.3.exr" in missing and len(found) > 2 and found.items() <= whole.items(),
      f"one frame fails alone: exit code {done.returncode}, {list(found)}")
check(
    done.stderr.count("\n") == len(missing)
    and all(f"frame {name[2]}: the driver fails on it (SIGABRT in" in done.stderr for name in missing),
    f"a line for each frame that failed: {missing}: {done.stderr}")
done, found = render(pixels, "alone", ENV, "--mode", "gl")
check(done.returncode == 0 and not done.stderr and found == whole,
      f"families that made other frames are not blamed: {done.stderr}")

# --- Signals --------------------------------------------------------------------------------------------------------


def start_hung():
    """A run whose driver hangs, and its worker process."""
    met.unlink(missing_ok=True)
    parent = subprocess.Popen([
        RELUME, "render", trace, "-o", SCRATCH / "hung/x.#.exr", "--progress", "none", "--cache", SCRATCH / "hung-cache"
    ], env=faulty("hang,launch,camera_packet"), stderr=subprocess.PIPE, text=True, start_new_session=True)
    while not n_met():
        time.sleep(0.05)
    worker = int(pathlib.Path(f"/proc/{parent.pid}/task/{parent.pid}/children").read_text().split()[0])
    return parent, worker


def is_gone(worker):
    for _ in range(100):
        try:
            if pathlib.Path(f"/proc/{worker}/stat").read_text().rsplit(")", 1)[1].split()[0] == "Z":
                return True
        except OSError:
            return True
        time.sleep(0.05)
    return False


def ended(parent):
    _, said = parent.communicate(timeout=60)
    return parent.returncode, said


for number, code, everybody in ((signal.SIGTERM, 143, False), (signal.SIGINT, 130, False), (signal.SIGINT, 130, True)):
    parent, worker = start_hung()
    send = os.killpg if everybody else os.kill
    send(parent.pid, number)
    time.sleep(1)
    check(parent.poll() is None,
          f"{number}, once, to {'all' if everybody else 'one'}: ended at once with {parent.returncode}")
    send(parent.pid, number)
    found, said = ended(parent)
    check(found == code and is_gone(worker), f"{number}, twice: exit code {found}: {said}")
parent, worker = start_hung()
parent.kill()
check(ended(parent)[0] == -signal.SIGKILL and is_gone(worker), "the worker ends with its parent")
parent, worker = start_hung()
os.kill(worker, signal.SIGSEGV)
found, said = ended(parent)
check(found == -signal.SIGSEGV and not said,
      f"a signal from elsewhere ends the run without blame: {found}, {said}")
# The frame rendered beside the one that hangs may exist, but only completely.
left = {p.name: p.read_bytes() for p in (SCRATCH / "hung").glob("*")}
check(left.items() <= want.items(), f"nothing half-written is left: {list(left)}")
check(not list((SCRATCH / "hung-cache").glob("*.outcome")), "no outcome is stored")
finish()
