"""The OpenCL device of host_cl.c: how clang compiles kernels for it, and the environment that preloads it. It starts
clang, so that `relume render` needs --no-sandbox with it.
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
    """Where compiled kernels are kept. Those of older texts go."""
    kept = build / "tests/host-programs"
    kept.mkdir(parents=True, exist_ok=True)
    for file in sorted(kept.glob("*.so"), key=lambda f: f.stat().st_mtime, reverse=True)[300:]:
        file.unlink(missing_ok=True)
    return kept


def environment(build, options, shims=(), **more):
    """A process that sees this device alone, with other shims before it; kernels are compiled with the given
    options."""
    preload = [*shims, build / "tests/check/host_cl.so"]
    return dict(os.environ, LD_PRELOAD=" ".join(map(str, preload)), HOST_CL_FOLDER=str(programs(build)),
                HOST_CL_COMPILE=" ".join([*COMPILE, "-I", str(build / "gen"), *options]), **more)
