/*
 * Flat pictures laid on surfaces, found in a single frame: draws that write no depth, or are offset towards the
 * viewer, and lie on something drawn earlier. Such a draw is a shadow if it only darkens and an object rests on it,
 * else a decal.
 */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

enum laid {
	LAID_NOT, LAID_DECAL, LAID_SHADOW,
	LAID_LIT_SHADOW, /* lit by a light of OpenGL's where it lies */
	LAID_UNKNOWN     /* out of sight, where programs may leave out the surface below */
};

/** 1 if an instance is drawn the way such pictures are, wherever it lies. */
int laid_may_be(const struct scene *scene, uint32_t instance);

/**
 * Classify instances.
 * @param out  enum laid, [n_instances]. Only instances that are not LAID_NOT on entry and pass laid_may_be are tested
 * @return 0 or ERR_SYSTEM (reported)
 */
int laid_find(const struct scene *scene, uint8_t *out);
