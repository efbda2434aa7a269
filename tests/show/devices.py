#!/usr/bin/python3
"""tests/show/devices.py BUILD [--only PART]... (as `make show-devices`): the same pictures from every OpenCL
implementation.

Eight programs are recorded, rendered with each family of traversal kernels on PoCL and on Intel's runtime for CPUs,
each compiling for AVX-512 (where the processor has it) and for AVX2, and scored: all gates on the last frames. A line
"no options" uses the family that `relume render` chooses there. Times are processor time, which other load lengthens:
if a bar is missed, the least of TRIES counts.

  cold, kept  a whole run for one frame of the Cornell box, from an empty cache and once more; slowest: the file that
              took longest to compile, or the kernel if compiled when it runs
              (tests/real/build_shim.c)
  ms a frame  for each program: time of its frames after the first, including the replay between them

Oclgrind interprets kernels, and rusticl (Mesa's llvmpipe) is young: for these, the result of `relume devices --check`
is printed. Recordings stay in BUILD/show/parity, which `make show-parity` uses as well; --only selects implementations
by part of the name.
"""
import argparse
import dataclasses
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

import programs
import recording
import scoring
from display import need_display

FAMILIES = (None, "binary", "compressed")  # None: no --family option
N_FRAMES = 2
TRIES = 3
LIMIT_S = 900  # per command
CHECK_S = 60  # per scene of --check
COLD_S, WARM_S, FILE_S = 20, 0.2, 10  # limits: first frame, cached kernels, one file
LIVE = ("glxgears", "neverball", "queens", "superquadrics")
CORPUS = {"Cornell": ("cornell", "--animate", "camera"), "spheres": ("spheres", "--animate", "camera"),
          "glass": ("still_life", "--animate", "camera"), "hall": ("hall", "--animate", "camera")}


@dataclasses.dataclass
class Implementation:
    name: str
    environment: dict
    demanded: bool  # its limits count
    preload: tuple = ()


def has_avx512():
    return re.search(r"^flags.* avx512f ", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE) is not None


def vendor_folder(folder, library):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "only.icd").write_text(f"{library}\n")
    return {"OCL_ICD_VENDORS": str(folder), "OPENCL_VENDOR_PATH": str(folder)}


def intel_environment(base):
    """Intel's runtime from its virtual environment, without the loader that ships with it."""
    libraries = base / "intel-lib"
    libraries.mkdir(exist_ok=True)
    for file in (base / "intel" / "lib").iterdir():
        if "libOpenCL" not in file.name and not file.is_dir() and not (libraries / file.name).exists():
            (libraries / file.name).symlink_to(file)
    return {**vendor_folder(base / "vendors-intel", libraries / "libintelocl.so"), "LD_LIBRARY_PATH": str(libraries)}


def implementations(build, base):
    pocl = vendor_folder(base / "vendors-pocl", pathlib.Path("/etc/OpenCL/vendors/pocl.icd").read_text().strip())
    intel, shim = intel_environment(base), (str(build / "tests/real/avx2_shim.so"),)
    wide = has_avx512()
    if wide:
        yield Implementation("Intel, AVX-512", {**intel, "CL_CONFIG_CPU_TARGET_ARCH": "skx"}, True)
    yield Implementation("Intel, AVX2", {**intel, "CL_CONFIG_CPU_TARGET_ARCH": "core-avx2"}, True)
    if wide:
        yield Implementation("PoCL, AVX-512", pocl, True)
    yield Implementation("PoCL, AVX2", pocl, True, shim if wide else ())
    yield Implementation(
        "Oclgrind", {
            **vendor_folder(base / "vendors-oclgrind", "/usr/lib/oclgrind/liboclgrind-rt-icd.so"), "OCLGRIND_BUILD_OPTIONS": "-cl-opt-disable -D LANES_PORTABLE"
        }, False)
    yield Implementation(
        "rusticl", {**vendor_folder(base / "vendors-rusticl", "libRusticlOpenCL.so.1"), "RUSTICL_ENABLE": "llvmpipe"},
        False)


class Runner:
    """Runs the command on one implementation, with separate caches."""

    def __init__(self, build, base, implementation, family):
        self.relume, self.implementation, self.family = build / "relume", implementation, family
        self.folder = base / re.sub(r"\W+", "_", f"{implementation.name}_{family or 'default'}")
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.log = self.folder / "builds"
        self.caches = self.folder / "cache", self.folder / "pocl"
        self.environment = dict(os.environ, **implementation.environment, BUILD_LOG=str(self.log),
                                XDG_CACHE_HOME=str(self.caches[0]), POCL_CACHE_DIR=str(self.caches[1]),
                                LD_PRELOAD=":".join((str(build / "tests/real/build_shim.so"), *implementation.preload)))

    def run(self, *command, **more):
        """Exit code, lines of output, errors, and the processor time used when each line arrived."""
        errors, out, used = self.folder / "errors", [], []
        with open(errors, "w") as file:
            process = subprocess.Popen([str(a) for a in command], env=dict(self.environment,
                                                                           **more), stdin=subprocess.DEVNULL,
                                       stdout=subprocess.PIPE, stderr=file, text=True, errors="replace")
        late = threading.Timer(LIMIT_S, process.kill)
        late.start()
        for line in process.stdout:
            used.append(time.clock_gettime(~process.pid << 3
                                           | 2))  # the clock id of the process, as clock_getcpuclockid() computes it
            out.append(line)
        code = process.wait()
        late.cancel()
        return code, out, errors.read_text(errors="replace"), used

    def render(self, trace, frames, **more):
        """Exit code, last message, processor time at the end of each frame and in total; {file or kernel: build
        seconds}.

        Runs without the sandbox, because the shim writes a file.
        """
        self.log.unlink(missing_ok=True)
        pictures = self.folder / "x"
        shutil.rmtree(pictures, ignore_errors=True)
        code, lines, err, used = self.run(self.relume, "render", trace, "-f", ",".join(map(str, frames)), "-j", 1,
                                          "--progress", "json", "--no-sandbox", "-o", pictures / "x.####.exr",
                                          *(("--kernels", self.family) if self.family else ()), **more)
        built = {}
        for line in self.log.read_text().splitlines() if self.log.exists() else ():
            how, seconds, kernels = (line + " ").split(" ", 2)
            built[kernels.strip() if how == "launch" else f"file of {kernels.split(';')[0].strip()}"] = float(seconds)
        times = [seconds for line, seconds in zip(lines, used) if json.loads(line)["event"] in ("frame", "end")]
        if code == -signal.SIGKILL:
            err = f"not done in {LIMIT_S} s"
        return code, (err.splitlines() or [""])[-1][:120], times, built

    def start(self, trace, frame, bars_hold, cold):
        """The same for one frame, repeated until the limits hold: the least time over the runs, for the whole run and
        for each file.
        """
        least_s, least = None, {}
        for _ in range(TRIES):
            for cache in self.caches if cold else ():
                shutil.rmtree(cache, ignore_errors=True)
            code, said, times, built = self.render(trace, [frame], **({"BUILD_FINISH": "1"} if cold else {}))
            if code:
                return code, said, 0, {}
            least_s = min(times[-1], least_s or times[-1])
            least = {kernels: min(seconds, least.get(kernels, seconds)) for kernels, seconds in built.items()}
            if bars_hold(least_s, least):
                break
        return 0, "", least_s, least

    def score(self, reference, frames):
        """Names of the gates that frames fail; "" if all pass."""
        try:
            scored = json.loads("".join(
                self.run(self.relume, "diff", reference, self.folder / "x", "-f", ",".join(map(str, frames)), "--json",
                         "-")[1]))
        except ValueError:
            return "not scored"
        missed = sorted({gate for frame in scored["frames"] for gate in scoring.missed_gates(frame, scoring.GATES)})
        return ", ".join(missed) if len(scored["frames"]) == len(frames) else "frames are missing"


def show_programs(runner, recordings):
    """Number of programs that pass all gates, the others' names and faults, {program: seconds per frame}."""
    passed, missed, speeds = 0, [], {}
    for name, done in recordings.items():
        if done is None:
            missed.append(f"{name}: not recorded")
            continue
        frames = done.references[-N_FRAMES:]
        code, said, times, _ = runner.render(done.trace, frames)
        bad = f"exit code {code}: {said}" if code else runner.score(done.reference, frames)
        if not code:
            speeds[name] = (times[len(frames) - 1] - times[0]) / (len(frames) - 1)
        passed += not bad
        missed += [f"{name}: {bad}"] if bad else []
    return passed, missed, speeds


def show_family(build, base, implementation, family, recordings, table):
    runner = Runner(build, base, implementation, family)
    what = f"{implementation.name}, {family or 'no options'}"
    rows = []

    def row(text, figure, bar, passed):
        rows.append(
            {"what": f"{what}: {text}", "figure": figure, "bar": bar, "peer": None, "passed": passed if bar else None})
        print(f"{rows[-1]['what']}: {figure}" + (f" (bar: {bar})" if rows[-1]["bar"] else ""), flush=True)

    cornell = recordings["Cornell"]
    code, said, cold_s, built = runner.start(cornell.trace, cornell.references[0],
                                             lambda s, built: s <= COLD_S and max(built.values()) <= FILE_S, True)
    if code:
        row("first frame of the Cornell box", f"exit code {code}: {said}", f"at most {COLD_S} s", False)
        return rows
    _, _, kept_s, found = runner.start(cornell.trace, cornell.references[0],
                                       lambda _, found: sum(found.values()) <= WARM_S, False)
    slowest = max(built, key=built.get)
    row("first frame from an empty cache", f"{cold_s:.1f} s, kernels {sum(built.values()):.1f} s",
        f"at most {COLD_S} s", cold_s <= COLD_S)
    row("the same again", f"{kept_s:.2f} s, kernels {sum(found.values()):.2f} s", f"kernels at most {WARM_S} s",
        sum(found.values()) <= WARM_S)
    row("the file, or the kernel, that takes longest to compile", f"{built[slowest]:.1f} s ({slowest})",
        f"at most {FILE_S} s", built[slowest] <= FILE_S)
    passed, missed, speeds = show_programs(runner, recordings)
    row("programs that pass all gates", f"{passed} of {len(recordings)}" + "".join(f"; {m}" for m in missed),
        f"{len(recordings)} of {len(recordings)}", passed == len(recordings))
    row("ms a frame", ", ".join(f"{name} {1e3 * s:.0f}" for name, s in speeds.items()), None, None)
    table.append(
        (what, f"{passed} of {len(recordings)}", f"{cold_s:.1f}", f"{built[slowest]:.1f}", f"{sum(found.values()):.2f}",
         *(f"{1e3 * speeds[name]:.0f}" if name in speeds else "-" for name in recordings)))
    return rows


def print_table(table, recordings):
    """All families of all implementations, one per line."""
    head = ("device, family", "gates", "cold s", "slowest s", "kept s", *(f"{name} ms" for name in recordings))
    widths = [max(len(line[i]) for line in (head, *table)) for i in range(len(head))]
    for line in (head, *table) if table else ():
        print(
            "  ".join(
                text.ljust(width) if i == 0 else text.rjust(width)
                for i, (text, width) in enumerate(zip(line, widths))), flush=True)


def show_checked(build, base, implementation):
    """How far an implementation gets that is too slow for whole frames."""
    runner = Runner(build, base, implementation, None)
    code, out, err, _ = runner.run(build / "relume", "devices", "--check", "--json", "--timeout", CHECK_S)
    try:
        devices = json.loads("".join(out))
    except ValueError:
        devices = []
    rows = []
    for device in devices:
        for family in device["families"]:
            scenes = ", ".join(f"{scene} {state}" for scene, state in family["scenes"].items())
            rows.append({
                "what": f"{implementation.name}, {family['kernels']}: relume devices --check, {CHECK_S} s a scene",
                "figure": scenes, "bar": None, "peer": None, "passed": None
            })
    if not rows:
        rows.append({
            "what": f"{implementation.name}: relume devices --check",
            "figure": f"exit code {code}: {err.strip()[-100:]}", "bar": None, "peer": None, "passed": None
        })
    for row in rows:
        print(f"{row['what']}: {row['figure']}", flush=True)
    return rows


def record_all(build):
    """{name: recording}, or None for a recording that cannot be made."""
    listed = [
        programs.Program(name, "", (str(build / "corpus" / command[0]), *command[1:], "--frames", "8"), ref_every=1)
        for name, command in CORPUS.items()
    ]
    listed += [program for program in programs.OPEN if program.name in LIVE]
    recordings = {}
    for program in listed:
        done = recording.record(build / "relume", program, build / "show" / "parity" / program.name)
        recordings[program.name] = done if done.trace and done.references else None
    return recordings


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", action="append", default=[], help="part of an implementation's name")
    options = parser.parse_args()
    need_display()
    build = options.build.resolve()
    base = build / "show" / "devices"
    base.mkdir(parents=True, exist_ok=True)
    recordings, rows, table = record_all(build), [], []
    for implementation in implementations(build, base):
        if options.only and not any(part in implementation.name for part in options.only):
            continue
        begin = time.monotonic()
        if implementation.demanded:
            for family in FAMILIES:
                rows += show_family(build, base, implementation, family, recordings, table)
        else:
            rows += show_checked(build, base, implementation)
        print(f"({implementation.name}: {time.monotonic() - begin:.0f} s)", flush=True)
    print_table(table, recordings)
    if not options.only:
        (build / "show" / "devices.json"
         ).write_text(json.dumps({"name": "devices", "command": "make show-devices", "rows": rows}, indent=1) + "\n")
    return 1 if any(row["passed"] is False for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
