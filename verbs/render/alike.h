/* Groups frames that fail for the same reason: the first is reported at once, all of them at the end, with their
 * range. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* All-zero is valid and empty. Used under the caller's lock. */
struct alike {
	struct alike_reason *reasons;
	size_t n;
};

/** A frame failed. Its text is reported at once if no earlier frame had the same: "frame 7: TEXT". */
void alike_note(struct alike *a, uint64_t frame, const char *text);

/** Report texts that several frames had, "frames 7-19, 21: TEXT", and forget all. */
void alike_end(struct alike *a);
