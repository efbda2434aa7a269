/*
 * Analyses whether programs show a texture unchanged: how a fragment program uses its texels, and where a vertex
 * program places them.
 */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

struct shown_program {
	uint32_t unit;           /* the unit whose texels become the fragments' colours */
	uint32_t coordinates[2]; /* components that address the texture, numbered over all texture coordinates, four per
	                            unit */
};

/**
 * @return 1 if a material's fragment program outputs texels unchanged, discards no fragment and does not write depth
 */
int shown_program_of(const struct scene *s, const struct scene_material *m, struct shown_program *out);

/**
 * Run a vertex program for vertex v. @param coordinates  [4 * SCENE_MAX_UNITS]. @return 0: the position is computed by
 * fixed function; clip is not set
 */
int shown_program_vertex(const struct scene *s, const struct scene_instance *in, uint32_t v, float clip[4],
                         float *coordinates);
