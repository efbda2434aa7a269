/*
 * A fragment's triangle or line as llvmpipe sets it up: planes of depth and attributes, and polygon offset. Data shared
 * by the fragments of a triangle is computed once and cached for those that follow in the list.
 */
#pragma once

#include "kernels/gl/fragment.h"
#include "kernels/gl/pixel.h"

/* The minimum step r of polygon offset (sec. 3.5.5) in llvmpipe: two steps of the depth buffer. */
static inline float setup_step(uint32_t bits)
{
	uint32_t depth_bits = pixel_depth_bits(bits) ? pixel_depth_bits(bits) : 24u;

	return depth_bits > 24u ? 2.0f / 4294967296.0f : 2.0f / (float)pixel_bits_mask(depth_bits);
}

/* Polygon offset in llvmpipe's order of operations. */
static inline float setup_offset(GLOBAL const struct scene_material *m, const struct clip_edges *e, const float *z,
                                 uint32_t bits)
{
	const float first = clip_first(e, z), dz01 = first - clip_second(e, z), dz20 = z[2] - first;
	const float slope = M_MAX(M_ABS((dz20 * e->dy01 - e->dy20 * dz01) * e->one_over_area),
	                          M_ABS((e->dx20 * dz01 - dz20 * e->dx01) * e->one_over_area));

	return m->polygon_offset_units * setup_step(bits) + slope * m->polygon_offset_factor;
}

/* Depth and attribute weights of a line's fragment. Other fragments are not changed. y from the top. */
static inline void setup_line(const struct tables *t, GLOBAL const struct view *views, uint32_t pixel_x,
                              uint32_t pixel_y, struct fragment *f)
{
	GLOBAL const struct view *view;
	struct point_line l;
	struct point p;
	float x, y, along_x, along_y;

	point_vertices(t, &p, f->instance, FRAGMENT_PRIMITIVE(*f));
	if (!(p.geometry->flags & GEOMETRY_LINE))
		return;
	view = &views[p.geometry->view];
	x = clip_from_origin(view, (int32_t)pixel_x, view->sample[0]);
	y = clip_from_origin(view, (int32_t)pixel_y, -view->sample[1]);
	point_line_of(&p, view, &l);
	along_x = (l.a.z - l.b.z) * l.dx * l.one_over_area;
	along_y = (l.a.z - l.b.z) * l.dy * l.one_over_area;
	f->depth = clamp01(
		M_FMA(along_y, y, M_FMA(along_x, x, l.a.z - (along_x * (l.a.x - 0.5f) + along_y * (l.a.y - 0.5f)))));
	point_line_weights(&l, clip_from_origin(view, (int32_t)pixel_x, 0), clip_from_origin(view, (int32_t)pixel_y, 0), f);
}

/*
 * The triangle that a fragment's attributes and depth come from. Coverage uses snapped vertices, but llvmpipe computes
 * attributes and depth from the unsnapped ones; nearest filtering and steep faces show the difference. So they are
 * recomputed from clip coordinates. For a triangle that leaves the view volume (cut), the part that covers the pixel is
 * used. @return 0: a line or a sliver
 */
static inline int setup_triangle(GLOBAL const struct view *view, GLOBAL const struct window_vertex *windows,
                                 const struct point *p, uint32_t x, uint32_t y, uint32_t height, int cut,
                                 struct clip_setup *setup)
{
	struct clip_polygon polygon;
	uint32_t part = 2u;
	float w_inv[3];

	if (p->geometry->flags & GEOMETRY_LINE)
		return 0;
	if (cut) {
		clip_triangle(view, (float)height, v4_load(p->vertex[0]->clip), v4_load(p->vertex[1]->clip),
		              v4_load(p->vertex[2]->clip), &polygon);
		while (part < polygon.n && !clip_covers(polygon.corner[part - 1u].window, polygon.corner[part].window,
		                                        polygon.corner[0].window, clip_spot(view, (int32_t)x, (int32_t)y)))
			part++;
		if (part >= polygon.n)
			return 0;
		setup->cuts = polygon.cuts;
	} else {
		setup->cuts.n = 0u;
	}
	for (uint32_t i = 0u; i < 3u; i++) {
		struct clip_corner *c = &setup->corner[i];

		if (cut) {
			*c = polygon.corner[i == 2u ? 0u : part - 1u + i];
		} else {
			c->clip = v4_load(p->vertex[i]->clip);
			c->number = i;
			c->b1 = i == 1u ? 1.0f : 0.0f;
			c->b2 = i == 2u ? 1.0f : 0.0f;
			if (p->geometry->flags & GEOMETRY_SMOOTH_LINE) {
				c->place[0] = p->vertex[i]->size[0];
				c->place[1] = p->vertex[i]->size[1];
			} else {
				clip_place(view, c->clip, (float)height, c->place);
			}
			c->window = windows[p->geometry->vertex_first + p->number[i]];
		}
		w_inv[i] = c->window.w_inv;
		setup->px[i] = c->place[0] - clip_origin(view);
		setup->py[i] = c->place[1] - clip_origin(view);
	}
	if (clip_is_sliver(clip_place_area(setup->px, setup->py)))
		return 0;
	setup->edges = clip_edges_of(setup->px, setup->py);
	setup->w_inv = clip_plane_through(&setup->edges, w_inv);
	return 1;
}

/* A triangle's set-up, cached from its first fragment for those that follow in the list. */
struct setup_kept {
	uint32_t instance, primitive; /* the fragments'; SCENE_NONE: empty */
	struct point p;               /* without its weights */
	float w_inv[3];
	int have_setup, have_lit;
	struct clip_setup setup;
	struct clip_plane depth;
	float offset;                 /* polygon offset; 0: none */
	struct point_kept sampling;
	struct vec3 seen[SCENE_MAX_LIGHTS]; /* visibility of lights, if its vertices were lit again */
	struct lit lit[3];
};

/* Get the triangle of a fragment. Clipped triangles are not cached, as other pixels may be in other parts. */
static inline void setup_keep(const struct shade_arguments *a, uint32_t x, uint32_t y, const struct fragment *f,
                              int keeps, struct setup_kept *kept)
{
	const int cut = (f->primitive & FRAGMENT_PERSPECTIVE) != 0, needs_depth = a->n_slots == 0u;

	if (keeps && kept->instance == f->instance && kept->primitive == f->primitive)
		return;
	kept->instance = cut ? SCENE_NONE : f->instance;
	kept->primitive = f->primitive;
	kept->p = point_of_triangle(&a->tables, a->windows, f, kept->w_inv);
	kept->have_lit = 0;
	point_keep_nothing(&kept->sampling);
	kept->have_setup = setup_triangle(&a->views[kept->p.geometry->view], a->windows, &kept->p, x, y, a->height, cut,
	                                  &kept->setup);
	if (needs_depth && kept->have_setup) {
		const float z[3] = { kept->setup.corner[0].window.z, kept->setup.corner[1].window.z, kept->setup.corner[2].window.z };

		kept->depth = clip_plane_through(&kept->setup.edges, z);
		kept->offset = kept->p.material->polygon_offset & 4u && !(kept->p.geometry->flags & GEOMETRY_EXPANDED) ?
		                       setup_offset(kept->p.material, &kept->setup.edges, z, a->bits) : 0.0f;
	}
}

/* Test whether the vertices were lit with the visibility seen here, which the next fragment mostly shares. From now on
 * they are. */
static inline int setup_keeps_seen(const struct vec3 *seen, int keeps, struct setup_kept *kept)
{
	int same = keeps && kept->have_lit;

	for (uint32_t i = 0u; i < SCENE_MAX_LIGHTS; i++) {
		same &= seen[i].x == kept->seen[i].x && seen[i].y == kept->seen[i].y && seen[i].z == kept->seen[i].z;
		kept->seen[i] = seen[i];
	}
	kept->have_lit = 1;
	return same;
}

/* Light the vertices again. */
static inline void setup_keep_lit(const struct tables *t, const struct vec3 *seen, int keeps, struct setup_kept *kept)
{
	if (!setup_keeps_seen(seen, keeps, kept))
		point_light_corners(t, &kept->p, seen, kept->lit);
}

/*
 * Attribute weights of a triangle's fragment, and its depth with polygon offset. Depth belongs to the sample position,
 * attributes to the pixel's centre, which samples share (sec. 3.2.1).
 */
static inline void setup_unsnap(GLOBAL const struct view *view, const struct setup_kept *kept, uint32_t x, uint32_t y,
                                uint32_t height, struct fragment *f)
{
	const struct clip_setup *setup = &kept->setup;
	float px[3], py[3], area = clip_place_area(setup->px, setup->py);

	f->depth = clamp01(clip_plane_in(&kept->depth, view, (float)height, (int32_t)x, (int32_t)y) + kept->offset);
	for (uint32_t i = 0u; i < 3u; i++) {
		px[i] = setup->px[i] - clip_from_origin(view, (int32_t)x, 0);
		py[i] = setup->py[i] - clip_from_origin(view, (int32_t)(height - 1u - y), 0);
	}
	f->b1 = -(px[2] * py[0] - px[0] * py[2]) / area;
	f->b2 = -(px[0] * py[1] - px[1] * py[0]) / area;
	if (f->primitive & FRAGMENT_PERSPECTIVE)
		clip_weights(&setup->corner[0], &setup->corner[1], &setup->corner[2], f->b1, f->b2, &f->b1, &f->b2);
}
