/*
 * One work item of each shading kernel. The .cl files and the C twins are thin wrappers around these.
 *
 * Fragments come from the camera kernels sparsely (so many slots a pixel) and are gathered into a dense list, pixel by
 * pixel, each pixel's in draw order; all that follows works on the list.
 */
#ifndef KERNELS_GL_STAGES_H
#define KERNELS_GL_STAGES_H

#include "kernels/camera.h"
#include "kernels/common.h"
#include "kernels/gl_fragment.h"
#include "kernels/gl_pixel.h"

/* Pixel number of a work item in a rectangle. */
static inline uint32_t stage_pixel(struct camera_rectangle r, uint32_t width, uint32_t item)
{
	uint32_t columns = (uint32_t)(r.x1 - r.x0);

	return ((uint32_t)r.y0 + item / columns) * width + (uint32_t)r.x0 + item % columns;
}

/* gather: a pixel's fragments to their place in the list; where the column goes on next time. */
static inline void gather_item(GLOBAL const struct fragment *sparse, GLOBAL const uint32_t *counts, uint32_t slots,
                               GLOBAL const uint32_t *first, GLOBAL struct fragment *list, GLOBAL uint32_t *pixels,
                               GLOBAL uint32_t *after, uint32_t pixel)
{
	uint32_t n = counts[pixel];

	for (uint32_t i = 0u; i < n; i++) {
		list[first[pixel] + i] = sparse[pixel * slots + i];
		pixels[first[pixel] + i] = pixel;
	}
	after[pixel] = n == slots ? sparse[pixel * slots + n - 1u].order + 1u : SCENE_NONE;
}

/* Depth with polygon offset (sec. 3.5.5): slope in window units per pixel, r the least step of the depth buffer. */
static inline float stage_offset_depth(const struct point *p, GLOBAL const struct window_vertex *windows, float depth,
                                       uint32_t bits)
{
	GLOBAL const struct scene_material *m = p->material;
	GLOBAL const struct window_vertex *w = windows + p->geometry->vertex_first;
	GLOBAL const struct window_vertex *a = w + p->number[0], *b = w + p->number[1], *c = w + p->number[2];
	uint32_t depth_bits = pixel_depth_bits(bits) ? pixel_depth_bits(bits) : 24u;
	float slope = 0.0f;

	if (!(m->polygon_offset & 4u) || p->geometry->flags & GEOMETRY_EXPANDED)
		return depth;
	if (a->w_inv > 0.0f && b->w_inv > 0.0f && c->w_inv > 0.0f) {
		float x1 = (float)(b->x - a->x) / 256.0f, y1 = (float)(b->y - a->y) / 256.0f, z1 = b->z - a->z;
		float x2 = (float)(c->x - a->x) / 256.0f, y2 = (float)(c->y - a->y) / 256.0f, z2 = c->z - a->z;
		float area = x1 * y2 - x2 * y1;

		if (area != 0.0f)
			slope = M_MAX(M_ABS((z1 * y2 - z2 * y1) / area), M_ABS((z2 * x1 - z1 * x2) / area));
	}
	depth += slope * m->polygon_offset_factor +
	         m->polygon_offset_units / (float)pixel_bits_mask(depth_bits > 24u ? 24u : depth_bits);
	return clamp01(depth);
}

/* Bit k set: the k-th light of the material's list is stopped on its way to the item. */
static inline uint32_t stage_dark(GLOBAL const uint32_t *stopped, uint32_t n_slots, uint32_t n, uint32_t item)
{
	uint32_t dark = 0u;

	for (uint32_t slot = 0u; slot < n_slots; slot++)
		dark |= stopped[slot * n + item] ? 1u << slot : 0u;
	return dark;
}

/* Lights of the list that a ray must be sent to. Expanded lines and points take no shadows. */
static inline uint32_t stage_wanted(const struct point *p, uint32_t lights)
{
	return p->geometry->flags & GEOMETRY_EXPANDED ? 0u : (lights & 255u) * SHADED_WANTS(0);
}

static inline int stage_stippled_away(const struct tables *t, const struct point *p, uint32_t x, uint32_t y)
{
	uint32_t stipple = p->material->polygon_stipple;

	if (stipple == SCENE_NONE || p->geometry->flags & GEOMETRY_EXPANDED)
		return 0;
	return !(t->stipples[stipple * 32u + (y & 31u)] >> (31u - (x & 31u)) & 1u);
}

/*
 * Weights of a fragment for its attributes. Coverage and depth go by snapped vertices; llvmpipe takes attributes from
 * the unsnapped ones (nearest filtering shows the difference), so they are found again from clip coordinates.
 */
static inline void stage_unsnap(const struct tables *t, GLOBAL const struct view *views, uint32_t x, uint32_t y,
                                struct fragment *f)
{
	struct point p;
	GLOBAL const struct view *view;
	float px[3], py[3], area;

	if (f->primitive & FRAGMENT_PERSPECTIVE)
		return;
	point_vertices(t, &p, f->instance, f->primitive);
	view = &views[p.geometry->view];
	for (int i = 0; i < 3; i++) {
		GLOBAL const float *c = p.vertex[i]->clip;
		float w_inv = 1.0f / c[3], half_w = view->viewport[2] * 0.5f, half_h = view->viewport[3] * 0.5f;

		px[i] = half_w * (c[0] * w_inv) + (view->viewport[0] + half_w - ((float)x + 0.5f));
		py[i] = half_h * (c[1] * w_inv) + (view->viewport[1] + half_h - ((float)y + 0.5f));
	}
	area = (px[1] - px[0]) * (py[2] - py[0]) - (px[2] - px[0]) * (py[1] - py[0]);
	if (!(M_ABS(area) > 1.0e-3f))
		return; /* a sliver: its snapped form is what was covered */
	f->b1 = (px[2] * py[0] - px[0] * py[2]) / area;
	f->b2 = (px[0] * py[1] - px[1] * py[0]) / area;
}

/*
 * shade, lit anew or not: n_slots == 0 gives a fragment its GL colour, depth and the lights it must ask for;
 * n_slots > 0 gives fragments that asked their colour without the lights that were stopped.
 */
static inline void shade_item(const struct tables *t, GLOBAL const struct view *views,
                              GLOBAL const struct window_vertex *windows, GLOBAL struct fragment *fragments,
                              GLOBAL const uint32_t *pixels, uint32_t width, uint32_t height, uint32_t bits,
                              GLOBAL const uint32_t *stopped, uint32_t n_slots, uint32_t n,
                              GLOBAL struct shaded *shaded, uint32_t item)
{
	struct fragment f = fragments[item];
	GLOBAL struct shaded *out = &shaded[item];
	uint32_t x = pixels[item] % width, y = pixels[item] / width, dark = 0u;
	struct point p;
	struct coat coat;
	struct lit lit;
	struct vec4 color;

	if (n_slots) {
		dark = stage_dark(stopped, n_slots, n, item);
		if (!dark || !(out->flags & SHADED_THERE))
			return;
	} else {
		stage_unsnap(t, views, x, y, &f);
		fragments[item] = f;
	}
	p = point_from_fragment(t, windows, &f);
	if (!n_slots && (point_clipped(&p) || stage_stippled_away(t, &p, x, y))) {
		out->flags = 0u;
		return;
	}
	point_coat(t, &p, &views[p.geometry->view], x, y, height, &coat);
	lit = dark ? point_lit_again(t, &p, dark) : point_lit_from_vertices(&p);
	color = point_finish(t, &p, &coat, &lit);
	v3_store(out->direct, v3(color.x, color.y, color.z));
	v3_store(out->beauty, v3(color.x, color.y, color.z));
	if (n_slots)
		return;
	v4_store(out->gl, color);
	color = point_albedo(t, &p, &coat);
	v3_store(out->albedo, v3(color.x, color.y, color.z));
	out->depth = stage_offset_depth(&p, windows, f.depth, bits);
	out->flags = SHADED_THERE | (p.front ? SHADED_FRONT : 0u) | stage_wanted(&p, lit.lights);
}

static inline void stage_no_ray(GLOBAL struct ray *ray)
{
	v3_store(ray->o, v3(0.0f, 0.0f, 0.0f));
	v3_store(ray->d, v3(0.0f, 0.0f, 1.0f));
	ray->t_min = 1.0f;
	ray->t_max = 0.0f;
}

/* The direction in which a view looks through a pixel: from its near to its far point. */
static inline struct vec3 stage_view_direction(GLOBAL const struct view *view, uint32_t x, uint32_t y)
{
	float nx = 2.0f * ((float)x + 0.5f - view->viewport[0]) / view->viewport[2] - 1.0f;
	float ny = 2.0f * ((float)y + 0.5f - view->viewport[1]) / view->viewport[3] - 1.0f;
	struct vec4 near = m4_mul(view->inverse, v4(nx, ny, -1.0f, 1.0f));
	struct vec4 far = m4_mul(view->inverse, v4(nx, ny, 1.0f, 1.0f));

	return v3(far.x * near.w - near.x * far.w, far.y * near.w - near.y * far.w, far.z * near.w - near.z * far.w);
}

/*
 * The ray from a point to a light: as far as the light, d not normalised, so that t = 1 is the light itself. `from`: the
 * direction of the ray that led to the point.
 */
static inline void stage_light_ray(const struct tables *t, const struct point *p, uint32_t slot, struct vec3 from,
                                   GLOBAL struct ray *ray)
{
	GLOBAL const struct scene_light *light = &t->lights[p->material->light_first + slot];
	struct vec3 to = v3_load(light->position_eye), place, o;
	int positional = light->position_eye[3] != 0.0f;

	place = positional ? v3_scale(to, 1.0f / light->position_eye[3]) : to;
	o = point_ray_origin(p, positional ? v3_sub(place, point_position(p)) : to, from);
	if (positional)
		to = v3_sub(place, o);
	v3_store(ray->o, o);
	v3_store(ray->d, to);
	ray->t_min = 0.0f;
	ray->t_max = positional ? 1.0f : 1.0e30f;
}

/* shadow_ray: rays[slot * n + i] goes from fragment i to the light in a slot; an empty ray where none is wanted. */
static inline void shadow_ray_item(const struct tables *t, GLOBAL const struct view *views,
                                   GLOBAL const struct window_vertex *windows,
                                   GLOBAL const struct fragment *fragments, GLOBAL const uint32_t *pixels,
                                   uint32_t width, GLOBAL const struct shaded *shaded, uint32_t n,
                                   GLOBAL struct ray *rays, uint32_t item)
{
	uint32_t slot = item / n, i = item % n;
	struct fragment f = fragments[i];
	struct point p;

	if (!(shaded[i].flags & SHADED_THERE) || !(shaded[i].flags & SHADED_WANTS(slot))) {
		stage_no_ray(&rays[item]);
		return;
	}
	p = point_from_fragment(t, windows, &f);
	stage_light_ray(t, &p, slot,
	                stage_view_direction(&views[p.geometry->view], pixels[i] % width, pixels[i] / width), &rays[item]);
}

/* --- Mirrors ----------------------------------------------------------------------------------------------------- */

static inline void stage_mirror_ray(const struct point *p, struct vec3 direction, GLOBAL struct ray *ray)
{
	struct vec3 n = point_normal(p), d = v3_normalize(direction), plane;

	d = v3_sub(d, v3_scale(n, 2.0f * v3_dot(d, n)));
	/* A smooth normal may send the ray into the surface: let it graze instead. */
	plane = point_plane_normal(p);
	plane = v3_dot(plane, direction) > 0.0f ? v3_scale(plane, -1.0f) : plane;
	if (v3_dot(d, plane) < 0.0f)
		d = v3_normalize(v3_sub(d, v3_scale(plane, 1.001f * v3_dot(d, plane))));
	v3_store(ray->o, point_ray_origin(p, d, direction));
	v3_store(ray->d, d);
	ray->t_min = 0.0f;
	ray->t_max = 1.0e30f;
}

/* mirror_ray: the first reflected ray of a fragment, and what share of the beauty it carries (0: none). */
static inline void mirror_ray_item(const struct tables *t, GLOBAL const struct view *views,
                                   GLOBAL const struct window_vertex *windows,
                                   GLOBAL const struct fragment *fragments, GLOBAL const uint32_t *pixels,
                                   uint32_t width, GLOBAL struct shaded *shaded, GLOBAL struct ray *rays,
                                   GLOBAL float *shares, uint32_t item)
{
	struct fragment f = fragments[item];
	GLOBAL struct shaded *s = &shaded[item];
	struct point p;
	float share;

	stage_no_ray(&rays[item]);
	shares[item] = 0.0f;
	if (!(s->flags & SHADED_THERE))
		return;
	p = point_from_fragment(t, windows, &f);
	share = clamp01(p.material->surface.reflect);
	if (!(share > 0.0f) || p.geometry->flags & GEOMETRY_EXPANDED)
		return;
	stage_mirror_ray(&p, stage_view_direction(&views[p.geometry->view], pixels[item] % width, pixels[item] / width),
	                 &rays[item]);
	shares[item] = share;
	v3_store(s->beauty, v3_scale(v3_load(s->beauty), 1.0f - share));
}

/*
 * shade_hit with n_slots == 0: what lights the hit must ask for (lights[item]). With `finish`: its colour without the
 * stopped lights goes into the fragment's beauty by its share, and the next ray and share take their place.
 * background: what a ray sees that hits nothing.
 */
static inline void shade_hit_item(const struct tables *t, GLOBAL const struct hit *hits, uint32_t finish, uint32_t last,
                                  GLOBAL const uint32_t *stopped, uint32_t n_slots, uint32_t n,
                                  GLOBAL const float *background, GLOBAL uint32_t *wanted, GLOBAL struct ray *rays,
                                  GLOBAL float *shares, GLOBAL struct shaded *shaded, uint32_t item)
{
	struct hit hit = hits[item];
	GLOBAL struct shaded *s = &shaded[item];
	float share = shares[item], next;
	struct vec3 direction = v3_load(rays[item].d);
	struct point p;
	struct coat coat;
	struct lit lit;
	struct vec4 color;
	uint32_t dark;

	if (!finish)
		wanted[item] = 0u;
	if (!(share > 0.0f))
		return;
	if (hit.instance == SCENE_NONE) {
		if (finish) {
			v3_store(s->beauty, v3_add(v3_load(s->beauty), v3_scale(v3_load(background), share)));
			shares[item] = 0.0f;
			stage_no_ray(&rays[item]);
		}
		return;
	}
	p = point_from_hit(t, &hit, direction);
	if (!finish) {
		wanted[item] = stage_wanted(&p, point_lit_from_vertices(&p).lights);
		return;
	}
	dark = stage_dark(stopped, n_slots, n, item);
	lit = dark ? point_lit_again(t, &p, dark) : point_lit_from_vertices(&p);
	point_coat(t, &p, (GLOBAL const struct view *)0, 0u, 0u, 0u, &coat);
	color = point_finish(t, &p, &coat, &lit);
	next = last ? 0.0f : clamp01(p.material->surface.reflect);
	v3_store(s->beauty, v3_add(v3_load(s->beauty), v3_scale(v3(color.x, color.y, color.z), share * (1.0f - next))));
	shares[item] = share * next;
	if (next > 0.0f)
		stage_mirror_ray(&p, direction, &rays[item]);
	else
		stage_no_ray(&rays[item]);
}

/* hit_ray: from hits to lights, as shadow_ray does from fragments. `rays`: those that led to the hits. */
static inline void hit_ray_item(const struct tables *t, GLOBAL const struct hit *hits, GLOBAL const struct ray *rays,
                                GLOBAL const uint32_t *wanted, uint32_t n, GLOBAL struct ray *out, uint32_t item)
{
	uint32_t slot = item / n, i = item % n;
	struct hit hit = hits[i];
	struct point p;

	if (!(wanted[i] & SHADED_WANTS(slot))) {
		stage_no_ray(&out[item]);
		return;
	}
	p = point_from_hit(t, &hit, v3_load(rays[i].d));
	stage_light_ray(t, &p, slot, v3_load(rays[i].d), &out[item]);
}

/* --- Pixels ------------------------------------------------------------------------------------------------------ */

/* resolve: a pixel's fragments of the list, in draw order, through the per-fragment operations. */
static inline void resolve_item(const struct tables *t, GLOBAL const struct fragment *fragments,
                                GLOBAL const struct shaded *shaded, GLOBAL const uint32_t *first,
                                GLOBAL const uint32_t *counts, uint32_t bits, GLOBAL struct frame_pixel *frame,
                                uint32_t pixel)
{
	for (uint32_t i = first[pixel]; i < first[pixel] + counts[pixel]; i++) {
		GLOBAL const struct geometry *g = &t->geometries[fragments[i].instance];
		uint32_t draw = g->draw;

		if (g->primitive_draw != SCENE_NONE)
			draw += t->indices[g->primitive_draw + FRAGMENT_PRIMITIVE(fragments[i])];
		pixel_draw(&t->materials[g->material], &shaded[i], &fragments[i], draw, &frame[pixel], bits);
	}
}

/* surface: where the visible surface of a pixel lies, for the channels that tell. All 0 where there is none. */
static inline void surface_item(const struct tables *t, GLOBAL const struct window_vertex *windows,
                                GLOBAL const struct frame_pixel *frame, GLOBAL float *planes, uint32_t pixel)
{
	struct fragment f = frame[pixel].surface;
	GLOBAL float *out = planes + pixel * SURFACE_PLANES;
	struct point p;
	struct vec3 at;

	for (uint32_t i = 0u; i < SURFACE_PLANES; i++)
		out[i] = 0.0f;
	if (f.order == SCENE_NONE)
		return;
	p = point_from_fragment(t, windows, &f);
	at = point_position(&p);
	v3_store(out, point_normal(&p));
	v3_store(out + 3, at);
	out[6] = -at.z;
}

#endif
