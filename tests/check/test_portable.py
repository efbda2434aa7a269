#!/usr/bin/python3
# limit: 400 s
"""The kernels' text must compile on other devices: as OpenCL C 1.2 without a warning, for GPUs, for SPIR, and on PoCL.
No function may be left undefined, as happens to a non-static inline function that a compiler chooses to call; and no
vector may have three components, which a CPU vectoriser loses (kernels/README.md)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("RELUME_BUILD", ROOT / "build"))
OPTIONS = [
    "-x", "cl", "-cl-std=CL1.2", "-D__OPENCL_VERSION__=120", "-Xclang", "-finclude-default-header", "-O0", "-Wall",
    "-Werror", "-Wno-unused-function", "-Wno-unknown-pragmas", "-Wno-c++20-designator", "-I",
    str(ROOT), "-I",
    str(BUILD / "gen")
]
TARGETS = ("nvptx64", "spir64")
# Built-in functions have mangled names.
UNDEFINED = re.compile(r"^declare [^@]*@(?!_Z|llvm\.)(\w+)\(", re.MULTILINE)
THREE = re.compile(r"<3 x (float|i\d+)>")

clang = shutil.which("clang")
if not clang:
    print("no clang here: kernels are not compiled for other targets")
    sys.exit(77)
failed = 0
files = sorted((ROOT / "kernels").glob("*/**/*.cl"))
with tempfile.TemporaryDirectory() as folder:
    for target in TARGETS:
        for file in files:
            command = [clang, "-target", target, *OPTIONS, "-emit-llvm", "-S", "-o", f"{folder}/out", str(file)]
            run = subprocess.run(command, capture_output=True, text=True, check=False)
            if run.returncode:
                failed += 1
                print(f"wrong: {file.name} for {target}:\n{run.stderr[:2000]}")
                continue
            text = pathlib.Path(folder, "out").read_text()
            if THREE.search(text):
                failed += 1
                print(f"wrong: {file.name} for {target}: a vector of three components")
            left = UNDEFINED.findall(text)
            if left:
                failed += 1
                print(f"wrong: {file.name} for {target}: these are not defined: {left}")
# PoCL builds them for its device, with its warnings as errors; if the processor has AVX-512 and can hide it, also as on
# one without. PoCL 6.0 fails there if a text breaks the rule on branches in kernels/README.md.
devices = [{}]
flags = re.search(r"^flags.*$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)
flags = set(flags.group().split()) if flags else set()
if {"avx512f", "cpuid_fault"} <= flags:
    devices.append(
        {"LD_PRELOAD": str(BUILD / "tests/real/avx2_shim.so"), "POCL_CACHE_DIR": str(BUILD / "tests/pocl-cache-avx2")})
elif "avx512f" in flags:
    print("this processor cannot hide AVX-512 (no cpuid_fault): kernels are not built for AVX2")
for device in devices:
    for family in ("packets", "binary", "compressed"):
        run = subprocess.run([BUILD / "tests/bench/tiny", "0", family], capture_output=True, text=True, check=False,
                             env=dict(os.environ, POCL_EXTRA_BUILD_FLAGS="-Werror", **device))
        if run.returncode:
            failed += 1
            print(f"wrong: {family} on PoCL {device}:\n{run.stdout}{run.stderr[:2000]}")
checks = len(files) * len(TARGETS) + 3 * len(devices)
print(f"{100 * (checks - failed) // checks}%: Checks: {checks}, Failures: {failed}, Errors: 0")
sys.exit(1 if failed else 0)
