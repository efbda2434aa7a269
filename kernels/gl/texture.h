/*
 * Texture sampling (GL 2.1 sec. 3.8.6 - 3.8.9, 3.8.14): wrapping, filtering, mipmaps, cubes, borders, depth comparison.
 */
#pragma once

#include "gl_tokens.h"
#include "kernels/common.h"
#include "kernels/gl/gauss.h"
#include "kernels/gl/tables.h"

#define TEXTURE_OUTSIDE (-0x7fffffff) /* a texel position that means the border colour */
/* footprints do not distinguish texels beyond this: steps of 1 would have no effect */
#define TEXTURE_FAR 4194304.0f

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

#include "kernels/gl/texture_lanes.h"

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

/* The texel at position i of a wrapped row of n texels. */
static inline int texture_place(uint32_t wrap, int i, int n, uint32_t border)
{
	if (wrap == GL_REPEAT)
		return texture_modulo(i, n);
	if (wrap == GL_MIRRORED_REPEAT) {
		i = texture_modulo(i, 2 * n);
		return i < n ? i : 2 * n - 1 - i;
	}
	return texture_edge(wrap, i, n, border);
}

/*
 * Texels of a row of n that a coordinate falls on.
 *
 * @param linear  0: *i0 is the nearest texel. 1: *i0, *i1 and the weight of *i1
 */
static inline void texture_wrap(uint32_t wrap, float s, int normalized, uint32_t size, uint32_t border, int linear,
                                int *i0, int *i1, float *weight)
{
	int n = (int)size, first;
	float u, base;

	if (wrap == GL_REPEAT && normalized && (size & (size - 1u)))
		s -= M_FLOOR(s); /* as in llvmpipe, which handles powers of two by integer modulo */
	u = normalized ? s * (float)n : s;
	if (wrap == GL_MIRROR_CLAMP_EXT || wrap == GL_MIRROR_CLAMP_TO_EDGE_EXT || wrap == GL_MIRROR_CLAMP_TO_BORDER_EXT)
		u = M_ABS(u);
	if (wrap == GL_CLAMP || wrap == GL_MIRROR_CLAMP_EXT)
		u = M_MIN(M_MAX(u, 0.0f), (float)n);
	/*
	 * With nearest filtering, CLAMP never reaches a border texel (sec. 3.8.8: the coordinate 1 belongs to the last
	 * texel).
	 */
	if ((wrap == GL_CLAMP || wrap == GL_MIRROR_CLAMP_EXT) && !linear)
		u = M_MIN(u, (float)n - 0.5f);
	if (linear)
		u -= 0.5f;
	base = M_FLOOR(u);
	first = texture_int(base);
	*weight = u - base;
	*i0 = texture_place(wrap, first, n, border);
	*i1 = texture_place(wrap, first + 1, n, border);
}

/* Address of a level's texel; all coordinates must be inside. `layer`: slice of a 3D image, face of a cube, or image of
 * an array. */
static inline GLOBAL const uint32_t *texture_words(const struct tables *t, GLOBAL const struct texture_image *image,
                                                   uint32_t level, int x, int y, int layer)
{
	uint32_t border = image->border;
	uint32_t width = texture_level_size(image->width, level) + 2u * border;
	uint32_t height = image->target == GL_TEXTURE_1D ? 1u : texture_level_size(image->height, level) + 2u * border;

	x += (int)border;
	if (image->target != GL_TEXTURE_1D)
		y += (int)border;
	if (image->target == GL_TEXTURE_3D)
		layer += (int)border;
	return t->texels + image->level_first[level] +
	       (((uint32_t)layer * height + (uint32_t)y) * width + (uint32_t)x) * image->words;
}

/* Four bytes, red lowest, as numbers. They are multiplied, not divided, so that products at the border of the next
 * 8-bit code fall on Mesa's side. */
static inline struct vec4 texture_unpack(uint32_t texel)
{
	const float scale = 1.0f / 255.0f;

	return v4((float)(texel & 255u) * scale, (float)(texel >> 8 & 255u) * scale, (float)(texel >> 16 & 255u) * scale,
	          (float)(texel >> 24) * scale);
}

/* The texel as a colour; outside the image, the border's. */
static inline struct vec4 texture_texel(const struct tables *t, GLOBAL const struct texture_image *image,
                                        GLOBAL const struct scene_unit *unit, uint32_t level, int x, int y, int layer)
{
	GLOBAL const uint32_t *texel;

	if (x == TEXTURE_OUTSIDE || y == TEXTURE_OUTSIDE || layer == TEXTURE_OUTSIDE)
		return v4_load(unit->border_color);
	texel = texture_words(t, image, level, x, y, layer);
	if (image->base_format == GL_DEPTH_COMPONENT) {
		float d = M_FLOAT(*texel);

		return v4(d, d, d, d);
	}
	if (image->words == 4u)
		return v4(M_FLOAT(texel[0]), M_FLOAT(texel[1]), M_FLOAT(texel[2]), M_FLOAT(texel[3]));
	return texture_unpack(*texel);
}

/*
 * Filtering in 8 bits. If every wrap is REPEAT or CLAMP_TO_EDGE, llvmpipe filters without floating point: positions are
 * in 1/256 texel, and each interpolation rounds to 8 bits. The specification leaves the precision open. Exact filtering
 * differs by up to 1.5/255, which gate P detects on a large textured area.
 */

static inline int texture_wrap_is_plain(uint32_t wrap)
{
	return wrap == GL_REPEAT || wrap == GL_CLAMP_TO_EDGE;
}

/* texture_wrap's linear case in 1/256 texel, for the two plain wraps. */
static inline void texture_wrap_8(uint32_t wrap, float s, int normalized, uint32_t size, int *i0, int *i1,
                                  uint32_t *weight)
{
	int n = (int)size, power_of_two = (size & (size - 1u)) == 0u, fixed, place;

	if (wrap == GL_REPEAT && !power_of_two)
		fixed = texture_int(M_RINT((s - M_FLOOR(s)) * (float)n * 256.0f)) - 128;
	else
		fixed = texture_int(M_RINT(normalized ? s * (float)(n * 256) : s * 256.0f)) - 128;
	place = (int)(((uint32_t)fixed + 0x80000000u) >> 8) - 0x800000; /* fixed / 256, rounded down */
	*weight = (uint32_t)fixed & 255u;
	if (wrap == GL_REPEAT) {
		*i0 = power_of_two ? place & (n - 1) : texture_modulo(place, n);
		*i1 = *i0 + 1 < n ? *i0 + 1 : 0;
	} else {
		*i0 = place < 0 ? 0 : place < n ? place : n - 1;
		*i1 = place < 0 ? 0 : place + 1 < n ? place + 1 : n - 1;
	}
}

/* 1 if a texture is filtered in 8 bits. */
static inline int texture_is_plain(GLOBAL const struct texture_image *image, GLOBAL const struct scene_unit *unit)
{
	if (image->base_format == GL_DEPTH_COMPONENT || image->border || image->words == 4u)
		return 0;
	if (image->target == GL_TEXTURE_CUBE_MAP)
		return 1;
	return texture_wrap_is_plain(unit->wrap_s) &&
	       (image->target == GL_TEXTURE_1D || texture_wrap_is_plain(unit->wrap_t)) &&
	       (image->target != GL_TEXTURE_3D || texture_wrap_is_plain(unit->wrap_r));
}

/* One level, filtered linearly in 8 bits. c: coordinates, already divided by q; face: face of a cube, layer of an
 * array, else 0. */
static inline uint32_t texture_level_8(const struct tables *t, GLOBAL const struct texture_image *image,
                                       GLOBAL const struct scene_unit *unit, uint32_t level, struct vec4 c, int face)
{
	int normalized = image->target != GL_TEXTURE_RECTANGLE, cube = image->target == GL_TEXTURE_CUBE_MAP;
	int x[2], y[2] = { 0, 0 }, z[2], n_y = image->target == GL_TEXTURE_1D ? 1 : 2,
		  n_z = image->target == GL_TEXTURE_3D ? 2 : 1;
	const uint32_t width = texture_level_size(image->width, level),
		       height = n_y == 1 ? 1u : texture_level_size(image->height, level);
	GLOBAL const uint32_t *texels = t->texels + image->level_first[level]; /* no border: texture_is_plain */
	uint32_t wx, wy = 0u, wz = 0u, sum = 0u;

	z[0] = z[1] = face;
	texture_wrap_8(cube ? GL_CLAMP_TO_EDGE : unit->wrap_s, c.x, normalized, width, &x[0], &x[1], &wx);
	if (n_y == 2)
		texture_wrap_8(cube ? GL_CLAMP_TO_EDGE : unit->wrap_t, c.y, normalized, height, &y[0], &y[1], &wy);
	if (n_z == 2)
		texture_wrap_8(unit->wrap_r, c.z, 1, texture_level_size(image->depth, level), &z[0], &z[1], &wz);
	for (int k = 0; k < n_z; k++) {
		GLOBAL const uint32_t *row = texels + ((uint32_t)z[k] * height + (uint32_t)y[0]) * width;
		uint32_t slice = texture_mix_8(row[x[0]], row[x[1]], wx);

		if (n_y == 2) {
			row = texels + ((uint32_t)z[k] * height + (uint32_t)y[1]) * width;
			slice = texture_mix_8(slice, texture_mix_8(row[x[0]], row[x[1]], wx), wy);
		}
		sum = k == 0 ? slice : texture_mix_8(sum, slice, wz);
	}
	return sum;
}

/* Depth comparison (sec. 3.8.14), and conversion of a depth to a colour. */
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

/* One level with one filter. c: coordinates, already divided by q; face: as in texture_level_8. */
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

	if (linear && texture_is_plain(image, unit))
		return texture_unpack(texture_level_8(t, image, unit, level, c, face));
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

/* Test whether a number's sign bit is set, also for zero. */
static inline int texture_is_negative(float x)
{
	return (int)(M_BITS(x) >> 31u);
}

/* Face of a cube for a direction (table 3.19). Between equal axes, z has priority, then y, as in llvmpipe. */
static inline int texture_cube_face(struct vec4 c)
{
	float ax = M_ABS(c.x), ay = M_ABS(c.y), az = M_ABS(c.z);

	if (az >= M_MAX(ax, ay))
		return 4 + texture_is_negative(c.z);
	return ax > ay ? texture_is_negative(c.x) : 2 + texture_is_negative(c.y);
}

/* sc, tc and ma of a direction, or of the difference of two directions, on a face. */
static inline struct vec3 texture_cube_axes(struct vec4 c, int face)
{
	switch (face) {
	case 0: return v3(-c.z, -c.y, c.x);
	case 1: return v3(c.z, -c.y, -c.x);
	case 2: return v3(c.x, c.z, c.y);
	case 3: return v3(c.x, -c.z, -c.y);
	case 4: return v3(c.x, -c.y, c.z);
	default: return v3(-c.x, -c.y, -c.z);
	}
}

/* Face of a cube for a direction, and its coordinates in [0,1]. */
static inline struct vec4 texture_cube(struct vec4 c, int *face)
{
	struct vec3 axes;
	float ma;

	*face = texture_cube_face(c);
	axes = texture_cube_axes(c, *face);
	ma = axes.z > 0.0f ? 0.5f / axes.z : 0.0f;
	return v4(axes.x * ma + 0.5f, axes.y * ma + 0.5f, 0.0f, 1.0f);
}

/* Rate of change of the coordinates: texels of level 0 per pixel, to the right and downwards. */
struct texture_slope {
	struct vec4 right, down;
};

static inline int texture_is_anisotropic(const struct tables *t, GLOBAL const struct scene_unit *unit)
{
	return unit->max_anisotropy > 1.0f && t->textures[unit->texture].target == GL_TEXTURE_2D;
}

/* 1 if the unit needs slopes. */
static inline int texture_needs_slope(const struct tables *t, GLOBAL const struct scene_unit *unit)
{
	return unit->min_filter != unit->mag_filter || texture_is_anisotropic(t, unit);
}

/* 1 if each pixel has its own slopes, as in llvmpipe (22.3.6) for cubes with several levels. Otherwise a quad shares
 * those of its upper left pixel. */
static inline int texture_has_own_slopes(const struct tables *t, GLOBAL const struct scene_unit *unit)
{
	GLOBAL const struct texture_image *image = &t->textures[unit->texture];

	return image->target == GL_TEXTURE_CUBE_MAP && image->n_levels > 1u && unit->min_filter != GL_NEAREST &&
	       unit->min_filter != GL_LINEAR;
}

/* Change of a direction on its face, in texels, by the quotient rule. */
static inline struct vec4 texture_cube_slope(struct vec4 c, struct vec4 step, float size)
{
	int face = texture_cube_face(c);
	struct vec3 at = texture_cube_axes(c, face), by = texture_cube_axes(step, face);
	float scale = at.z > 0.0f ? 0.5f * size / at.z : 0.0f, part = at.z > 0.0f ? by.z / at.z : 0.0f;

	return v4((by.x - at.x * part) * scale, (by.y - at.y * part) * scale, 0.0f, 0.0f);
}

/*
 * Slopes from the coordinates, before division by q, at a pixel of a 2x2 quad and at its neighbours there. llvmpipe
 * computes them once per quad, at its upper left pixel. With texture_has_own_slopes, each pixel uses its own face, row
 * and column. llvmpipe treats coordinates of rectangles as shares of the size, too, although they are texels.
 *
 * @param right  the pixel beside it; below: the one below or above it
 */
static inline struct texture_slope texture_slope(GLOBAL const struct texture_image *image, struct vec4 at,
                                                 struct vec4 right, struct vec4 below)
{
	struct vec4 size = v4((float)image->width, (float)image->height, (float)image->depth, 0.0f);
	struct texture_slope slope;

	if (image->target == GL_TEXTURE_CUBE_MAP) {
		slope.right = texture_cube_slope(at, v4_sub(right, at), size.x);
		slope.down = texture_cube_slope(at, v4_sub(below, at), size.x);
		return slope;
	}
	if (image->target == GL_TEXTURE_1D)
		size.y = 0.0f;
	if (image->target != GL_TEXTURE_3D)
		size.z = 0.0f;
	at = v4_scale(at, 1.0f / at.w);
	slope.right = v4_mul(v4_sub(v4_scale(right, 1.0f / right.w), at), size);
	slope.down = v4_mul(v4_sub(v4_scale(below, 1.0f / below.w), at), size);
	return slope;
}

static inline float texture_lod(GLOBAL const struct scene_unit *unit, const struct texture_slope *slope,
                                int anisotropic)
{
	float px2 = v4_dot(slope->right, slope->right), py2 = v4_dot(slope->down, slope->down), rho2 = M_MAX(px2, py2);

	/* The short axis of the footprint determines the level, unless the long one is much longer. */
	if (anisotropic)
		rho2 = M_MAX(M_MIN(px2, py2), rho2 / (unit->max_anisotropy * unit->max_anisotropy));
	return M_MIN(M_MAX(texture_half_log2(rho2) + unit->lod_bias, unit->min_lod), unit->max_lod);
}

/*
 * An elliptic footprint with a Gaussian filter (Heckbert 1989, "Fundamentals of texture mapping and image warping", p.
 * 59), as Mesa's software renderers sample if the maximum anisotropy exceeds 1, magnified or not. One level only;
 * weights in 1024 steps.
 */
static inline struct vec4 texture_ellipse(const struct tables *t, GLOBAL const struct texture_image *image,
                                          GLOBAL const struct scene_unit *unit, uint32_t level,
                                          const struct texture_slope *slope, struct vec4 c)
{
	float scale = 1.0f / (float)(1u << level);
	float ux = slope->right.x * scale, vx = slope->right.y * scale, uy = slope->down.x * scale;
	float vy = slope->down.y * scale;
	float a = vx * vx + vy * vy + 1.0f, b = -2.0f * (ux * vx + uy * vy), e = ux * ux + uy * uy + 1.0f;
	float f = a * e - b * b * 0.25f, d = 4.0f * e * a - b * b;
	float box_u = 2.0f / d * M_SQRT(d * e * f), box_v = 2.0f / d * M_SQRT(a * d * f);
	uint32_t width = texture_level_size(image->width, level), height = texture_level_size(image->height, level);
	float u = c.x * (float)width - 0.5f, v = c.y * (float)height - 0.5f, sum_weight = 0.0f;
	struct vec4 sum = v4(0.0f, 0.0f, 0.0f, 0.0f);

	a *= 1023.0f / f;
	b *= 1023.0f / f;
	e *= 1023.0f / f;
	if (!(box_u < 64.0f && box_v < 64.0f && M_ABS(u) < TEXTURE_FAR && M_ABS(v) < TEXTURE_FAR))
		return texture_level(t, image, unit, level, 1, c, 0);
	for (float y = M_FLOOR(v - box_v); y <= M_CEIL(v + box_v); y += 1.0f) {
		int row = texture_place(unit->wrap_t, texture_int(y), (int)height, image->border);

		for (float x = M_FLOOR(u - box_u); x <= M_CEIL(u + box_u); x += 1.0f) {
			float q = (e * (y - v) + b * (x - u)) * (y - v) + a * (x - u) * (x - u), weight;
			int column = texture_place(unit->wrap_s, texture_int(x), (int)width, image->border);

			if (!(q < 1024.0f))
				continue;
			weight = gauss_weight[(uint32_t)M_MAX(q, 0.0f)];
			sum = v4_add(sum, v4_scale(texture_texel(t, image, unit, level, column, row, 0), weight));
			sum_weight += weight;
		}
	}
	return sum_weight > 0.0f ? v4_scale(sum, 1.0f / sum_weight) : texture_level(t, image, unit, level, 1, c, 0);
}

/* EXT_texture_swizzle. */
static inline struct vec4 texture_swizzle(uint32_t swizzle, struct vec4 c)
{
	float from[6], to[4];

	if (!swizzle)
		return c;
	from[0] = c.x;
	from[1] = c.y;
	from[2] = c.z;
	from[3] = c.w;
	from[4] = 0.0f;
	from[5] = 1.0f;
	for (uint32_t i = 0u; i < 4u; i++) {
		uint32_t which = swizzle >> 3u * i & 7u;

		to[i] = from[which < 6u ? which : 4u];
	}
	return v4(to[0], to[1], to[2], to[3]);
}

static inline struct vec4 texture_filtered(const struct tables *t, GLOBAL const struct scene_unit *unit, struct vec4 c,
                                         const struct texture_slope *slope)
{
	GLOBAL const struct texture_image *image = &t->textures[unit->texture];
	int anisotropic = slope && texture_is_anisotropic(t, unit);
	float lod = slope ? texture_lod(unit, slope, anisotropic) : 0.0f;
	uint32_t filter = lod > 0.0f ? unit->min_filter : unit->mag_filter;
	int linear = filter == GL_LINEAR || filter == GL_LINEAR_MIPMAP_NEAREST || filter == GL_LINEAR_MIPMAP_LINEAR;
	float last = (float)(image->n_levels - 1u), level = 0.0f;
	int face = 0;

	if (image->target == GL_TEXTURE_CUBE_MAP && texture_has_own_slopes(t, unit) && c.x == 0.0f && c.y == 0.0f &&
	    c.z == 0.0f) {
		/*
		 * llvmpipe converts 0 / 0 to the least integer as a texel number; minus the half texel of a linear filter, it
		 * becomes the largest.
		 */
		face = texture_cube_face(c);
		c = linear ? v4(1.0f, 1.0f, 0.0f, 1.0f) : v4(0.0f, 0.0f, 0.0f, 1.0f);
	} else if (image->target == GL_TEXTURE_CUBE_MAP) {
		c = texture_cube(c, &face);
	} else {
		c = v4_scale(c, 1.0f / c.w);
		if (image->target == GL_TEXTURE_2D_ARRAY)
			face = texture_int(M_MIN(M_MAX(M_RINT(c.z), 0.0f), (float)(image->depth - 1u)));
	}
	if (anisotropic && unit->min_filter != GL_NEAREST) {
		int nearest = unit->min_filter == GL_NEAREST_MIPMAP_NEAREST || unit->min_filter == GL_LINEAR_MIPMAP_NEAREST;

		if (unit->min_filter != GL_LINEAR)
			level = M_MIN(M_MAX(M_FLOOR(nearest ? lod + 0.5f : lod), 0.0f), last);
		return texture_ellipse(t, image, unit, (uint32_t)level, slope, c);
	}
	if (filter == GL_NEAREST_MIPMAP_NEAREST || filter == GL_LINEAR_MIPMAP_NEAREST) {
		level = M_MIN(M_MAX(M_FLOOR(lod + 0.5f), 0.0f), last);
	} else if (filter == GL_NEAREST_MIPMAP_LINEAR || filter == GL_LINEAR_MIPMAP_LINEAR) {
		float fine = M_MIN(M_MAX(M_FLOOR(lod), 0.0f), last), part = M_MIN(lod, last) - fine;

		if (part > 0.0f && fine < last && linear && texture_is_plain(image, unit))
			return texture_unpack(texture_mix_8(texture_level_8(t, image, unit, (uint32_t)fine, c, face),
			                                    texture_level_8(t, image, unit, (uint32_t)fine + 1u, c, face),
			                                    (uint32_t)(part * 256.0f)));
		if (part > 0.0f && fine < last)
			return v4_mix(texture_level(t, image, unit, (uint32_t)fine, linear, c, face),
			              texture_level(t, image, unit, (uint32_t)fine + 1u, linear, c, face), part);
		level = fine;
	}
	return texture_level(t, image, unit, (uint32_t)level, linear, c, face);
}

/* Sample a unit's texture at coordinates s t r q. slope: NULL selects the finest level. */
static inline struct vec4 texture_sample(const struct tables *t, GLOBAL const struct scene_unit *unit, struct vec4 c,
                                         const struct texture_slope *slope)
{
	return texture_swizzle(unit->swizzle, texture_filtered(t, unit, c, slope));
}
