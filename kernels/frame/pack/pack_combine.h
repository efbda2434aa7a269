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

/* Test whether packs can handle unit i: its sources exist, and products of colours are only used for colours. */
static inline int pack_knows_combine(__global const struct scene_material *m, __global const struct scene_unit *units,
                                     uint i)
{
	__global const struct scene_unit *unit = &units[i];
	int known = unit->combine_alpha != GL_DOT3_RGB && unit->combine_alpha != GL_DOT3_RGBA &&
	            unit->combine_alpha != GL_DOT3_RGB_EXT && unit->combine_alpha != GL_DOT3_RGBA_EXT;

	if (unit->env_mode != GL_COMBINE)
		return unit->env_mode != GL_COMBINE4_NV;
	for (uint k = 0; k < 3 && known; k++)
		known = (unit->source_rgb[k] - GL_TEXTURE0 >= SCENE_MAX_UNITS ||
		         pack_find_unit(m, units, unit->source_rgb[k] - GL_TEXTURE0) < m->unit_count) &&
		        (unit->source_alpha[k] - GL_TEXTURE0 >= SCENE_MAX_UNITS ||
		         pack_find_unit(m, units, unit->source_alpha[k] - GL_TEXTURE0) < m->unit_count);
	return known;
}

#include "kernels/sixteen_lanes.h"
#include "kernels/gl/combine_lanes.h"
#include "kernels/one_lanes.h"
