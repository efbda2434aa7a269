/*
 * GL's fragment stage (GL 2.1 sec. 3.8 - 3.10) on a point of a triangle: texturing, colour sum, fog.
 */
#pragma once

#include "kernels/gl/combine.h"
#include "kernels/gl/point.h"
#include "kernels/gl/texture.h"

/* Texturing of a point, and its fog: the parts of its colour that do not depend on lighting. */
struct texturing {
	struct vec4 sample[SCENE_MAX_UNITS]; /* indexed by GL's unit number */
	float fog_factor;
};

/*
 * Base format that selects the environment's equations; depth textures count as the format they are sampled as (sec.
 * 3.8.14).
 */
static inline uint32_t point_unit_format(const struct tables *t, GLOBAL const struct scene_unit *unit)
{
	uint32_t format = t->textures[unit->texture].base_format;

	return format == GL_DEPTH_COMPONENT ? unit->depth_mode : format;
}

#include "kernels/gl/finish_lanes.h"

static inline struct vec4 point_texcoord(const struct tables *t, const struct point *p, uint32_t i,
                                         const float *weight)
{
	uint32_t count = p->material->unit_count, first = p->geometry->texcoord_first;
	struct vec4 c = v4(0.0f, 0.0f, 0.0f, 0.0f);

	for (int k = 0; k < 3; k++)
		c = v4_add(c, v4_scale(v4_load(t->texcoords + (first + p->number[k] * count + i) * 4u), weight[k]));
	return c;
}

/* Texture coordinates of a fragment's triangle, or any four numbers of its vertices, divided by w: linear in the
 * window. */
struct point_planes {
	struct clip_plane s, t, r, q, w_inv;
};

/*
 * As in llvmpipe, to the last bit: nearest filtering makes these bits visible if a texel border runs along pixel
 * centres. pool: starts with the vertices' numbers; receives those of corners made by clipping
 */
static inline void point_planes_between(struct vec4 *pool, const struct clip_setup *setup, struct point_planes *planes)
{
	float over_w[4][3];

	for (uint32_t k = 0u; k < setup->cuts.n; k++)
		pool[3u + k] = v4_mix(pool[setup->cuts.from[k]], pool[setup->cuts.to[k]], setup->cuts.t[k]);
	for (int k = 0; k < 3; k++) {
		struct vec4 c = v4_scale(setup->cuts.n ? pool[setup->corner[k].number] : pool[k], setup->corner[k].window.w_inv);

		over_w[0][k] = c.x;
		over_w[1][k] = c.y;
		over_w[2][k] = c.z;
		over_w[3][k] = c.w;
	}
	planes->s = clip_plane_through(&setup->edges, over_w[0]);
	planes->t = clip_plane_through(&setup->edges, over_w[1]);
	planes->r = clip_plane_through(&setup->edges, over_w[2]);
	planes->q = clip_plane_through(&setup->edges, over_w[3]);
	planes->w_inv = setup->w_inv;
}

static inline void point_texcoord_planes(const struct tables *t, const struct point *p, uint32_t i,
                                         const struct clip_setup *setup, struct point_planes *planes)
{
	uint32_t count = p->material->unit_count, first = p->geometry->texcoord_first;
	struct vec4 pool[3 + CLIP_MAX_CUTS];

	for (uint32_t k = 0u; k < 3u; k++)
		pool[k] = v4_load(t->texcoords + (first + p->number[k] * count + i) * 4u);
	point_planes_between(pool, setup, planes);
}

/* The numbers at a pixel. x, y: from clip_origin, y from the top */
static inline struct vec4 point_planes_at(const struct point_planes *planes, float x, float y)
{
	float w = 1.0f / clip_plane_at(&planes->w_inv, x, y);

	return v4(clip_plane_at(&planes->s, x, y) * w, clip_plane_at(&planes->t, x, y) * w,
	          clip_plane_at(&planes->r, x, y) * w, clip_plane_at(&planes->q, x, y) * w);
}

/* One of the colours of a triangle's corners at a pixel. pool: the corners'. x, y: as for point_planes_at */
static inline struct vec4 point_color_by_planes(struct vec4 *pool, const struct clip_setup *setup, float x, float y)
{
	struct point_planes planes;

	point_planes_between(pool, setup, &planes);
	return point_planes_at(&planes, x, y);
}

/*
 * Colours between lit vertices to llvmpipe's last bit, which shows where a colour lies half way between two codes.
 * again: the corners as point_light_corners lit them; 0: as they were lit first
 */
static inline struct lit point_lit_by_planes(const struct point *p, const struct lit *again,
                                             const struct clip_setup *setup, float x, float y)
{
	GLOBAL const struct scene_material *m = p->material;
	const uint32_t interpolated = point_interpolated(m, p->geometry->attributes);
	struct lit lit = again ? point_lit_between(p, again) : point_lit_from_vertices(p);
	struct vec4 pool[3 + CLIP_MAX_CUTS];
	const int side = point_side(p);

	for (uint32_t k = 0u; k < 3u && interpolated & SCENE_HAS_COLOR; k++)
		pool[k] = again ? again[k].color : v4_load(p->vertex[k]->color[side]);
	if (interpolated & SCENE_HAS_COLOR)
		lit.color = point_color_by_planes(pool, setup, x, y);
	if (!(interpolated & SCENE_HAS_SECONDARY) || !(m->color_sum || (m->lighting && m->separate_specular)))
		return lit;
	for (uint32_t k = 0u; k < 3u; k++)
		pool[k] = again ? again[k].secondary : v4_load(p->vertex[k]->secondary[side]);
	lit.secondary = point_color_by_planes(pool, setup, x, y);
	return lit;
}

/*
 * Results of sampling the first unit's texture in a triangle, cached for its next fragment. Fragment lists follow rows
 * of eight pixels: four quads, which the next row shares.
 */
#define POINT_KEPT_QUADS 4u
struct point_kept {
	int have_planes;
	struct point_planes planes;
	uint32_t quad[POINT_KEPT_QUADS]; /* their positions, row << 16 | column; SCENE_NONE: empty */
	struct texture_slope slope[POINT_KEPT_QUADS];
};

static inline void point_keep_nothing(struct point_kept *kept)
{
	kept->have_planes = 0;
	for (uint32_t i = 0u; i < POINT_KEPT_QUADS; i++)
		kept->quad[i] = SCENE_NONE;
}

/* A line, given by its ends, which its corners carry (tracer/frame/prepare/expand_line.c): x, y from the top, depth, 1
 * at the second end. */
struct point_line {
	struct vec4 a, b;
	int second[3]; /* 1 for corners at the second end */
	float dx, dy, one_over_area;
};

/*
 * Attributes change only along the line's longer axis, in llvmpipe's order of operations, and continue beyond its ends.
 * Under multisampling, the line's actual direction is used; llvmpipe then shifts the ends by half a pixel, but not the
 * sample positions.
 */
static inline void point_line_of(const struct point *p, GLOBAL const struct view *view, struct point_line *l)
{
	float dx, dy;

	l->a = l->b = v4_load(p->vertex[0]->color[1]);
	for (int i = 0; i < 3; i++) {
		const struct vec4 c = v4_load(p->vertex[i]->color[1]);

		l->second[i] = c.w > 0.5f;
		if (l->second[i])
			l->b = c;
		else
			l->a = c;
	}
	dx = l->a.x - l->b.x;
	dy = l->a.y - l->b.y;
	l->one_over_area = 1.0f / (dx * dx + dy * dy);
	if (view->sample[0] | view->sample[1]) {
		/* unchanged */
	} else if (M_ABS(dx) >= M_ABS(dy)) {
		dx *= 1.0f + (dy / dx) * (dy / dx);
		dy = 0.0f;
	} else {
		dy *= 1.0f + (dx / dy) * (dx / dy);
		dx = 0.0f;
	}
	l->dx = dx;
	l->dy = dy;
}

/* Weights at any window position. The second end's share goes to one of its corners. x, y: from clip_origin, y from the
 * top */
static inline void point_line_weights(const struct point_line *l, float x, float y, struct fragment *f)
{
	float share = -(l->dx * l->one_over_area * (x - (l->a.x - 0.5f)) + l->dy * l->one_over_area * (y - (l->a.y - 0.5f)));

	f->b1 = f->b2 = 0.0f;
	if (l->second[0])
		share = 1.0f - share;
	if (l->second[1] == l->second[0])
		f->b2 = share;
	else
		f->b1 = share;
}

/*
 * Object-space weights at the centre of any pixel: of the triangle's plane (by clip-space edge functions, so nothing
 * needs clipping), or of a line. x, y: the pixel, y from the top
 */
static inline void point_weights_at(const struct point *p, GLOBAL const struct view *view, float x, float y,
                                    uint32_t height, float *weight)
{
	struct vec3 at = v3(2.0f * (x + 0.5f - view->viewport[0]) / view->viewport[2] - 1.0f,
	                    2.0f * ((float)height - (y + 0.5f) - view->viewport[1]) / view->viewport[3] - 1.0f, 1.0f);
	struct vec3 a = point_clip_xyw(p, 0), b = point_clip_xyw(p, 1), c = point_clip_xyw(p, 2);
	float sum;

	if (p->geometry->flags & GEOMETRY_LINE) {
		const float middle = 0.5f - clip_origin(view);
		struct fragment f;
		struct point_line l;

		f.primitive = 0u;
		point_line_of(p, view, &l);
		point_line_weights(&l, x + middle, y + middle, &f);
		fragment_weights(f, 1.0f / a.z, 1.0f / b.z, 1.0f / c.z, weight);
		return;
	}
	weight[0] = v3_dot(v3_cross(b, c), at);
	weight[1] = v3_dot(v3_cross(c, a), at);
	weight[2] = v3_dot(v3_cross(a, b), at);
	sum = weight[0] + weight[1] + weight[2];
	sum = sum != 0.0f ? 1.0f / sum : 0.0f;
	for (int i = 0; i < 3; i++)
		weight[i] *= sum;
}

/* Fog (sec. 3.10). */
static inline float point_fog(const struct point *p)
{
	GLOBAL const struct scene_material *m = p->material;
	float c = p->vertex[0]->fog_coord * p->weight[0] + p->vertex[1]->fog_coord * p->weight[1] +
	          p->vertex[2]->fog_coord * p->weight[2];

	if (m->fog_mode == GL_LINEAR)
		return fog_linear(m, c);
	if (m->fog_mode == GL_EXP2)
		return clamp01(M_EXP(-(m->fog_density * c) * (m->fog_density * c)));
	return clamp01(M_EXP(-m->fog_density * c));
}

/* A fragment's position in its window, and data of its triangle. */
struct point_window {
	GLOBAL const struct view *view;
	const struct clip_setup *setup; /* NULL: it belongs to no triangle */
	struct point_kept *kept;        /* NULL, or the cache that earlier fragments of the same triangle filled */
	uint32_t x, row, height;        /* its pixel, row 0 at the bottom; height of the window */
};

/* The pixel quad that llvmpipe takes slopes from: it starts at an even column and an even row counted from the top. */
struct point_quad {
	float x, y, middle;  /* middle: distance from there to the origin of planes */
	int have_weights;
	float weight[3][3];  /* for points without a triangle's setup */
};

/* Texture coordinates of unit i. planes: receives their planes, if there is a setup */
static inline struct vec4 point_unit_coord(const struct tables *t, const struct point *p, uint32_t i,
                                           const struct point_window *w, const struct point_quad *quad,
                                           struct point_planes *planes)
{
	const int keeps = w && w->kept && i == 0u;

	if (!w || !w->setup)
		return point_texcoord(t, p, i, p->weight);
	if (keeps && w->kept->have_planes) {
		*planes = w->kept->planes;
	} else {
		point_texcoord_planes(t, p, i, w->setup, planes);
		if (keeps) {
			w->kept->planes = *planes;
			w->kept->have_planes = 1;
		}
	}
	return point_planes_at(planes, (float)w->x + quad->middle, (float)(w->height - 1u - w->row) + quad->middle);
}

/* Slopes of these coordinates. planes: as above */
static inline struct texture_slope point_unit_slope(const struct tables *t, const struct point *p, uint32_t i,
                                                    const struct point_window *w, struct point_quad *quad,
                                                    const struct point_planes *planes)
{
	GLOBAL const struct scene_unit *unit = &t->units[p->material->unit_first + i];
	GLOBAL const struct texture_image *image = &t->textures[unit->texture];
	const uint32_t number = (uint32_t)quad->y << 16 | (uint32_t)quad->x, slot = w->x / 2u % POINT_KEPT_QUADS;
	const int own = texture_has_own_slopes(t, unit), keeps = w->kept && i == 0u && w->setup && !own;
	const float x = own ? (float)w->x : quad->x, right = x + (own && w->x & 1u ? -1.0f : 1.0f);
	const float y = own ? (float)(w->height - 1u - w->row) : quad->y,
		    below = y + (own && (w->height - 1u - w->row) & 1u ? -1.0f : 1.0f);
	struct texture_slope slope;

	if (keeps && w->kept->quad[slot] == number)
		return w->kept->slope[slot];
	if (w->setup) {
		slope = texture_slope(image, point_planes_at(planes, x + quad->middle, y + quad->middle),
		                      point_planes_at(planes, right + quad->middle, y + quad->middle),
		                      point_planes_at(planes, x + quad->middle, below + quad->middle));
		if (keeps) {
			w->kept->quad[slot] = number;
			w->kept->slope[slot] = slope;
		}
		return slope;
	}
	if (own || !quad->have_weights) {
		point_weights_at(p, w->view, x, y, w->height, quad->weight[0]);
		point_weights_at(p, w->view, right, y, w->height, quad->weight[1]);
		point_weights_at(p, w->view, x, below, w->height, quad->weight[2]);
		quad->have_weights = !own;
	}
	return texture_slope(image, point_texcoord(t, p, i, quad->weight[0]), point_texcoord(t, p, i, quad->weight[1]),
	                     point_texcoord(t, p, i, quad->weight[2]));
}

/* Sample a point's textures. w: NULL for secondary hits, which have no neighbouring pixels and use the finest level. */
static inline void point_texture(const struct tables *t, const struct point *p, const struct point_window *w,
                                 struct texturing *texturing)
{
	GLOBAL const struct scene_material *m = p->material;
	struct point_quad quad;

	quad.have_weights = 0;
	if (w) {
		quad.x = (float)(w->x & ~1u);
		quad.y = (float)((w->height - 1u - w->row) & ~1u);
		quad.middle = w->setup ? 0.5f - clip_origin(w->view) : 0.0f;
	}
	for (uint32_t i = 0u; i < m->unit_count; i++) {
		GLOBAL const struct scene_unit *unit = &t->units[m->unit_first + i];
		const int have_slope = w && texture_needs_slope(t, unit);
		struct point_planes planes;
		struct texture_slope slope;
		struct vec4 c = point_unit_coord(t, p, i, w, &quad, &planes);

		if (have_slope)
			slope = point_unit_slope(t, p, i, w, &quad, &planes);
		texturing->sample[unit->unit] = texture_sample(t, unit, c, have_slope ? &slope : (const struct texture_slope *)0);
	}
	texturing->fog_factor = m->fog ? point_fog(p) : 1.0f;
}

static inline struct vec4 point_finish(const struct tables *t, const struct point *p, const struct texturing *texturing,
                                       const struct lit *lit)
{
	return finish_in_fog(t, p->material, texturing->sample, lit, texturing->fog_factor, 0u);
}

/* The same, without light that is baked into a texture. */
static inline struct vec4 point_finish_relit(const struct tables *t, const struct point *p,
                                             const struct texturing *texturing, const struct lit *lit)
{
	return finish_in_fog(t, p->material, texturing->sample, lit, texturing->fog_factor,
	                     p->material->surface.light_unit);
}

/* The surface's own colour under white light, as shown by the albedo channel. lit: point_lit_from_vertices */
static inline struct vec4 point_albedo_of(const struct tables *t, const struct point *p,
                                          const struct texturing *texturing, struct lit lit)
{
	GLOBAL const struct scene_material *m = p->material;
	int side = point_side(p);
	uint32_t mode = m->color_material_mode;
	uint32_t tracks = m->color_material && (mode == GL_DIFFUSE || mode == GL_AMBIENT_AND_DIFFUSE);

	if (m->lighting && !(p->geometry->flags & GEOMETRY_EXPANDED))
		lit.color = tracks ? v4_clamp01(point_mix(p, tables_color(t, p->geometry, p->number[0]),
		                                          tables_color(t, p->geometry, p->number[1]),
		                                          tables_color(t, p->geometry, p->number[2]))) :
		                     v4_clamp01(point_mix(p, v4_load(tables_face(t, p->geometry, p->number[0], side)->diffuse),
		                                          v4_load(tables_face(t, p->geometry, p->number[1], side)->diffuse),
		                                          v4_load(tables_face(t, p->geometry, p->number[2], side)->diffuse)));
	else if (m->surface.light_unit == SCENE_LIGHT_IN_COLORS)
		lit.color = point_matte_color(t, p);
	lit.secondary = v4(0.0f, 0.0f, 0.0f, 0.0f);
	return finish_in_fog(t, m, texturing->sample, &lit, 1.0f, m->surface.light_unit);
}

static inline struct vec4 point_albedo(const struct tables *t, const struct point *p, const struct texturing *texturing)
{
	return point_albedo_of(t, p, texturing, point_lit_from_vertices(p));
}
