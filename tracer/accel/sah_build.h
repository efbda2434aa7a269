/*
 * The builder by surface area (sah_build.inc), compiled for any processor (sah.c) and for AVX2 (sah_avx2.c): both give
 * the same tree. sah.c chooses.
 */
#pragma once

#include "tracer/accel/builders.h"

/* How a part is divided: its items; items, or space where these would overlap; space first of all. */
enum sah_splits { SAH_OBJECTS, SAH_SPATIAL, SAH_PLANES };

/** Bins of an axis, at most. */
#define SAH_MAX_BINS 32

/**
 * @param in         room is n, and triangles are NULL, with SAH_OBJECTS
 * @param most_bins  at most SAH_MAX_BINS
 */
int sah_build_plain(enum sah_splits splits, const struct bvh_input *in, uint32_t most_bins, struct tree *out);
int sah_build_avx2(enum sah_splits splits, const struct bvh_input *in, uint32_t most_bins, struct tree *out);
