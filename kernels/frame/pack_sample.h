/* A unit's texture in the pixels of sixteen fragments, as texture_sample has it for one. OpenCL C only. */
#pragma once

#include "kernels/frame/pack_ellipse.h"

/* A unit's texture at coordinates s and r. slope: where texture_needs_slope. lanes, out: as of pack_sample */
WIDE_VECTORS static inline void pack_sample_at(const struct tables *tables, __global const struct scene_unit *unit, packf s, packf r,
                                               const struct pack_slope *slope, packi lanes, packf *out)
{
	__global const struct texture_image *image = &tables->textures[unit->texture];
	packu texel;

	if (unit->min_filter != GL_NEAREST && texture_is_anisotropic(tables, unit)) {
		pack_anisotropic(tables, image, unit, slope, s, r, lanes, out);
		return;
	}
	if (unit->min_filter == GL_NEAREST) {
		const packu at = as_uint16(pack_wrap_nearest(unit->wrap_t, r, (int)image->height) * (int)image->width +
		                           pack_wrap_nearest(unit->wrap_s, s, (int)image->width));

		texel = pack_texels(tables->texels + image->level_first[0], at);
	} else {
		texel = pack_filter(tables, image, unit, unit->min_filter != unit->mag_filter ? pack_lod(unit, slope, 0) : (packf)(0), s, r);
	}
	for (int i = 0; i < 4; i++)
		out[i] = convert_float16(texel >> (packu)(8 * i) & 255) * (1.0f / 255.0f);
}

/*
 * A unit's texture in each lane's pixel.
 * @param w_inv     1 / w of the corners
 * @param texcoord  theirs, [3][4]
 * @param row       from the top. middle: as in struct point_quad
 * @param lanes     that count: others' samples are undefined
 * @param out       [4]
 */
WIDE_VECTORS static inline void pack_sample(const struct tables *tables, __global const struct scene_unit *unit, const struct pack_edges *edges,
                                            const packf *w_inv, packf (*texcoord)[4], packi x, packi row, float middle, packi lanes,
                                            packf *out)
{
	__global const struct texture_image *image = &tables->textures[unit->texture];
	const packf px = convert_float16(x) + middle, py = convert_float16(row) + middle;
	struct pack_coords coords;
	struct pack_slope slope;
	packf over_w[3], s, t;

	coords.w_inv = pack_plane_through(edges, w_inv);
	for (int k = 0; k < 3; k++)
		over_w[k] = texcoord[k][0] * w_inv[k];
	coords.s = pack_plane_through(edges, over_w);
	for (int k = 0; k < 3; k++)
		over_w[k] = texcoord[k][1] * w_inv[k];
	coords.t = pack_plane_through(edges, over_w);
	for (int k = 0; k < 3; k++)
		over_w[k] = texcoord[k][3] * w_inv[k];
	coords.q = pack_plane_through(edges, over_w);
	pack_coords_at(&coords, px, py, &s, &t);
	if (texture_needs_slope(tables, unit))
		pack_slope_of(image, &coords, x, row, middle, &slope);
	pack_sample_at(tables, unit, s, t, &slope, lanes, out);
}
