/*
 * Approved frames: somebody looked at them and found them right; later frames are compared with them.
 *
 * DIR/DEVICE/baseline.yaml is one variant, for one device: provenance, then a line for each frame with the hashes of
 * its channels. The frames lie beside it (frame.0012.exr, or .png where such were approved), unless only hashes were.
 * Nothing in it depends on the machine, and lines are sorted by frame: version control shows what changed. DEVICE is
 * the device's name; anything but letters, digits, dots and dashes becomes "_".
 */
#pragma once

#include "diff/score/score.h"

struct baseline_frame {
	uint64_t frame;
	uint32_t width, height;
	char *file;     /* in the variant's folder; NULL: only hashes */
	char *channels; /* "A:0123456789abcdef B:...", sorted by name: XXH64 of a channel's numbers, top row first */
};

/* One variant, as its file has it. */
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
 * @return 0 (a folder that is not there is an empty baseline), ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int baseline_open(const char *dir, struct baseline *out);
void baseline_close(struct baseline *baseline);

/** The frame in a variant, or NULL. */
struct baseline_frame *baseline_find(const struct baseline_variant *variant, uint64_t frame);

/** Index of the variant of a device (NULL: unknown), or -1. */
int baseline_variant_of(const struct baseline *baseline, const char *device);

/** Hashes of an image's channels as struct baseline_frame has them; caller frees; NULL without memory. */
char *baseline_hash_channels(const struct image *img);

/** DIR/DEVICE; caller frees; NULL without memory. */
char *baseline_folder(const char *dir, const char *device);

/**
 * What gate B compares a frame with: the variant of its own device, else the first variant that holds the frame.
 *
 * @param was    empty; receives the approved pixels, if stored and needed; must outlive `out`
 * @param found  receives 1, or 0 where no variant holds the frame or its own device's hashes are not approved yet
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int baseline_look_up(const struct baseline *baseline, const struct image *img, uint64_t frame, struct image *was,
                     struct score_approved *out, int *found);

/** Write DIR/DEVICE/baseline.yaml, whole or not at all. @return 0 or ERR_SYSTEM (reported) */
int baseline_write(const char *folder, const struct baseline_variant *variant);
