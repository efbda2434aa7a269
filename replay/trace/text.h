/* A recorded call as text, in the style of `apitrace dump`. */
#pragma once

#include <stdio.h>

#include "capture/format/call.h"

/** NAME(ARGUMENT = VALUE, ...) = RESULT, without a newline. */
void text_call(FILE *out, const struct call *c);

void text_value(FILE *out, const struct trace_value *v);
