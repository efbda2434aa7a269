/* Writes a frame's origin into its file, and checks whether an existing file is the one that would be made. */
#pragma once

#include "tracer/image/image.h"

struct stamp {
	const char *trace, *settings; /* hashes, borrowed */
	char program[256];            /* recorded path, whose last part is written; may be empty */
};

/** Write a picture's origin into its attributes (relume:trace, relume:program, relume:settings, relume:version).
 * @return 0 or ERR_SYSTEM */
int stamp_image(const struct stamp *stamp, struct image *img);

enum stamp_state { STAMP_MISSING, STAMP_DAMAGED, STAMP_OTHER, STAMP_SAME };

/**
 * Check a frame's file. Unpacks every byte of its pixels, to find torn, truncated and zeroed files.
 * @return STAMP_MISSING; STAMP_DAMAGED (reported); STAMP_OTHER: of another trace, frame, settings or version;
 * STAMP_SAME
 */
enum stamp_state stamp_check(const struct stamp *stamp, uint64_t frame, const char *path);
