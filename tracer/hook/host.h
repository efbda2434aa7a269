/*
 * A hook for the reference device: the same source, compiled as OpenCL C for this processor by clang
 * (kernels/ref/hook_host.h). This starts a program and loads the library that it writes, so call it before the sandbox
 * is entered.
 */
#pragma once

#include "tracer/hook/hook.h"

/** @return 0, ERR_INPUT (clang rejects the source; its messages are printed), ERR_USAGE (clang is missing) or
 * ERR_SYSTEM; all reported */
int hook_compile_host(struct hook *hook);
