/*
 * The surface area heuristic builder (sah_build.inc), compiled for any processor (sah.c) and for AVX2 (sah_avx2.c).
 * Both give the same tree; sah.c chooses one.
 */
#pragma once

#include "tracer/accel/builders.h"

/* How a part is divided: by items; by items, or by space if their boxes would overlap; by space first. */
enum sah_splits { SAH_OBJECTS, SAH_SPATIAL, SAH_PLANES };

/** Most bins per axis. */
#define SAH_MAX_BINS 32

/**
 * @param in         with SAH_OBJECTS, room is n and triangles are NULL
 * @param most_bins  at most SAH_MAX_BINS
 */
int sah_build_plain(enum sah_splits splits, const struct bvh_input *in, uint32_t most_bins, struct tree *out);
int sah_build_avx2(enum sah_splits splits, const struct bvh_input *in, uint32_t most_bins, struct tree *out);
