/*
 * Approved frames: frames that somebody has checked, kept for comparison with later frames.
 *
 * DIR/DEVICE/baseline.yaml is one variant, for one device: provenance, then a line for each frame with the hashes of
 * its channels. The frames lie beside it (frame.0012.exr, or .png if such were approved), unless only hashes were
 * stored. Its contents do not depend on the machine, and lines are sorted by frame, so version control shows what
 * changed. DEVICE is the device's name, with "_" for anything but letters, digits, dots and dashes.
 */
#pragma once

#include "diff/score/score.h"

struct baseline_frame {
	uint64_t frame;
	uint32_t width, height;
	char *file;     /* in the variant's folder; NULL: only hashes */
	char *channels; /* "A:0123456789abcdef B:...", sorted by name: XXH64 of a channel's numbers, top row first */
};

/* One variant, as stored in its file. */
struct baseline_variant {
	char *format;
	uint32_t version;
	char *device, *trace, *relume, *settings, *approved_by, *approved_at, *reason;
	struct baseline_frame *frames; /* sorted */
	uint32_t n_frames;
};

struct baseline {
	char *dir;
	struct baseline_variant **variants;
	char **folders; /* [n_variants]: DIR/DEVICE */
	size_t n_variants;
};

/**
 * Read all variants of a baseline.
 * @return 0 (a missing folder is an empty baseline), ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int baseline_open(const char *dir, struct baseline *out);
void baseline_close(struct baseline *baseline);

/** A variant's frame, or NULL. */
struct baseline_frame *baseline_find(const struct baseline_variant *variant, uint64_t frame);

/** Index of a device's variant (NULL: unknown device), or -1. */
int baseline_variant_of(const struct baseline *baseline, const char *device);

/** Hashes of an image's channels, as in struct baseline_frame; caller frees; NULL if out of memory. */
char *baseline_hash_channels(const struct image *img);

/** DIR/DEVICE; caller frees; NULL if out of memory. */
char *baseline_folder(const char *dir, const char *device);

/**
 * Find the frame that gate B compares with: in the variant of its own device, else in the first variant that has it.
 *
 * @param was    empty; receives the approved pixels, if stored and needed; must outlive `out`
 * @param found  receives 1, or 0 if no variant has the frame or its own device's hashes are not approved yet
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int baseline_look_up(const struct baseline *baseline, const struct image *img, uint64_t frame, struct image *was,
                     struct score_approved *out, int *found);

/** Write DIR/DEVICE/baseline.yaml, completely or not at all. @return 0 or ERR_SYSTEM (reported) */
int baseline_write(const char *folder, const struct baseline_variant *variant);
