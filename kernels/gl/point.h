/*
 * A point of a triangle: its position and lighting. It may be a fragment under a pixel centre or the hit of a secondary
 * ray; both use the same text.
 */
#pragma once

#include "gl_tokens.h"
#include "kernels/common.h"
#include "kernels/gl/clip.h"
#include "kernels/gl/tables.h"
#include "kernels/gl/vertex.h"

/* A point of a triangle. */
struct point {
	GLOBAL const struct geometry *geometry;
	GLOBAL const struct scene_material *material;
	GLOBAL const struct shaded_vertex *vertex[3];
	uint32_t number[3]; /* the vertices' numbers in the mesh */
	uint32_t primitive; /* the triangle's number in the mesh */
	float weight[3];    /* the vertices' weights, homogeneous: perspective-correct */
	int front;
};

static inline void point_vertices(const struct tables *t, struct point *p, uint32_t instance, uint32_t primitive)
{
	p->geometry = &t->geometries[instance];
	p->material = &t->materials[p->geometry->material];
	p->primitive = primitive;
	for (uint32_t i = 0u; i < 3u; i++) {
		p->number[i] = t->indices[p->geometry->index + primitive * 3u + i];
		p->vertex[i] = &t->vertices[p->geometry->vertex_first + p->number[i]];
	}
}

/* 1 if all corners have w = 1. */
static inline int point_is_affine(const struct point *p)
{
	return p->vertex[0]->eye[3] == 1.0f && p->vertex[1]->eye[3] == 1.0f && p->vertex[2]->eye[3] == 1.0f;
}

/*
 * Corners with other values of w may be at infinity, or be seen from behind it. They are replaced by the corners of a
 * triangle around the point P that lies in the same plane, shows the same side and has the same weights there. A corner
 * E is at P + (E - w P) / W; W is the point's w.
 */
static inline struct vec3 point_corner_about(const struct point *p, int i)
{
	const struct vec4 of_point = v4_add(v4_add(v4_scale(v4_load(p->vertex[0]->eye), p->weight[0]),
	                                           v4_scale(v4_load(p->vertex[1]->eye), p->weight[1])),
	                                    v4_scale(v4_load(p->vertex[2]->eye), p->weight[2]));
	const float w_inv = 1.0f / of_point.w;
	const struct vec3 at = v3_scale(v3(of_point.x, of_point.y, of_point.z), w_inv);

	return v3_scale(v3_add(v3_load(p->vertex[i]->eye), v3_scale(at, of_point.w - p->vertex[i]->eye[3])), w_inv);
}

static inline struct vec3 point_corner(const struct point *p, int i)
{
	return point_is_affine(p) ? v3_load(p->vertex[i]->eye) : point_corner_about(p, i);
}

/*
 * The triangle's own normal in eye space, which points towards the viewer for front faces that run counter-clockwise.
 * Its length is 0 if there is none: no area, or NaN in a corner.
 */
static inline struct vec3 point_plane_normal(const struct point *p)
{
	struct vec3 a = point_corner(p, 0);
	struct vec3 n = v3_normalize(v3_cross(v3_sub(point_corner(p, 1), a), v3_sub(point_corner(p, 2), a)));

	return v3_dot(n, n) > 0.0f ? n : v3(0.0f, 0.0f, 0.0f);
}

/* (x, y, w) of a clip-space vertex: lines through the eye, which are unaffected by clipping. */
static inline struct vec3 point_clip_xyw(const struct point *p, int i)
{
	GLOBAL const float *c = p->vertex[i]->clip;

	return v3(c[0], c[1], c[3]);
}

/* 1 if a fragment's triangle shows its front. w: window vertices of its geometry */
static inline int point_shows_front(const struct point *p, GLOBAL const struct window_vertex *w)
{
	int clockwise;

	/* The sign of the area gives the side: in the window or, if a vertex has no window position, in clip space. */
	if (w[p->number[0]].w_inv > 0.0f && w[p->number[1]].w_inv > 0.0f && w[p->number[2]].w_inv > 0.0f) {
		float x0 = (float)w[p->number[0]].x, y0 = (float)w[p->number[0]].y;

		clockwise = ((float)w[p->number[1]].x - x0) * ((float)w[p->number[2]].y - y0) -
		                    ((float)w[p->number[2]].x - x0) * ((float)w[p->number[1]].y - y0) <
		            0.0f;
	} else {
		clockwise = v3_dot(v3_cross(point_clip_xyw(p, 0), point_clip_xyw(p, 1)), point_clip_xyw(p, 2)) < 0.0f;
	}
	return clockwise == (p->material->front_face == GL_CW);
}

/* The point under a fragment without its weights: the data shared by all points of the triangle. w_inv: of the three
 * vertices */
static inline struct point point_of_triangle(const struct tables *t, GLOBAL const struct window_vertex *windows,
                                             const struct fragment *f, float *w_inv)
{
	struct point p;
	GLOBAL const struct window_vertex *w;

	point_vertices(t, &p, f->instance, FRAGMENT_PRIMITIVE(*f));
	w = windows + p.geometry->vertex_first;
	for (int i = 0; i < 3; i++) {
		w_inv[i] = w[p.number[i]].w_inv;
		p.weight[i] = 0.0f;
	}
	p.front = point_shows_front(&p, w);
	return p;
}

/*
 * The point under a fragment. It does not call point_of_triangle, because compilers for CPUs would then keep the whole
 * struct in memory.
 */
static inline struct point point_from_fragment(const struct tables *t, GLOBAL const struct window_vertex *windows,
                                               const struct fragment *f)
{
	struct point p;
	GLOBAL const struct window_vertex *w;

	point_vertices(t, &p, f->instance, FRAGMENT_PRIMITIVE(*f));
	w = windows + p.geometry->vertex_first;
	fragment_weights(*f, w[p.number[0]].w_inv, w[p.number[1]].w_inv, w[p.number[2]].w_inv, p.weight);
	p.front = point_shows_front(&p, w);
	return p;
}

/* Convert weights of corners divided by w to weights of vertices. */
static inline void point_divide_weights(struct point *p)
{
	float sum = 0.0f;

	for (int i = 0; i < 3; i++) {
		p->weight[i] /= p->vertex[i]->eye[3];
		sum += p->weight[i];
	}
	for (int i = 0; i < 3; i++)
		p->weight[i] /= sum;
}

/* The point that a ray hit; its front side is the one that GL would see from the ray's origin. */
static inline struct point point_from_hit(const struct tables *t, const struct hit *hit, struct vec3 direction)
{
	struct point p;

	point_vertices(t, &p, hit->instance, hit->primitive);
	p.weight[0] = 1.0f - hit->b1 - hit->b2;
	p.weight[1] = hit->b1;
	p.weight[2] = hit->b2;
	if (!point_is_affine(&p))
		point_divide_weights(&p);
	p.front = (v3_dot(point_plane_normal(&p), direction) > 0.0f) == (p.material->front_face == GL_CW);
	return p;
}

static inline struct vec3 point_position(const struct point *p)
{
	return v3_add(v3_add(v3_scale(point_corner(p, 0), p->weight[0]), v3_scale(point_corner(p, 1), p->weight[1])),
	              v3_scale(point_corner(p, 2), p->weight[2]));
}

/* Unit normal for effects, on the visible side: GL's interpolated normal if the draw is lit or its program reads the
 * normal, else the plane's. */
static inline struct vec3 point_normal(const struct point *p)
{
	struct vec3 n = point_plane_normal(p), smooth;

	n = v3_scale(n, (p->material->front_face == GL_CW) == p->front ? -1.0f : 1.0f);
	if (!p->material->lighting && !p->material->program_normals)
		return n;
	smooth = v3_normalize(v3_add(v3_add(v3_scale(v3_load(p->vertex[0]->normal), p->weight[0]),
	                                    v3_scale(v3_load(p->vertex[1]->normal), p->weight[1])),
	                             v3_scale(v3_load(p->vertex[2]->normal), p->weight[2])));
	if (!(v3_dot(smooth, smooth) > 0.0f)) /* missing or infinite (vertex_eye_normal) */
		return n;
	return v3_dot(smooth, n) < 0.0f ? v3_scale(smooth, -1.0f) : smooth;
}

/* A triangle in eye space, as needed by rays from any of its points. */
struct point_plane {
	struct vec3 corner[3], normal; /* normal: point_plane_normal */
	float length[3], area;         /* length of the edge opposite each corner; area of the parallelogram */
	float rounding;                /* maximum rounding error of a position on it: POINT_ROUNDING */
};

/*
 * Rounding error of a position, as a share of the numbers it is computed from: about sixteen of 2^-24. A vertex comes
 * to eye space by a sum of four products, as large as the distance to object space's origin (geometry.away). A point
 * sums three corners by weights, which are rounded, too. Its ray goes back to object space, and meets the triangle
 * there by differences and products of corners and edges. (C. Waechter and N. Binder, "A Fast and Robust Method for
 * Avoiding Self-Intersection", Ray Tracing Gems, 2019, ch. 6; M. Pharr, W. Jakob and G. Humphreys, "Physically Based
 * Rendering", 4th ed., section 6.8 counts bounds this way.)
 */
#define POINT_ROUNDING 9.5367431640625e-7f /* 2^-20 */

/* Displacement of a pixel's point by snapping, as a share of its distance. */
#define POINT_SNAPPING 6.103515625e-5f /* 2^-14 */

static inline struct point_plane point_plane_of(const struct point *p)
{
	struct point_plane plane;
	struct vec3 edge[3], cross;
	float reach;

	for (int i = 0; i < 3; i++)
		plane.corner[i] = point_corner(p, i);
	plane.normal = point_plane_normal(p);
	edge[0] = v3_sub(plane.corner[2], plane.corner[1]);
	edge[1] = v3_sub(plane.corner[0], plane.corner[2]);
	edge[2] = v3_sub(plane.corner[1], plane.corner[0]);
	cross = v3_cross(edge[2], edge[0]);
	plane.area = M_SQRT(v3_dot(cross, cross));
	for (int i = 0; i < 3; i++)
		plane.length[i] = M_SQRT(v3_dot(edge[i], edge[i]));
	reach = M_MAX(M_MAX(v3_extent(plane.corner[0]), v3_extent(plane.corner[1])), v3_extent(plane.corner[2]));
	plane.rounding = (reach + p->geometry->away) * POINT_ROUNDING;
	return plane;
}

static inline struct vec3 point_place(const struct point_plane *plane, const float *weight)
{
	return v3_add(v3_add(v3_scale(plane->corner[0], weight[0]), v3_scale(plane->corner[1], weight[1])),
	              v3_scale(plane->corner[2], weight[2]));
}

/*
 * Weights of a position inside the triangle, at least `inset` away from its edges if the triangle is wide enough. They
 * are the point's own weights unless the point is at an edge, or beyond one because vertices are snapped.
 */
static inline void point_inset_weights(const float *of_point, const struct point_plane *plane, float inset,
                                       float *weight)
{
	float sum = 0.0f;

	for (int i = 0; i < 3; i++) {
		float length = plane->length[i];
		float least = inset * length * 3.0f < plane->area ? inset * length / plane->area : 1.0f / 3.0f;

		weight[i] = M_MAX(of_point[i], least);
		sum += weight[i];
	}
	for (int i = 0; i < 3; i++)
		weight[i] /= sum;
}

/*
 * Origin of secondary rays from a point of a triangle: off the plane, on the side of `towards`, by the point's rounding
 * error (plane->rounding) and at least by POINT_SNAPPING of its largest coordinate, which is less than a tenth of a
 * pixel's footprint in common windows.
 *
 * Coverage and depth use vertices snapped to 1/256 pixel, so a pixel's point may be slightly outside its triangle, or
 * behind a wall that meets it. The ray would then start behind the next wall, and a lit corner would show dark pixels.
 * The point therefore first moves back into its triangle and then, by the same distance, against `from`, the direction
 * of the ray that led to it. That ray passed there, so the way is free. The second step is omitted if `towards` leads
 * away through the other side of the triangle.
 */
static inline struct vec3 point_ray_origin(const float *of_point, const struct point_plane *plane, struct vec3 towards,
                                           struct vec3 from)
{
	struct vec3 at = point_place(plane, of_point), n = plane->normal, back = v3_scale(v3_normalize(from), -1.0f);
	float size = M_MAX(v3_extent(at) * POINT_SNAPPING, plane->rounding), weight[3];

	n = v3_dot(n, towards) < 0.0f ? v3_scale(n, -1.0f) : n;
	point_inset_weights(of_point, plane, size, weight);
	at = point_place(plane, weight);
	if (v3_dot(n, back) > 0.0f)
		at = v3_add(at, v3_scale(back, size));
	return v3_add(at, v3_scale(n, size));
}

/* The eye-space position of vertex k for user clip planes. */
static inline struct vec4 point_clip_place(const struct point *p, uint32_t k)
{
	return v4_load(p->material->clip_by_program ? p->vertex[k]->color[1] : p->vertex[k]->eye);
}

/* 1 if a user clip plane (sec. 2.12) clips the point. */
static inline int point_clipped(const struct point *p)
{
	for (uint32_t i = 0u; i < SCENE_MAX_CLIP_PLANES; i++) {
		struct vec4 plane;
		float d;

		if (!(p->material->clip_plane_mask >> i & 1u))
			continue;
		plane = v4_load(p->material->clip_plane_eye[i]);
		d = v4_dot(plane, point_clip_place(p, 0u)) * p->weight[0] + v4_dot(plane, point_clip_place(p, 1u)) * p->weight[1] +
		    v4_dot(plane, point_clip_place(p, 2u)) * p->weight[2];
		if (d < 0.0f)
			return 1;
	}
	return 0;
}

/* --- Light ------------------------------------------------------------------------------------------------------- */

static inline struct vec4 point_mix(const struct point *p, struct vec4 a, struct vec4 b, struct vec4 c)
{
	return v4_between(a, b, c, p->weight);
}

/* The side whose colours are used: the back side only under two-sided lighting (sec. 2.14.1). */
static inline int point_side(const struct point *p)
{
	return p->material->two_side && !p->front;
}

/*
 * The colours that llvmpipe interpolates, as SCENE_HAS_*: those that vertices do not all have from the current state
 * (Mesa 22.3.6, filter_fp_input_mask). Others have no rounding errors.
 */
static inline uint32_t point_interpolated(GLOBAL const struct scene_material *m, uint32_t attributes)
{
	const uint32_t all = SCENE_HAS_COLOR | SCENE_HAS_SECONDARY;

	if (m->shade_model == GL_FLAT)
		return 0u;
	return m->lighting || m->vertex_program ? all : attributes / GEOMETRY_GIVEN & all;
}

static inline struct lit point_lit_from_vertices(const struct point *p)
{
	int side = point_side(p);
	struct lit lit;

	if (p->material->shade_model == GL_FLAT) {
		lit.color = v4_load(p->vertex[2]->color[side]);
		lit.secondary = v4_load(p->vertex[2]->secondary[side]);
		lit.lights = p->vertex[2]->lit[side];
		return lit;
	}
	lit.color = point_mix(p, v4_load(p->vertex[0]->color[side]), v4_load(p->vertex[1]->color[side]),
	                      v4_load(p->vertex[2]->color[side]));
	lit.secondary = point_mix(p, v4_load(p->vertex[0]->secondary[side]), v4_load(p->vertex[1]->secondary[side]),
	                          v4_load(p->vertex[2]->secondary[side]));
	lit.lights = p->vertex[0]->lit[side] | p->vertex[1]->lit[side] | p->vertex[2]->lit[side];
	return lit;
}

/* Light the vertices again, with the lights' visibility; under flat shading only the last one. */
static inline void point_light_corners(const struct tables *t, const struct point *p, const struct vec3 *seen,
                                       struct lit *lit)
{
	for (int i = p->material->shade_model == GL_FLAT ? 2 : 0; i < 3; i++)
		lit[i] = vertex_color(t, p->geometry, p->vertex[i], p->number[i], point_side(p), seen);
}

/* As point_lit_from_vertices, from vertices that point_light_corners has lit. */
static inline struct lit point_lit_between(const struct point *p, const struct lit *lit)
{
	struct lit out = lit[2];

	if (p->material->shade_model == GL_FLAT)
		return out;
	out.color = point_mix(p, lit[0].color, lit[1].color, lit[2].color);
	out.secondary = point_mix(p, lit[0].secondary, lit[1].secondary, lit[2].secondary);
	return out;
}

static inline struct lit point_lit_again(const struct tables *t, const struct point *p, const struct vec3 *seen)
{
	struct lit lit[3];

	point_light_corners(t, p, seen, lit);
	return point_lit_between(p, lit);
}

/* The current colour (glColor) at the point. */
static inline struct vec4 point_current_color(const struct tables *t, const struct point *p)
{
	struct vec4 last = tables_color(t, p->geometry, p->number[2]);

	return p->material->shade_model == GL_FLAT ? last : point_mix(p, tables_color(t, p->geometry, p->number[0]),
	                                                              tables_color(t, p->geometry, p->number[1]), last);
}

/* The same for lights of a rule: without light that is baked into vertex colours. */
static inline struct vec4 point_matte_color(const struct tables *t, const struct point *p)
{
	struct vec4 color = point_current_color(t, p);

	return p->material->surface.light_unit == SCENE_LIGHT_IN_COLORS ? v4(1.0f, 1.0f, 1.0f, color.w) : color;
}

/* The lights of a point beyond GL: its own if a rule has assigned any. */
static inline struct light_list point_lights(const struct point *p)
{
	GLOBAL const struct scene_material *m = p->material;

	return m->surface.relit ? light_list(m->surface.light_first, m->surface.light_count) :
	                          light_list(m->light_first, m->light_count);
}

/* Test whether lighting affects a point's colour. */
static inline int point_takes_light(const struct point *p)
{
	return (p->material->lighting || p->material->surface.relit) && !(p->geometry->flags & GEOMETRY_EXPANDED) &&
	       !(p->material->surface.hidden & SCENE_UNSHADED);
}

/* The normal of a corner, in eye space: the vertex's, or the corner's own if rules assign one (scene_surface
 * SCENE_CREASED). */
static inline struct vec3 point_corner_normal(const struct tables *t, const struct point *p, uint32_t corner)
{
	GLOBAL const struct geometry *g = p->geometry;

	if (!(p->material->surface.hidden & SCENE_CREASED) || g->crease == SCENE_NONE || g->flags & GEOMETRY_EXPANDED)
		return v3_load(p->vertex[corner]->normal);
	return v3_normalize(vertex_eye_normal(g, p->material,
	                                      v3_load(t->attributes + g->crease + (p->primitive * 3u + corner) * 3u)));
}

/* The same, lit at the point itself with its own normal (Phong 1975), instead of interpolating between lit vertices. */
static inline struct lit point_lit_here(const struct tables *t, const struct point *p, const struct vec3 *seen)
{
	int side = point_side(p);
	struct vec3 at = point_position(p), n;

	if (!point_takes_light(p))
		return point_lit_from_vertices(p);
	if (!p->material->lighting)
		return light_vertex(p->material, t->lights, point_lights(p), 1, v4(at.x, at.y, at.z, 1.0f), point_normal(p),
		                    tables_face(t, p->geometry, p->number[2], side), point_matte_color(t, p), side, seen);
	n = v3_normalize(v3_add(v3_add(v3_scale(point_corner_normal(t, p, 0u), p->weight[0]),
	                               v3_scale(point_corner_normal(t, p, 1u), p->weight[1])),
	                        v3_scale(point_corner_normal(t, p, 2u), p->weight[2])));
	return light_vertex(p->material, t->lights, point_lights(p), 0, v4(at.x, at.y, at.z, 1.0f),
	                    side ? v3_scale(n, -1.0f) : n, tables_face(t, p->geometry, p->number[2], side),
	                    point_current_color(t, p), side, seen);
}
