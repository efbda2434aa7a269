#!/usr/bin/python3
"""Kernel arguments: errors must not compile, neither at a kernel's launch, nor in its twin, nor in OpenCL C."""
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("RELUME_BUILD", ROOT / "build"))
WHERE = ["-I", str(ROOT), "-I", str(BUILD / "gen")]
FLAGS = [
    "-std=c11", "-Wall", "-Wextra", "-Werror=override-init", "-Werror=incompatible-pointer-types", "-fsyntax-only",
    "-x", "c", "-", *WHERE
]
OPENCL = [
    "-target", "spir64", "-x", "cl", "-cl-std=CL1.2", "-D__OPENCL_VERSION__=120", "-Xclang", "-finclude-default-header",
    "-fsyntax-only", "-", *WHERE
]

LAUNCH = """#include "tracer/device/launch.h"
int f(struct device *dev, union buffer_path paths, union buffer_float radiance, union buffer_shaded shaded);
int f(struct device *dev, union buffer_path paths, union buffer_float radiance, union buffer_shaded shaded)
{
	(void)paths, (void)radiance, (void)shaded;
	return launch_credit(dev, 1, LAUNCH(credit, %s));
}
"""
UPLOAD = """#include "tracer/device/launch.h"
int f(struct device *dev, union buffer_ray rays, const struct ray *data, const struct hit *others);
int f(struct device *dev, union buffer_ray rays, const struct ray *data, const struct hit *others)
{
	(void)data, (void)others;
	return launch_upload(dev, rays, %s, 1);
}
"""
TWIN = """#include "kernels/kernels.h"
void credit_c(const struct %s_arguments *a, size_t first, size_t last) { (void)first, (void)last; %s; }
"""
KERNEL = """#include "kernels/common.h"
#include "kernels/kernels.h"
__kernel void credit(KERNEL_ARGUMENTS(credit)) { const struct credit_arguments a = KERNEL_STRUCT(credit); (void)a; %s; }
"""
RIGHT = ".paths = paths, .radiance = radiance, .transport = 0, .n = 1, .shaded = shaded"

CASES = [  # original text, replacement, whether it compiles
    (LAUNCH, RIGHT, True),
    (LAUNCH, ".paths = paths, .radiance = radiance, .transport = 0, .n = 1", False),
    (LAUNCH, RIGHT + ", .bits = 1", False),
    (LAUNCH, RIGHT + ", .n = 2", False),
    (LAUNCH, ".paths = paths, .radiance = radiance, .transport = 0, .n = 1, .n = 2", False),
    (LAUNCH, ".paths = paths, .radiance = shaded, .transport = 0, .n = 1, .shaded = shaded", False),
    (LAUNCH, ".paths = paths, .radiance = radiance, .transport = 0, .n = shaded, .shaded = shaded", False),
    (UPLOAD, "data", True),
    (UPLOAD, "others", False),
    (TWIN, ("credit", "(void)a->radiance[0]"), True),
    (TWIN, ("credit", "(void)a->bits"), False),
    (TWIN, ("credit", "const struct ray *p = a->paths; (void)p"), False),
    (TWIN, ("shade", "(void)a"), False),
    (KERNEL, "shaded[0].flags = n", True),
    (KERNEL, "shaded[0].flags = bits", False),
    (KERNEL, "__global const struct ray *p = paths; (void)p", False),
]

clang = shutil.which("clang")
done = failed = 0
for text, part, right in CASES:
    if text is KERNEL and not clang:
        continue
    compiler = [clang, *OPENCL, "-Werror"] if text is KERNEL else ["gcc", *FLAGS]
    run = subprocess.run(compiler, input=text % part, capture_output=True, text=True, check=False)
    done += 1
    if (run.returncode == 0) != right:
        failed += 1
        print(f"wrong: {part} {'does not compile' if right else 'compiles'}\n{run.stderr[:1000]}")
print(f"{100 * (done - failed) // done}%: Checks: {done}, Failures: {failed}, Errors: 0")
sys.exit(1 if failed else 0)
