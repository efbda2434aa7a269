"""The OpenCL device of host_cl.c: compiling kernels for it with clang, and the environment that preloads it. Since it
starts clang, `relume render` needs --no-sandbox with it.
"""
import os
import pathlib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
COMPILE = [
    "clang", "-shared", "-fPIC", "-gline-tables-only", "-x", "cl", "-cl-std=CL1.2", "-cl-no-stdinc",
    "-D__OPENCL_VERSION__=120", "-Wall", "-Wno-unknown-pragmas", "-Wno-unused-function", "-Wno-c++20-designator",
    "-Wno-psabi", "-I",
    str(ROOT), "-ftrivial-auto-var-init=pattern"
]


def programs(build):
    """Folder for compiled kernels. Kernels of older texts are removed."""
    kept = build / "tests/host-programs"
    kept.mkdir(parents=True, exist_ok=True)
    for file in sorted(kept.glob("*.so"), key=lambda f: f.stat().st_mtime, reverse=True)[300:]:
        file.unlink(missing_ok=True)
    return kept


def environment(build, options, shims=(), **more):
    """Environment of a process that sees only this device, with other shims before it; kernels are compiled with the
    given options."""
    preload = [*shims, build / "tests/check/host_cl.so"]
    return dict(os.environ, LD_PRELOAD=" ".join(map(str, preload)), HOST_CL_FOLDER=str(programs(build)),
                HOST_CL_COMPILE=" ".join([*COMPILE, "-I", str(build / "gen"), *options]), **more)
