#!/usr/bin/python3
"""tests/show/gpu_code.py BUILD (as `make show-gpu-code`): registers, spills and local memory of the kernels that GPUs
run, without a GPU: compiled by clang with libclc, for NVIDIA assembled by ptxas, for AMD by LLVM. A driver's own
compiler may differ, but a change that ruins a kernel shows.

Bars, for kernels that trace rays or draw plain frames: nothing is spilled to memory, and they need at most 64 of
NVIDIA's registers (a multiprocessor of 65,536 then keeps 1,024 threads), or a limit whose reason is given below.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from table import Shown

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LIBRARIES = pathlib.Path("/usr/lib/clc")
OPTIONS = [
    "-x", "cl", "-cl-std=CL1.2", "-D__OPENCL_VERSION__=120", "-Xclang", "-finclude-default-header", "-O3", "-w",
    "-Wno-linker-warnings", f"-I{ROOT}"
]
NVIDIA, AMD = ("sm_80", "sm_90"), ("gfx1030", "gfx1100")
FILES = ("camera/camera_wide", "rays/rays_single", "rays/query", "frame/plain/plain_single", "frame/stages/vertex",
         "frame/stages/vertex_program", "frame/stages/window", "frame/stages/scan", "frame/stages/shade",
         "frame/stages/program", "frame/stages/resolve", "frame/stages/compose", "frame/light/shadow",
         "frame/light/secondary", "frame/light/photon", "frame/dome/dome")
BARRED = ("camera/camera_wide", "rays/rays_single", "frame/plain/plain_single")  # those that fast frames consist of
REGISTERS = 64
# Kernels that need more: (most, why). LLVM 15 does not know all registers of gfx1100.
STACK = "a ray in two spaces, its nearest hit, and eight boxes of a node at once"
LIMITS = {
    "camera_wide": (120, "as camera_compressed, with two boxes"),
    "camera_compressed": (128, STACK),
    "intersect_binary": (112, "a ray in two spaces, its nearest hit, and two boxes"),
    "occlude_binary": (104, "as intersect_binary, without the hit's place"),
    "intersect_compressed": (128, STACK),
    "occlude_compressed": (128, STACK),
    "plain_color": (168, "three vertices, textures and lights of a point; 64 are slower (kernels/README.md)"),
    "plain_color_dimmed": (168, "as plain_color"),
    "plain_ask": (80, "the surface that three normals imply"),
    "plain_show": (80, "a point's place, normal and motion beside its colours"),
    "plain_show_dimmed": (80, "as plain_show"),
}


def find_clang():
    """A clang that reads the libraries: they are as old as it or older."""
    found = (name for folder in ("/usr/bin", "/usr/local/bin") for name in pathlib.Path(folder).glob("clang-[0-9]*"))
    names = sorted((name for name in found if re.fullmatch(r"clang-\d+", name.name)),
                   key=lambda name: int(name.name[6:]))
    with tempfile.TemporaryDirectory() as folder:
        probe = pathlib.Path(folder, "probe.cl")
        probe.write_text("__kernel void k(__global float *x) { x[0] = sqrt(x[1]); }")
        for name in names:
            if compile_file(name, "nvptx64-nvidia-nvcl", "sm_80", "nvptx64--nvidiacl", probe, f"{folder}/out"):
                return name
    sys.exit(f"no clang here reads {LIBRARIES}/nvptx64--nvidiacl.bc: 'make deps' installs one")


def compile_file(clang, target, processor, library, source, out, build=None):
    command = [clang, "-target", target, *OPTIONS, "-nogpulib", "-Xclang", "-target-cpu", "-Xclang", processor,
               "-Xclang", "-mlink-builtin-bitcode", "-Xclang", LIBRARIES / f"{library}.bc", "-S", "-o", out, source]
    if build:
        command.insert(1, f"-I{build / 'gen'}")
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode and build:
        sys.exit(f"{source} does not compile for {processor}:\n{run.stderr[:2000]}")
    return run.returncode == 0


def read_ptxas(ptxas, processor, text):
    """{kernel: (registers, spilled bytes, local bytes)}"""
    run = subprocess.run([ptxas, "-v", f"-arch={processor}", text, "-o", "/dev/null"], capture_output=True, text=True,
                         check=False)
    if run.returncode:
        sys.exit(f"ptxas for {processor}: {run.stderr[:2000]}")
    found = {}
    for part in run.stderr.split("Compiling entry function")[1:]:
        name = re.match(r" '(\w+)'", part)[1]
        stack, stores, loads = map(
            int, re.search(r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill", part).groups())
        found[name] = int(re.search(r"Used (\d+) registers", part)[1]), stores + loads, stack
    return found


def read_amd(text):
    """The same from the metadata of LLVM's assembly."""
    found = {}
    for part in re.split(r"\n  - \.", text)[1:]:
        name = re.search(r"\.?name:\s+(\w+)\n.*?\.private_segment_fixed_size: (\d+)", part, re.DOTALL)
        counts = dict(re.findall(r"\.([sv]gpr(?:_spill)?_count):\s+(\d+)", part))
        symbol = re.search(r"\.symbol:\s+(\w+)\.kd", part)
        if symbol and name:
            # scalar registers are spilled to lanes of vector registers, not to memory
            found[symbol[1]] = int(counts["vgpr_count"]), 4 * int(counts["vgpr_spill_count"]), int(name[2])
    return found


def measure(build, clang, ptxas, work):
    """{kernel: {processor: (registers, spilled bytes, local bytes)}}, and the kernels that have bars."""
    kernels, barred = {}, set()
    for file in FILES:
        source = ROOT / "kernels" / f"{file}.cl"
        results = {}
        compile_file(clang, "nvptx64-nvidia-nvcl", NVIDIA[0], "nvptx64--nvidiacl", source, work / "out.ptx", build)
        for processor in NVIDIA:
            results[processor] = read_ptxas(ptxas, processor, work / "out.ptx")
        for processor in AMD:
            compile_file(clang, "amdgcn-amd-amdhsa", processor, "amdgcn--amdhsa", source, work / "out.s", build)
            results[processor] = read_amd((work / "out.s").read_text())
        for processor, found in results.items():
            for kernel, numbers in found.items():
                kernels.setdefault(kernel, {})[processor] = numbers
        if file in BARRED:
            barred |= set(results[NVIDIA[0]])
    return kernels, barred


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    build = parser.parse_args().build.resolve()
    shown = Shown(build, "gpu-code")
    ptxas = next((build / "show/gpu-code/venv").glob("lib/python*/site-packages/nvidia/cuda_nvcc/bin/ptxas"))
    if not shutil.which(str(ptxas)):
        ptxas.chmod(0o755)
    with tempfile.TemporaryDirectory() as folder:
        kernels, barred = measure(build, find_clang(), ptxas, pathlib.Path(folder))
    for kernel, numbers in sorted(kernels.items(), key=lambda item: (item[0] not in barred, item[0])):
        registers = ", ".join(f"{processor} {numbers[processor][0]}" for processor in numbers)
        spilled = max(count for _, count, _ in numbers.values())
        local = max(size for _, _, size in numbers.values())
        figure = f"registers {registers}; {spilled} bytes spilled; {local} bytes of local memory"
        if kernel not in barred:
            shown.row(kernel, figure, None, None)
            continue
        most, why = LIMITS.get(kernel, (REGISTERS, None))
        good = spilled == 0 and all(numbers[processor][0] <= most for processor in NVIDIA)
        shown.row(kernel, figure, f"NVIDIA {most} registers, nothing spilled", good, why)
    return shown.finish()


sys.exit(main())
