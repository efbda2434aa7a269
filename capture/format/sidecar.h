/* Files beside a trace. */
#pragma once

#include <stddef.h>

/**
 * The name of a sidecar (".ref"), or of a further process' trace (".1.trace"): NAME.trace with its ending replaced.
 * @return 1; 0: it is too long
 */
int sidecar_name(char *out, size_t size, const char *trace, const char *suffix);
