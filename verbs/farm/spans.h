/* Frame numbers as people write them: "0-40x5,43,50-52". */
#pragma once

#include <stdint.h>
#include <stdio.h>

enum { SPANS_MOST = 12 }; /* runs to print before "..." */

/* Initially all zero, except `out`. */
struct spans {
	FILE *out;
	uint64_t first, last, step, n; /* the run not printed yet: n frames */
	unsigned printed;              /* number of runs printed */
};

/** Add a frame, in rising order. */
void spans_add(struct spans *spans, uint64_t frame);

/** Print what is left. */
void spans_end(struct spans *spans);
