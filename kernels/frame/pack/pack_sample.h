/* Samples of a unit's texture in the pixels of sixteen fragments, as in texture_sample. OpenCL C only. */
#pragma once

#include "kernels/frame/pack/pack_ellipse.h"

/*
 * Sample a unit's texture at coordinates s, t and r. slope: set if texture_needs_slope. lanes, out: as in pack_sample
 */
WIDE_VECTORS static inline void pack_sample_at(const struct tables *tables, __global const struct scene_unit *unit,
                                               const packf *c, const struct pack_slope *slope, packi lanes, packf *out)
{
	__global const struct texture_image *image = &tables->textures[unit->texture];
	packu texel;

	if (unit->min_filter != GL_NEAREST && texture_is_anisotropic(tables, unit)) {
		pack_anisotropic(tables, image, unit, slope, c, lanes, out);
		return;
	}
	if (unit->min_filter == GL_NEAREST)
		texel = pack_nearest(tables, unit, c);
	else
		texel = pack_filter(tables, image, unit,
		                    unit->min_filter != unit->mag_filter ? pack_lod(unit, slope, 0) : (packf)(0), c);
	for (int i = 0; i < 4; i++)
		out[i] = convert_float16(texel >> (packu)(8 * i) & 255) * (1.0f / 255.0f);
}

/*
 * Sample a unit's texture in each lane's pixel.
 * @param w_inv     1 / w of the corners
 * @param texcoord  the corners' coordinates, [3][4]
 * @param row       from the top. middle: as in struct point_quad
 * @param lanes     lanes to sample; the others are undefined
 * @param out       [4]
 */
WIDE_VECTORS static inline void pack_sample(const struct tables *tables, __global const struct scene_unit *unit,
                                            const struct pack_edges *edges, const packf *w_inv, packf (*texcoord)[4],
                                            packi x, packi row, float middle, packi lanes, packf *out)
{
	__global const struct texture_image *image = &tables->textures[unit->texture];
	const packf px = convert_float16(x) + middle, py = convert_float16(row) + middle;
	struct pack_coords coords;
	struct pack_slope slope;
	const int n = image->target == GL_TEXTURE_3D ? 3 : 2;
	packf over_w[3], c[3];

	coords.w_inv = pack_plane_through(edges, w_inv);
	for (int i = 0; i < 4; i++) {
		if (i >= n && i != 3)
			continue;
		for (int k = 0; k < 3; k++)
			over_w[k] = texcoord[k][i] * w_inv[k];
		coords.plane[i] = pack_plane_through(edges, over_w);
	}
	pack_coords_at(&coords, px, py, n, c);
	if (texture_needs_slope(tables, unit))
		pack_slope_of(image, &coords, x, row, middle, &slope);
	pack_sample_at(tables, unit, c, &slope, lanes, out);
}
