/* Pairs the calls and frames of one recording with those of the other. */
#pragma once

#include "verbs/bisect/align.h"
#include "verbs/bisect/recording.h"

struct partners {
	struct align_hunk *hunks; /* hunks of calls that count, in order; between them calls pair one by one */
	size_t n, room;
	size_t *frames;           /* [good->n_frames]: the frame of bad, or SIZE_MAX */
};

/** Align frames first, then the calls of frames that differ. @return 0 or ERR_SYSTEM (reported) */
int partners_find(struct partners *p, const struct recording *good, const struct recording *bad);
void partners_free(struct partners *p);
