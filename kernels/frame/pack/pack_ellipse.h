/*
 * Anisotropic texture samples in sixteen lanes, in the order of operations of texture_ellipse. Each lane has its own
 * footprint; all lanes process their texels row by row together, until none has any left. OpenCL C only.
 */
#pragma once

#include "kernels/frame/pack/pack_texture.h"

/* Positions of a row's texels, as in texture_place for the two plain wraps. */
WIDE_VECTORS static inline packi pack_place_texel(uint wrap, packi i, packi n)
{
	const packi power_of_two = (n & (n - 1)) == 0;
	packi rest;

	if (wrap != GL_REPEAT)
		return clamp(i, (packi)(0), n - 1);
	if (!any_pack(~power_of_two))
		return i & (n - 1);
	rest = i % n;
	return select(rest, rest + n, rest < 0);
}

/* Footprints: u, v are their centres in texels; a, b, e the scaled ellipses; then their first texels and sizes in
 * texels. */
struct pack_footprint {
	packf u, v, a, b, e, first_x, first_y;
	packi columns, rows;
};

/*
 * Footprints as in texture_ellipse.
 * @return the lanes, out of `lanes`, that have one that extends over less than 64 texels
 */
WIDE_VECTORS static inline packi pack_footprint(const struct pack_level *l, const struct pack_slope *slope, packi level,
                                                packf s, packf t, packi lanes, struct pack_footprint *out)
{
	const packf scale = as_float16((127 - level) << 23);
	const packf ux = slope->right_s * scale, vx = slope->right_t * scale, uy = slope->down_s * scale,
		    vy = slope->down_t * scale;
	const packf a = vx * vx + vy * vy + 1.0f, b = -2.0f * (ux * vx + uy * vy), e = ux * ux + uy * uy + 1.0f;
	const packf f = a * e - b * b * 0.25f, d = 4.0f * e * a - b * b, enlarge = 1023.0f / f;
	const packf reach_u = 2.0f / d * sqrt(d * e * f), reach_v = 2.0f / d * sqrt(a * d * f);

	out->u = s * convert_float16(l->width) - 0.5f;
	out->v = t * convert_float16(l->height) - 0.5f;
	out->a = a * enlarge;
	out->b = b * enlarge;
	out->e = e * enlarge;
	out->first_x = pack_floor(out->u - reach_u);
	out->first_y = pack_floor(out->v - reach_v);
	lanes &= (reach_u < 64.0f) & (reach_v < 64.0f) & (fabs(out->u) < TEXTURE_FAR) & (fabs(out->v) < TEXTURE_FAR);
	out->columns = (texture_int(-pack_floor(-(out->u + reach_u)) - out->first_x) + 1) & lanes;
	out->rows = (texture_int(-pack_floor(-(out->v + reach_v)) - out->first_y) + 1) & lanes;
	return lanes;
}

static inline int pack_most(packi x)
{
	const int8 eight = max(x.lo, x.hi);
	const int4 four = max(eight.lo, eight.hi);
	const int2 two = max(four.lo, four.hi);

	return max(two.x, two.y);
}

/*
 * The columns of a row that an ellipse covers, starting at *first. The range is enlarged beyond any rounding error; q
 * decides which texels are inside.
 * @param dy  from the centre to the row
 * @return the number of columns; 0 in a lane whose ellipse does not reach the row
 */
WIDE_VECTORS static inline packi pack_row_of_ellipse(const struct pack_footprint *at, packf dy, packi rows_left,
                                                     packi *first)
{
	const packf bdy = at->b * dy, rest = bdy * bdy - 4.0f * at->a * (at->e * dy * dy - 1040.0f);
	const packf half_width = sqrt(select((packf)(0), rest, rest > 0.0f)), over = 0.5f / at->a, from = at->u - at->first_x;
	const packi begin = texture_int(-pack_floor(0.01f - (from - (bdy + half_width) * over)));
	const packi end = texture_int(pack_floor(from + (half_width - bdy) * over + 0.01f)) + 1;

	*first = max(begin, (packi)(0));
	return (min(end, at->columns) - *first) & rows_left & (rest > 0.0f);
}

/* The Gaussian at positions inside the ellipse, 0 outside. */
WIDE_VECTORS static inline packf pack_gauss(packf q, packi there)
{
	const packu place = as_uint16(convert_int16(select((packf)(0), q, there & (q > 0.0f))));

	return select((packf)(0), as_float16(PACK_WORDS(gauss_weight, place)), there);
}

/*
 * The weighted texels of footprints.
 * @param out  [4]
 * @return the lanes that have any
 */
WIDE_VECTORS static inline packi pack_ellipse(const struct tables *tables, __global const struct scene_unit *unit,
                                              const struct pack_level *l, const struct pack_footprint *at, packf *out)
{
	const int rows = pack_most(at->rows);
	packf red = 0.0f, green = 0.0f, blue = 0.0f, alpha = 0.0f, sum_weight = 0.0f;

	for (int j = 0; j < rows; j++) {
		const packf y = at->first_y + (float)j, dy = y - at->v;
		packi first;
		const packi columns = pack_row_of_ellipse(at, dy, j < at->rows, &first);
		const int most = pack_most(columns);
		const packu row = l->first +
		                  as_uint16(pack_place_texel(unit->wrap_t, texture_int(y), l->height) * l->width);

		for (int k = 0; k < most; k++) {
			const packf x = at->first_x + convert_float16(first + k), dx = x - at->u;
			const packf q = (at->e * dy + at->b * dx) * dy + at->a * dx * dx;
			const packf weight = pack_gauss(q, (q < 1024.0f) & (k < columns)), scale = 1.0f / 255.0f;
			const packu texel = pack_texels(
				tables->texels,
				row + as_uint16(pack_place_texel(unit->wrap_s, texture_int(x), l->width)));

			red += convert_float16(texel & 255) * scale * weight;
			green += convert_float16(texel >> 8 & 255) * scale * weight;
			blue += convert_float16(texel >> 16 & 255) * scale * weight;
			alpha += convert_float16(texel >> 24) * scale * weight;
			sum_weight += weight;
		}
	}
	out[0] = red * (1.0f / sum_weight);
	out[1] = green * (1.0f / sum_weight);
	out[2] = blue * (1.0f / sum_weight);
	out[3] = alpha * (1.0f / sum_weight);
	return sum_weight > 0.0f;
}

/* Samples of a unit with anisotropic filtering: one level per lane. */
WIDE_VECTORS static inline void pack_anisotropic(const struct tables *t, __global const struct texture_image *image,
                                                 __global const struct scene_unit *unit, const struct pack_slope *slope,
                                                 const packf *c, packi lanes, packf *out)
{
	const int nearest = unit->min_filter == GL_NEAREST_MIPMAP_NEAREST || unit->min_filter == GL_LINEAR_MIPMAP_NEAREST;
	const packf lod = pack_lod(unit, slope, 1);
	struct pack_footprint at;
	struct pack_level l;
	packi level = 0, whole;

	if (unit->min_filter != GL_LINEAR)
		level = convert_int16(fmin(fmax(pack_floor(nearest ? lod + 0.5f : lod), (packf)(0)),
		                           (packf)((float)image->n_levels - 1.0f)));
	l = pack_level(image, level);
	whole = pack_footprint(&l, slope, level, c[0], c[1], lanes, &at);
	whole &= pack_ellipse(t, unit, &l, &at, out);
	if (any_pack(lanes & ~whole)) {
		const packu texel = pack_level_8(t, unit, &l, c);

		for (int i = 0; i < 4; i++)
			out[i] = select(convert_float16(texel >> (packu)(8 * i) & 255) * (1.0f / 255.0f), out[i], whole);
	}
}
