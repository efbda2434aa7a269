/*
 * Texture sampling (GL 2.1 sec. 3.8.6 - 3.8.9, 3.8.14): wrapping, filtering, mipmaps, cubes, borders, depth comparison.
 */
#ifndef KERNELS_GL_TEXTURE_H
#define KERNELS_GL_TEXTURE_H

#include "gl_tokens.h"
#include "kernels/common.h"
#include "kernels/gl_tables.h"

#define TEXTURE_OUTSIDE (-0x7fffffff) /* a texel position that is the border colour */

static inline uint32_t texture_level_size(uint32_t size, uint32_t level)
{
	return size >> level ? size >> level : 1u;
}

/* i modulo n for any i, n > 0 */
static inline int texture_modulo(int i, int n)
{
	int r = i % n;

	return r < 0 ? r + n : r;
}

/* An integer of a coordinate that may be anything, NaN too. */
static inline int texture_int(float x)
{
	return x > -1.0e9f ? (x < 1.0e9f ? (int)x : 1000000000) : -1000000000;
}

/* A texel beyond the image: clamped, or the border (its texel where the image has one, else the border colour). */
static inline int texture_edge(uint32_t wrap, int i, int n, uint32_t border)
{
	if (wrap == GL_CLAMP || wrap == GL_CLAMP_TO_BORDER || wrap == GL_MIRROR_CLAMP_EXT ||
	    wrap == GL_MIRROR_CLAMP_TO_BORDER_EXT) {
		if (i >= 0 && i < n)
			return i;
		if (border)
			return i < 0 ? -1 : n;
		return TEXTURE_OUTSIDE;
	}
	return i < 0 ? 0 : i < n ? i : n - 1;
}

/*
 * Where a coordinate falls on a row of n texels.
 *
 * @param linear  0: *i0 is the nearest texel. 1: *i0, *i1 and the weight of *i1
 */
static inline void texture_wrap(uint32_t wrap, float s, int normalized, uint32_t size, uint32_t border, int linear,
                                int *i0, int *i1, float *weight)
{
	int n = (int)size, first, second;
	float u, base;

	if (wrap == GL_REPEAT && normalized)
		s -= M_FLOOR(s); /* keeps u small enough to be exact */
	u = normalized ? s * (float)n : s;
	if (wrap == GL_MIRROR_CLAMP_EXT || wrap == GL_MIRROR_CLAMP_TO_EDGE_EXT || wrap == GL_MIRROR_CLAMP_TO_BORDER_EXT)
		u = M_ABS(u);
	if (wrap == GL_CLAMP || wrap == GL_MIRROR_CLAMP_EXT)
		u = M_MIN(M_MAX(u, 0.0f), (float)n);
	/* With nearest filtering, CLAMP reaches no border texel (sec. 3.8.8: the coordinate 1 belongs to the last one). */
	if (wrap == GL_CLAMP && !linear)
		u = M_MIN(u, (float)n - 0.5f);
	if (linear)
		u -= 0.5f;
	base = M_FLOOR(u);
	first = texture_int(base);
	second = first + 1;
	*weight = u - base;
	if (wrap == GL_REPEAT) {
		first = texture_modulo(first, n);
		second = texture_modulo(second, n);
	} else if (wrap == GL_MIRRORED_REPEAT) {
		first = texture_modulo(first, 2 * n);
		first = first < n ? first : 2 * n - 1 - first;
		second = texture_modulo(second, 2 * n);
		second = second < n ? second : 2 * n - 1 - second;
	} else {
		first = texture_edge(wrap, first, n, border);
		second = texture_edge(wrap, second, n, border);
	}
	*i0 = first;
	*i1 = second;
}

/* One texel of a level; `layer`: slice of a 3D image or face of a cube. */
static inline struct vec4 texture_texel(const struct tables *t, GLOBAL const struct texture_image *image,
                                        GLOBAL const struct scene_unit *unit, uint32_t level, int x, int y, int layer)
{
	uint32_t border = image->border;
	uint32_t width = texture_level_size(image->width, level) + 2u * border;
	uint32_t height = image->target == GL_TEXTURE_1D ? 1u : texture_level_size(image->height, level) + 2u * border;
	uint32_t texel;

	if (x == TEXTURE_OUTSIDE || y == TEXTURE_OUTSIDE || layer == TEXTURE_OUTSIDE)
		return v4_load(unit->border_color);
	x += (int)border;
	if (image->target != GL_TEXTURE_1D)
		y += (int)border;
	if (image->target == GL_TEXTURE_3D)
		layer += (int)border;
	texel = t->texels[image->level_first[level] + ((uint32_t)layer * height + (uint32_t)y) * width + (uint32_t)x];
	if (image->base_format == GL_DEPTH_COMPONENT) {
		float d = M_FLOAT(texel);

		return v4(d, d, d, d);
	}
	return v4((float)(texel & 255u) / 255.0f, (float)(texel >> 8 & 255u) / 255.0f, (float)(texel >> 16 & 255u) / 255.0f,
	          (float)(texel >> 24) / 255.0f);
}

/* Comparison of sec. 3.8.14, and how a depth becomes a colour. */
static inline struct vec4 texture_depth(GLOBAL const struct scene_unit *unit, float depth, float reference)
{
	float d = depth;

	if (unit->compare_mode == GL_COMPARE_R_TO_TEXTURE) {
		float r = clamp01(reference);
		int pass = 1;

		switch (unit->compare_func) {
		case GL_LEQUAL: pass = r <= depth; break;
		case GL_GEQUAL: pass = r >= depth; break;
		case GL_LESS: pass = r < depth; break;
		case GL_GREATER: pass = r > depth; break;
		case GL_EQUAL: pass = r == depth; break;
		case GL_NOTEQUAL: pass = r != depth; break;
		case GL_NEVER: pass = 0; break;
		default: break;
		}
		d = pass ? 1.0f : 0.0f;
	}
	if (unit->depth_mode == GL_ALPHA)
		return v4(0.0f, 0.0f, 0.0f, d);
	return v4(d, d, d, unit->depth_mode == GL_INTENSITY ? d : 1.0f);
}

/* One level with one filter. c: coordinates, already divided by q; face: of a cube, else 0. */
static inline struct vec4 texture_level(const struct tables *t, GLOBAL const struct texture_image *image,
                                        GLOBAL const struct scene_unit *unit, uint32_t level, int linear,
                                        struct vec4 c, int face)
{
	int normalized = image->target != GL_TEXTURE_RECTANGLE;
	uint32_t wrap_s = image->target == GL_TEXTURE_CUBE_MAP ? GL_CLAMP_TO_EDGE : unit->wrap_s;
	uint32_t wrap_t = image->target == GL_TEXTURE_CUBE_MAP ? GL_CLAMP_TO_EDGE : unit->wrap_t;
	int x[2], y[2] = { 0, 0 }, z[2];
	float wx, wy = 0.0f, wz = 0.0f;
	int n_y = 1, n_z = 1;
	struct vec4 sum = v4(0.0f, 0.0f, 0.0f, 0.0f);

	z[0] = z[1] = face;
	texture_wrap(wrap_s, c.x, normalized, texture_level_size(image->width, level), image->border, linear, &x[0], &x[1],
	             &wx);
	if (image->target != GL_TEXTURE_1D) {
		texture_wrap(wrap_t, c.y, normalized, texture_level_size(image->height, level), image->border, linear, &y[0],
		             &y[1], &wy);
		n_y = 1 + linear;
	}
	if (image->target == GL_TEXTURE_3D) {
		texture_wrap(unit->wrap_r, c.z, 1, texture_level_size(image->depth, level), image->border, linear, &z[0],
		             &z[1], &wz);
		n_z = 1 + linear;
	}
	for (int k = 0; k < n_z; k++) {
		struct vec4 slice = v4(0.0f, 0.0f, 0.0f, 0.0f);

		for (int j = 0; j < n_y; j++) {
			struct vec4 row = texture_texel(t, image, unit, level, x[0], y[j], z[k]);

			if (image->base_format == GL_DEPTH_COMPONENT)
				row = texture_depth(unit, row.x, c.z);
			if (linear) {
				struct vec4 next = texture_texel(t, image, unit, level, x[1], y[j], z[k]);

				if (image->base_format == GL_DEPTH_COMPONENT)
					next = texture_depth(unit, next.x, c.z);
				row = v4_mix(row, next, wx);
			}
			slice = j == 0 ? row : v4_mix(slice, row, wy);
		}
		sum = k == 0 ? slice : v4_mix(sum, slice, wz);
	}
	return sum;
}

/* Face of a cube and its coordinates in [0,1] (table 3.19). */
static inline struct vec4 texture_cube(struct vec4 c, int *face)
{
	float ax = M_ABS(c.x), ay = M_ABS(c.y), az = M_ABS(c.z), sc, tc, ma;

	if (ax >= ay && ax >= az) {
		*face = c.x >= 0.0f ? 0 : 1;
		sc = c.x >= 0.0f ? -c.z : c.z;
		tc = -c.y;
		ma = ax;
	} else if (ay >= az) {
		*face = c.y >= 0.0f ? 2 : 3;
		sc = c.x;
		tc = c.y >= 0.0f ? c.z : -c.z;
		ma = ay;
	} else {
		*face = c.z >= 0.0f ? 4 : 5;
		sc = c.z >= 0.0f ? c.x : -c.x;
		tc = -c.y;
		ma = az;
	}
	ma = ma > 0.0f ? 0.5f / ma : 0.0f;
	return v4(sc * ma + 0.5f, tc * ma + 0.5f, 0.0f, 1.0f);
}

/* 1 where the level of detail matters to the unit. */
static inline int texture_needs_lod(GLOBAL const struct scene_unit *unit)
{
	return unit->min_filter != unit->mag_filter;
}

/*
 * Level of detail from the coordinates at a pixel and at its quad's neighbours to the right and below, before division.
 * llvmpipe takes one level for each 2x2 quad, from its upper row and left column.
 */
static inline float texture_lod(GLOBAL const struct texture_image *image, GLOBAL const struct scene_unit *unit,
                                struct vec4 at, struct vec4 right, struct vec4 below)
{
	float w = image->target == GL_TEXTURE_RECTANGLE ? 1.0f : (float)image->width;
	float h = image->target == GL_TEXTURE_RECTANGLE ? 1.0f : image->target == GL_TEXTURE_1D ? 0.0f : (float)image->height;
	float d = image->target == GL_TEXTURE_3D ? (float)image->depth : 0.0f;
	struct vec4 a, b, c, dx, dy;
	float rho2;

	if (image->target == GL_TEXTURE_CUBE_MAP) {
		/* Distances on the sphere around the cube: near the middle of a face they are those on the face. */
		struct vec3 n = v3_normalize(v3(at.x, at.y, at.z));
		struct vec3 nx = v3_sub(v3_normalize(v3(right.x, right.y, right.z)), n);
		struct vec3 ny = v3_sub(v3_normalize(v3(below.x, below.y, below.z)), n);

		rho2 = M_MAX(v3_dot(nx, nx), v3_dot(ny, ny)) * w * w * 0.25f;
	} else {
		a = v4_scale(at, 1.0f / at.w);
		b = v4_scale(right, 1.0f / right.w);
		c = v4_scale(below, 1.0f / below.w);
		dx = v4_sub(b, a);
		dy = v4_sub(c, a);
		rho2 = M_MAX(dx.x * dx.x * w * w + dx.y * dx.y * h * h + dx.z * dx.z * d * d,
		             dy.x * dy.x * w * w + dy.y * dy.y * h * h + dy.z * dy.z * d * d);
	}
	if (!(rho2 > 1.0e-30f))
		return -100.0f;
	if (!(rho2 < 1.0e30f))
		return 100.0f;
	{
		/* llvmpipe's logarithm: exact at powers of two, straight lines between them. */
		uint32_t bits = M_BITS(rho2);
		float exponent = (float)((int)(bits >> 23) - 127);
		float mantissa = M_FLOAT((bits & 0x7fffffu) | 0x3f800000u);
		float lod = 0.5f * (exponent + (mantissa - 1.0f)) + unit->lod_bias;

		return M_MIN(M_MAX(lod, unit->min_lod), unit->max_lod);
	}
}

/* What a unit's texture gives at coordinates s t r q, at a level of detail. */
static inline struct vec4 texture_sample(const struct tables *t, GLOBAL const struct scene_unit *unit, struct vec4 c,
                                         float lod)
{
	GLOBAL const struct texture_image *image = &t->textures[unit->texture];
	uint32_t filter = lod > 0.0f ? unit->min_filter : unit->mag_filter;
	int linear = filter == GL_LINEAR || filter == GL_LINEAR_MIPMAP_NEAREST || filter == GL_LINEAR_MIPMAP_LINEAR;
	float last = (float)(image->n_levels - 1u), level = 0.0f;
	int face = 0;

	if (image->target == GL_TEXTURE_CUBE_MAP)
		c = texture_cube(c, &face);
	else
		c = v4_scale(c, 1.0f / c.w);
	if (filter == GL_NEAREST_MIPMAP_NEAREST || filter == GL_LINEAR_MIPMAP_NEAREST) {
		level = M_MIN(M_MAX(M_FLOOR(lod + 0.5f), 0.0f), last);
	} else if (filter == GL_NEAREST_MIPMAP_LINEAR || filter == GL_LINEAR_MIPMAP_LINEAR) {
		float fine = M_MIN(M_MAX(M_FLOOR(lod), 0.0f), last), part = M_MIN(lod, last) - fine;

		if (part > 0.0f && fine < last)
			return v4_mix(texture_level(t, image, unit, (uint32_t)fine, linear, c, face),
			              texture_level(t, image, unit, (uint32_t)fine + 1u, linear, c, face), part);
		level = fine;
	}
	return texture_level(t, image, unit, (uint32_t)level, linear, c, face);
}

#endif
