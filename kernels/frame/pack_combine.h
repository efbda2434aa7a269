/* Texture environments in sixteen lanes: what combine.h does for one, in the same order of operations. OpenCL C
 * only. */
#pragma once

#include "kernels/frame/pack_texture.h"
#include "kernels/gl/combine.h"

struct pack_color {
	packf c[4];
};

/* As combine_plain. */
WIDE_VECTORS static inline struct pack_color pack_combine(uint mode, uint format, const struct pack_color *p,
                                                          const packf *s, __global const float *e)
{
	struct pack_color out = *p;

	if (mode == GL_DECAL) {
		const packf a = format == GL_RGBA ? s[3] : (packf)(1);

		for (int i = 0; i < 3 && (format == GL_RGB || format == GL_RGBA || format == GL_RED || format == GL_RG); i++)
			out.c[i] = p->c[i] * (1.0f - a) + s[i] * a;
		return out;
	}
	for (int i = 0; i < 3 && combine_has_color(format); i++)
		out.c[i] = mode == GL_REPLACE ? s[i] : mode == GL_BLEND ? p->c[i] * (1.0f - s[i]) + e[i] * s[i] :
		           mode == GL_ADD ? p->c[i] + s[i] : p->c[i] * s[i];
	if (combine_has_alpha(format))
		out.c[3] = mode == GL_REPLACE                         ? s[3] :
		           mode == GL_BLEND && format == GL_INTENSITY ? p->c[3] * (1.0f - s[3]) + e[3] * s[3] :
		           mode == GL_ADD && format == GL_INTENSITY   ? p->c[3] + s[3] :
		                                                        p->c[3] * s[3];
	for (int i = 0; i < 4 && mode == GL_ADD; i++)
		out.c[i] = clamp01(out.c[i]);
	return out;
}

/* Which of a material's units a number of GL's belongs to; unit_count: none. units: the material's */
static inline uint pack_find_unit(__global const struct scene_material *m, __global const struct scene_unit *units,
                                  uint number)
{
	uint i = 0;

	while (i < m->unit_count && units[i].unit != number)
		i++;
	return i;
}

/* Whether pack_combine and pack_combine_full know what unit i asks for: sources that are there, products of colours for
 * colours alone. */
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

/* What the arguments of unit i are made of. */
struct pack_sources {
	__global const struct scene_material *material;
	__global const struct scene_unit *units; /* the material's */
	uint i;
	const struct pack_color *previous, *primary;
	const packf (*samples)[4];               /* in the order of the units */
};

/* As combine_argument, one channel. c: of red, green, blue and alpha */
WIDE_VECTORS static inline packf pack_argument(const struct pack_sources *s, uint source, uint operand, int c)
{
	const int channel = operand == GL_SRC_ALPHA || operand == GL_ONE_MINUS_SRC_ALPHA ? 3 : c;
	packf a = s->previous->c[channel];

	if (source == GL_TEXTURE)
		a = s->samples[s->i][channel];
	else if (source == GL_PRIMARY_COLOR)
		a = s->primary->c[channel];
	else if (source == GL_CONSTANT)
		a = s->units[s->i].env_color[channel];
	else if (source == GL_ZERO)
		a = 0.0f;
	else if (source == GL_ONE)
		a = 1.0f;
	else if (source >= GL_TEXTURE0 && source < GL_TEXTURE0 + SCENE_MAX_UNITS)
		a = s->samples[pack_find_unit(s->material, s->units, source - GL_TEXTURE0)][channel];
	return operand == GL_ONE_MINUS_SRC_COLOR || operand == GL_ONE_MINUS_SRC_ALPHA ? 1.0f - a : a;
}

/* As combine_function, one channel, but for dot products. */
WIDE_VECTORS static inline packf pack_function(uint function, const packf *a)
{
	switch (function) {
	case GL_REPLACE: return a[0];
	case GL_ADD: return a[0] + a[1];
	case GL_ADD_SIGNED: return a[0] + a[1] - 0.5f;
	case GL_INTERPOLATE: return a[0] * a[2] + a[1] * (1.0f - a[2]);
	case GL_SUBTRACT: return a[0] - a[1];
	case GL_MODULATE_ADD_ATI: return a[0] * a[2] + a[1];
	case GL_MODULATE_SIGNED_ADD_ATI: return a[0] * a[2] + a[1] - 0.5f;
	case GL_MODULATE_SUBTRACT_ATI: return a[0] * a[2] - a[1];
	default: return a[0] * a[1]; /* MODULATE */
	}
}

/* As combine_scaled, one channel of the result. */
WIDE_VECTORS static inline packf pack_scaled(packf value, uint function, float scale)
{
	if (function == GL_DOT3_RGB_EXT || function == GL_DOT3_RGBA_EXT)
		scale = 1.0f;
	value *= scale;
	return combine_leaves_range(function) || scale != 1.0f ? clamp01(value) : value;
}

/*
 * As combine_full for GL_COMBINE, unit i of the material.
 * @param units    the material's
 * @param samples  in their order
 */
WIDE_VECTORS static inline struct pack_color
pack_combine_full(__global const struct scene_material *m, __global const struct scene_unit *units, uint i,
                  const struct pack_color *previous, const struct pack_color *primary, const packf (*samples)[4])
{
	__global const struct scene_unit *unit = &units[i];
	const uint function = unit->combine_rgb;
	const int rgba = function == GL_DOT3_RGBA || function == GL_DOT3_RGBA_EXT;
	const int dot = rgba || function == GL_DOT3_RGB || function == GL_DOT3_RGB_EXT;
	const struct pack_sources from = { m, units, i, previous, primary, samples };
	struct pack_color out;
	packf a[3], sum = 0.0f;

	for (int c = 0; c < 3; c++) {
		for (uint k = 0; k < 3; k++)
			a[k] = pack_argument(&from, unit->source_rgb[k], unit->operand_rgb[k], c);
		if (dot)
			sum = c == 0 ? (a[0] - 0.5f) * (a[1] - 0.5f) : sum + (a[0] - 0.5f) * (a[1] - 0.5f);
		out.c[c] = pack_function(function, a);
	}
	for (int c = 0; c < 3; c++)
		out.c[c] = pack_scaled(dot ? 4.0f * sum : out.c[c], function, unit->scale_rgb);
	for (uint k = 0; k < 3; k++)
		a[k] = pack_argument(&from, unit->source_alpha[k], unit->operand_alpha[k], 3);
	out.c[3] = rgba ? pack_scaled(4.0f * sum, function, unit->scale_alpha) :
	                  pack_scaled(pack_function(unit->combine_alpha, a), unit->combine_alpha, unit->scale_alpha);
	return out;
}
