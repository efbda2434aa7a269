/*
 * A hook for the reference device: the same text, compiled for this processor by clang, as OpenCL C
 * (kernels/ref/hook_host.h). It starts a program, and loads what that leaves; so before the sandbox closes.
 */
#pragma once

#include "tracer/hook/hook.h"

/** @return 0, ERR_INPUT (clang refuses the text, its words are printed), ERR_USAGE (there is no clang) or ERR_SYSTEM;
 * reported */
int hook_compile_host(struct hook *hook);
