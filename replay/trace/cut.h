/* The warning that a recording is cut short. */
#pragma once

#include <stdint.h>

/** Warn that a file is cut short after a call, once for each file. Reading a trace to its end does so. */
void trace_warn_cut(const char *path, uint64_t call);
