/*
 * Planes over sixteen triangles at once, one per lane, and samples of one texture there: what kernels/gl/clip.h and
 * texture.h do for one, in the same order of operations. OpenCL C only.
 *
 * Supports the textures that most programs use (pack_knows_texture): images of four bytes per texel, without a border,
 * repeated or clamped to their edge, either two-dimensional or three-dimensional with one level.
 */
#pragma once

#include "kernels/frame/pack/pack_vector.h"
#include "kernels/gl/fragment.h"
#include "packs.h"

/* --- Numbers ----------------------------------------------------------------------------------------------------- */

#include "kernels/sixteen_lanes.h"
#include "kernels/gl/texture_lanes.h"
#include "kernels/one_lanes.h"

/* Expand a bit mask to all lanes. */
static inline packi pack_mask(uint lanes)
{
	return ((packi)((int)lanes) >> PACK_LANES & 1) != 0;
}

/* --- Planes ------------------------------------------------------------------------------------------------------ */

/* Sixteen of struct clip_edges; area: clip_place_area */
struct pack_edges {
	packi turned;
	packf area, x, y, dx01, dy01, dx20, dy20, one_over_area;
};

struct pack_plane {
	packf origin, along_x, along_y;
};

WIDE_VECTORS static inline void pack_edges_of(const packf *px, const packf *py, struct pack_edges *e)
{
	e->area = (px[0] - px[1]) * (py[2] - py[0]) - (px[2] - px[0]) * (py[0] - py[1]);
	e->turned = e->area < 0.0f;
	e->x = select(px[0], px[1], e->turned);
	e->y = select(py[0], py[1], e->turned);
	e->dx01 = e->x - select(px[1], px[0], e->turned);
	e->dy01 = e->y - select(py[1], py[0], e->turned);
	e->dx20 = px[2] - e->x;
	e->dy20 = py[2] - e->y;
	e->one_over_area = 1.0f / (e->dx01 * e->dy20 - e->dx20 * e->dy01);
}

WIDE_VECTORS static inline struct pack_plane pack_plane_through(const struct pack_edges *e, const packf *value)
{
	const packf first = select(value[0], value[1], e->turned), v01 = first - select(value[1], value[0], e->turned);
	const packf v20 = value[2] - first;
	struct pack_plane out;

	out.along_x = v01 * (e->dy20 * e->one_over_area) - v20 * (e->dy01 * e->one_over_area);
	out.along_y = v20 * (e->dx01 * e->one_over_area) - v01 * (e->dx20 * e->one_over_area);
	out.origin = first - (out.along_x * e->x + out.along_y * e->y);
	return out;
}

WIDE_VECTORS static inline packf pack_plane_at(const struct pack_plane *p, packf x, packf y)
{
	return fma(p->along_y, y, fma(p->along_x, x, p->origin));
}

/* --- Textures ---------------------------------------------------------------------------------------------------- */

static inline int pack_knows_texture(const struct tables *t, __global const struct scene_unit *unit)
{
	__global const struct texture_image *image = &t->textures[unit->texture];

	if (image->target == GL_TEXTURE_3D ? !texture_wrap_is_plain(unit->wrap_r) || texture_needs_slope(t, unit) :
	                                     image->target != GL_TEXTURE_2D)
		return 0;
	return image->base_format != GL_DEPTH_COMPONENT && !image->border && image->words == 1 &&
	       !pack_refuses_shade_unit(unit);
}

/* The level of a unit's texture that each lane samples, and its size and data. */
struct pack_level {
	packu first;        /* start of its texels */
	packi width, height;
};

WIDE_VECTORS static inline struct pack_level pack_level(__global const struct texture_image *image, packi level)
{
	struct pack_level out;

	out.first = image->level_first[0];
	for (uint lane = 0; lane < 16 && any_pack(level != 0); lane++)
		((uint *)&out.first)[lane] = image->level_first[((const int *)&level)[lane]];
	out.width = max((packi)((int)image->width) >> level, 1);
	out.height = max((packi)((int)image->height) >> level, 1);
	return out;
}

/* Two adjacent texels and the weight of the second, as in texture_wrap_8. */
WIDE_VECTORS static inline void pack_wrap_8(uint wrap, packf s, packi n, packi *i0, packi *i1, packu *weight)
{
	const packi power_of_two = (n & (n - 1)) == 0;
	packf at = s * convert_float16(n * 256);
	packi fixed, place;

	if (wrap == GL_REPEAT && any_pack(~power_of_two))
		at = select((s - pack_floor(s)) * convert_float16(n) * 256.0f, at, power_of_two);
	fixed = texture_int(pack_round(at)) - 128;
	place = as_int16((as_uint16(fixed) + 0x80000000u) >> 8) - 0x800000;
	*weight = as_uint16(fixed & 255);
	if (wrap == GL_REPEAT) {
		const packi inside = select(place, place + n, place < 0);

		/* clamped, since coordinates may be NaN */
		*i0 = clamp(select(select(inside, inside - n, inside >= n), place & (n - 1), power_of_two), (packi)(0), n - 1);
		*i1 = select((packi)(0), *i0 + 1, *i0 + 1 < n);
	} else {
		*i0 = clamp(place, (packi)(0), n - 1);
		*i1 = clamp(place + 1, (packi)(0), n - 1);
	}
}

/* texture_wrap for nearest filtering. */
WIDE_VECTORS static inline packi pack_wrap_nearest(uint wrap, packf s, int n)
{
	packi place;

	if (wrap == GL_REPEAT && n & (n - 1))
		s -= pack_floor(s);
	place = texture_int(pack_floor(s * (float)n));
	if (wrap != GL_REPEAT)
		return clamp(place, (packi)(0), (packi)(n - 1));
	if (!(n & (n - 1)))
		return place & (n - 1);
	place = select(place, place + n, place < 0);
	return clamp(select(place, place - n, place >= n), (packi)(0), (packi)(n - 1)); /* coordinates may be NaN */
}

WIDE_VECTORS static inline packu pack_texels(__global const uint *texels, packu place)
{
	return PACK_WORDS(texels, place);
}

/* texture_level_8 for all lanes. c: coordinates s and t, and r for a three-dimensional image */
WIDE_VECTORS static inline packu pack_level_8(const struct tables *t, __global const struct scene_unit *unit,
                                              const struct pack_level *l, const packf *c)
{
	__global const struct texture_image *image = &t->textures[unit->texture];
	const packi slice = l->width * l->height;
	const int n = image->target == GL_TEXTURE_3D ? 2 : 1;
	packi x0, x1, y0, y1, z[2] = { 0, 0 };
	packu wx, wy, wz = 0, texel[2];

	pack_wrap_8(unit->wrap_s, c[0], l->width, &x0, &x1, &wx);
	pack_wrap_8(unit->wrap_t, c[1], l->height, &y0, &y1, &wy);
	if (n == 2)
		pack_wrap_8(unit->wrap_r, c[2], (packi)((int)image->depth), &z[0], &z[1], &wz);
	for (int k = 0; k < n; k++) {
		const packu row0 = l->first + as_uint16(z[k] * slice + y0 * l->width),
			    row1 = l->first + as_uint16(z[k] * slice + y1 * l->width);

		texel[k] = texture_mix_8(texture_mix_8(pack_texels(t->texels, row0 + as_uint16(x0)),
		                                       pack_texels(t->texels, row0 + as_uint16(x1)), wx),
		                         texture_mix_8(pack_texels(t->texels, row1 + as_uint16(x0)),
		                                       pack_texels(t->texels, row1 + as_uint16(x1)), wx),
		                         wy);
	}
	return n == 2 ? texture_mix_8(texel[0], texel[1], wz) : texel[0];
}

/* The nearest texels of level 0. c: as in pack_level_8 */
WIDE_VECTORS static inline packu pack_nearest(const struct tables *t, __global const struct scene_unit *unit,
                                              const packf *c)
{
	__global const struct texture_image *image = &t->textures[unit->texture];
	packi row = pack_wrap_nearest(unit->wrap_t, c[1], (int)image->height);

	if (image->target == GL_TEXTURE_3D)
		row += pack_wrap_nearest(unit->wrap_r, c[2], (int)image->depth) * (int)image->height;
	return pack_texels(t->texels + image->level_first[0],
	                   as_uint16(row * (int)image->width + pack_wrap_nearest(unit->wrap_s, c[0], (int)image->width)));
}

/* Planes of texture coordinates s, t, r and q over w. */
struct pack_coords {
	struct pack_plane plane[4], w_inv;
};

/* out: the first n of s, t and r, divided by q */
WIDE_VECTORS static inline void pack_coords_at(const struct pack_coords *c, packf x, packf y, int n, packf *out)
{
	const packf w = 1.0f / pack_plane_at(&c->w_inv, x, y), q = 1.0f / (pack_plane_at(&c->plane[3], x, y) * w);

	for (int i = 0; i < n; i++)
		out[i] = pack_plane_at(&c->plane[i], x, y) * w * q;
}

/* Sixteen of struct texture_slope, for two coordinates. */
struct pack_slope {
	packf right_s, right_t, down_s, down_t;
};

/* texture_slope for a quad of pixels. */
WIDE_VECTORS static inline void pack_slope_of(__global const struct texture_image *image,
                                              const struct pack_coords *coords, packi x, packi row, float middle,
                                              struct pack_slope *slope)
{
	const packf left = convert_float16(x & ~1), top = convert_float16(row & ~1);
	packf at[2], right[2], down[2];

	pack_coords_at(coords, left + middle, top + middle, 2, at);
	pack_coords_at(coords, left + 1.0f + middle, top + middle, 2, right);
	pack_coords_at(coords, left + middle, top + 1.0f + middle, 2, down);
	slope->right_s = (right[0] - at[0]) * (float)image->width;
	slope->right_t = (right[1] - at[1]) * (float)image->height;
	slope->down_s = (down[0] - at[0]) * (float)image->width;
	slope->down_t = (down[1] - at[1]) * (float)image->height;
}

/* texture_lod for all lanes. */
WIDE_VECTORS static inline packf pack_lod(__global const struct scene_unit *unit, const struct pack_slope *slope,
                                          int anisotropic)
{
	const packf right = slope->right_s * slope->right_s + slope->right_t * slope->right_t;
	const packf down = slope->down_s * slope->down_s + slope->down_t * slope->down_t;
	packf rho2 = fmax(right, down);

	if (anisotropic)
		rho2 = fmax(fmin(right, down), rho2 / (unit->max_anisotropy * unit->max_anisotropy));
	return fmin(fmax(texture_half_log2(rho2) + unit->lod_bias, (packf)(unit->min_lod)), (packf)(unit->max_lod));
}

/* Linear filtering: one or two levels per lane. c: as in pack_level_8 */
WIDE_VECTORS static inline packu pack_filter(const struct tables *t, __global const struct texture_image *image,
                                             __global const struct scene_unit *unit, packf lod, const packf *c)
{
	const packi last = (int)image->n_levels - 1;
	packi fine = 0, smaller = unit->min_filter != GL_LINEAR ? lod > 0.0f : (packi)(0), both;
	packf level, part;
	struct pack_level l;
	packu texel;

	if (any_pack(smaller)) {
		level = pack_floor(unit->min_filter == GL_LINEAR_MIPMAP_NEAREST ? lod + 0.5f : lod);
		level = fmin(fmax(level, (packf)(0)), convert_float16(last));
		fine = select((packi)(0), convert_int16(level), smaller);
	}
	l = pack_level(image, fine);
	texel = pack_level_8(t, unit, &l, c);
	if (unit->min_filter != GL_LINEAR_MIPMAP_LINEAR || !any_pack(smaller))
		return texel;
	part = fmin(lod, convert_float16(last)) - level;
	both = smaller & (part > 0.0f) & (fine < last);
	if (!any_pack(both))
		return texel;
	l = pack_level(image, fine - both);
	return select(texel,
	              texture_mix_8(texel, pack_level_8(t, unit, &l, c),
	                            convert_uint16(select((packf)(0), part, both) * 256.0f)),
	              both);
}
