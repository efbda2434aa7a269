/* Compares pictures of frames of two recordings, as OpenGL drew them. */
#pragma once

#include "tracer/image/oiio.h"
#include "verbs/bisect/walk.h"

/* The first pair of frames whose pictures differ. */
struct sight {
	int is_found;               /* 0: none of those compared */
	size_t looked, left;        /* numbers of pairs compared, and of pairs left out because of the limit */
	size_t frame[N_SIDES];
	uint64_t differing, pixels; /* numbers of pixels that differ (all of them if the sizes do), and of all pixels */
	unsigned worst;             /* largest difference of a channel, 0 .. 255 */
	struct oiio_pixels pictures[N_SIDES]; /* free with sight_free */
};

/**
 * Compare pictures from a frame on.
 * @param first   frame of the good recording
 * @param most    pairs of frames at most
 * @param device  as for device_open
 * @return 0 or ERR_* (reported)
 */
int sight_find(const struct partners *partners, const struct recording *good, const struct recording *bad, size_t first,
               size_t most, const char *device, struct sight *out);
void sight_free(struct sight *sight);

/** Write DIR/good.png, bad.png and difference.png. @return 0 or ERR_SYSTEM (reported) */
int sight_write(const struct sight *sight, const char *folder);
