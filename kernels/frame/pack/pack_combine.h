/* Texture environments in sixteen lanes, using the text of combine.h. OpenCL C only. */
#pragma once

#include "kernels/frame/pack/pack_texture.h"
#include "kernels/gl/combine.h"

/* Index of the material's unit with a given GL unit number; unit_count: none. units: the material's */
static inline uint pack_find_unit(__global const struct scene_material *m, __global const struct scene_unit *units,
                                  uint number)
{
	uint i = 0;

	while (i < m->unit_count && units[i].unit != number)
		i++;
	return i;
}

/* Test whether the units that unit i takes colours from exist. */
static inline int pack_has_sources(__global const struct scene_material *m, __global const struct scene_unit *units,
                                   uint i)
{
	__global const struct scene_unit *unit = &units[i];
	int has = 1;

	for (uint k = 0; k < 3 && has && unit->env_mode == GL_COMBINE; k++)
		has = (unit->source_rgb[k] - GL_TEXTURE0 >= SCENE_MAX_UNITS ||
		       pack_find_unit(m, units, unit->source_rgb[k] - GL_TEXTURE0) < m->unit_count) &&
		      (unit->source_alpha[k] - GL_TEXTURE0 >= SCENE_MAX_UNITS ||
		       pack_find_unit(m, units, unit->source_alpha[k] - GL_TEXTURE0) < m->unit_count);
	return has;
}

#include "kernels/sixteen_lanes.h"
#include "kernels/gl/combine_lanes.h"
#include "kernels/one_lanes.h"
