/*
 * Flat pictures laid on surfaces, told by one frame: a draw that leaves no depth, or is offset towards the viewer, and
 * lies on something that was drawn before it. It is a shadow where it only darkens and a thing stands on it, else a
 * decal.
 */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

enum laid {
	LAID_NOT, LAID_DECAL, LAID_SHADOW,
	LAID_LIT_SHADOW, /* a light of OpenGL's lights what it lies on */
	LAID_UNKNOWN     /* it is out of sight, where programs leave out what it may lie on */
};

/** 1 where an instance is drawn as such pictures are, wherever it lies. */
int laid_may_be(const struct scene *scene, uint32_t instance);

/**
 * What instances are.
 * @param out  enum laid, [n_instances]; asked for where it is not LAID_NOT, and of laid_may_be
 * @return 0 or ERR_SYSTEM (reported)
 */
int laid_find(const struct scene *scene, uint8_t *out);
