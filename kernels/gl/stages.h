/*
 * One work item of each shading kernel. The .cl files and the C twins are thin wrappers around these.
 *
 * Camera kernels write fragments sparsely, with a fixed number of slots per pixel. `gather` compacts them into a dense
 * list, pixel by pixel, and in draw order within each pixel. Everything after that works on the list.
 */
#pragma once

#include "kernels/encode.h"
#include "kernels/gl/setup.h"
#include "kernels/gl/userclip.h"

/* Index of a work item's pixel of a rectangle, in buffers of pixels that begin with the rectangles' row 0. */
static inline uint32_t stage_pixel(struct camera_rectangle r, uint32_t width, uint32_t item)
{
	uint32_t columns = (uint32_t)(r.x1 - r.x0);

	return ((uint32_t)r.y0 + item / columns) * width + (uint32_t)r.x0 + item % columns;
}

/* gather: moves a pixel's fragments to their place in the list, and sets where its column continues next time. */
static inline void gather_item(const struct gather_arguments *a, uint32_t item)
{
	const uint32_t pixel = stage_pixel(a->rectangle, a->width, item);
	uint32_t n = a->counts[pixel];

	for (uint32_t i = 0u; i < n; i++) {
		a->list[a->first[pixel] + i] = a->sparse[pixel * a->slots + i];
		a->pixels[a->first[pixel] + i] = a->first_pixel + pixel;
	}
	a->after[pixel] = n == a->slots ? a->sparse[pixel * a->slots + n - 1u].order + 1u : SCENE_NONE;
}

/* Visibility of the material's lights for the item. */
static inline void stage_seen(GLOBAL const float *visibility, uint32_t n_slots, uint32_t n, uint32_t item,
                              struct vec3 *seen)
{
	for (uint32_t slot = 0u; slot < SCENE_MAX_LIGHTS; slot++)
		seen[slot] = v3(1.0f, 1.0f, 1.0f);
	for (uint32_t slot = 0u; slot < n_slots && slot < SCENE_MAX_LIGHTS; slot++)
		seen[slot] = v3_load(visibility + (slot * n + item) * 3u);
}

/* 1 if any of them is dimmed. */
static inline int stage_dimmed(GLOBAL const float *visibility, uint32_t n_slots, uint32_t n, uint32_t item)
{
	int dimmed = 0;

	for (uint32_t slot = 0u; slot < n_slots && slot < SCENE_MAX_LIGHTS; slot++) {
		struct vec3 share = v3_load(visibility + (slot * n + item) * 3u);

		dimmed |= (share.x < 1.0f) | (share.y < 1.0f) | (share.z < 1.0f);
	}
	return dimmed;
}

/* The listed lights that need a ray. Expanded lines and points receive no shadows. */
static inline uint32_t stage_wanted(const struct point *p, uint32_t lights)
{
	return p->geometry->flags & GEOMETRY_EXPANDED ? 0u : (lights & 255u) * SHADED_WANTS(0);
}

/*
 * Test whether a vertex program relights fragments of a material, with the lights' visibility. flags: of its geometry
 */
static inline int stage_is_lit_by_program(const struct shade_arguments *a, GLOBAL const struct scene_material *m,
                                          uint32_t flags)
{
	return a->n_slots && m->vertex_program && m->light_count && !m->surface.relit && !(flags & GEOMETRY_EXPANDED);
}

/* Test whether program_item affects the fragments' colour. */
static inline int stage_is_by_program(const struct shade_arguments *a, GLOBAL const struct scene_material *m,
                                      uint32_t flags)
{
	return m->fragment_program || stage_is_lit_by_program(a, m, flags);
}

static inline int stage_stippled_away(const struct tables *t, const struct point *p, uint32_t x, uint32_t y)
{
	uint32_t stipple = p->material->polygon_stipple;

	if (stipple == SCENE_NONE || p->geometry->flags & GEOMETRY_EXPANDED)
		return 0;
	return !(t->stipples[stipple * 32u + (y & 31u)] >> (31u - (x & 31u)) & 1u);
}

/* 1 if a pixel is not one of a line's drawn pixels (GEOMETRY_LINE). row: from the top */
static inline int stage_undrawn(const struct point *p, uint32_t x, uint32_t row)
{
	GLOBAL const float *drawn = p->vertex[0]->secondary[1];

	return p->geometry->flags & GEOMETRY_LINE && ((float)x < drawn[0] || (float)row < drawn[1] || (float)row > drawn[2]);
}

/* 1: no ambient light, but light between surfaces, up to the requested number of bounces. */
static inline int stage_is_path(uint32_t transport)
{
	return transport >= TRANSPORT_PATH;
}

/*
 * Physically based radiance of a lit surface: emission, and direct light; no ambient light, no clamping. A surface that
 * GL does not light shows its own colour.
 */
static inline struct vec3 stage_radiance(const struct tables *t, const struct point *p,
                                         const struct texturing *texturing, uint32_t transport, const struct vec3 *seen)
{
	GLOBAL const struct scene_material *m = p->material;
	struct light_list list = point_lights(p);
	struct vec3 n = point_normal(p), at = point_position(p), sum = v3(0.0f, 0.0f, 0.0f);
	struct vec4 c;
	struct lit lit;

	if (!point_takes_light(p)) {
		lit = point_lit_from_vertices(p);
		c = point_finish(t, p, texturing, &lit);
		return stage_light(transport, v3_add(v3(c.x, c.y, c.z), v3_load(m->surface.emission)));
	}
	for (uint32_t i = 0u; i < list.count; i++) {
		GLOBAL const struct scene_light *light = &t->lights[list.first + i];
		struct vec3 to_light;
		float strength = light_strength(light, at, &to_light), cosine = v3_dot(n, to_light);

		if (cosine > 0.0f)
			sum = v3_add(sum, v3_mul(v3_scale(stage_light(transport,
			                                              v3_scale(v3_load(light->diffuse), strength)),
			                                  cosine),
			                         seen[i]));
	}
	c = point_albedo(t, p, texturing);
	sum = v3_add(v3_mul(sum, stage_light(transport, v3(c.x, c.y, c.z))),
	             stage_light(transport, v3_load(m->surface.emission)));
	return m->lighting ?
	               v3_add(stage_light(transport,
	                                  v3_load(tables_face(t, p->geometry, p->number[2], point_side(p))->emission)),
	                      sum) :
	               sum;
}

/* The listed lights that can light a point in stage_radiance and can be shadowed. */
static inline uint32_t stage_radiant_lights(const struct tables *t, const struct point *p)
{
	struct light_list list = point_lights(p);
	struct vec3 n = point_normal(p), at = point_position(p), to_light;
	uint32_t lights = 0u;

	if (!point_takes_light(p))
		return 0u;
	for (uint32_t i = 0u; i < list.count; i++)
		if (t->lights[list.first + i].radius >= 0.0f && light_strength(&t->lights[list.first + i], at, &to_light) > 0.0f &&
		    v3_dot(n, to_light) > 0.0f)
			lights |= 1u << i;
	return lights;
}

/*
 * Lights whose visibility must be known before a point is lit. from_vertices: those that light its vertices (struct
 * lit)
 */
static inline uint32_t stage_lights(const struct tables *t, const struct point *p, uint32_t transport,
                                    uint32_t from_vertices)
{
	if (stage_is_path(transport))
		return stage_radiant_lights(t, p);
	if (transport == TRANSPORT_RELIGHT && !p->material->surface.relit)
		return from_vertices | point_lit_here(t, p, (const struct vec3 *)0).lights;
	return p->material->surface.relit ? point_lit_here(t, p, (const struct vec3 *)0).lights : from_vertices;
}

static inline void stage_store_direct(GLOBAL struct shaded *out, struct vec3 color)
{
	v3_store(out->direct, color);
	v3_store(out->mirrored, color);
	v3_store(out->beauty, color);
}

/* The colour with the requested kind of lighting; linear light with TRANSPORT_LINEAR. color: from GL's own lighting */
static inline struct vec3 stage_relit(const struct tables *t, const struct point *p, const struct texturing *texturing,
                                      uint32_t transport, const struct vec3 *seen, struct vec4 color)
{
	struct lit lit;

	if (stage_is_path(transport))
		return stage_radiance(t, p, texturing, transport, seen);
	if (transport == TRANSPORT_RELIGHT || p->material->surface.relit) {
		lit = point_lit_here(t, p, seen);
		color = point_finish_relit(t, p, texturing, &lit);
	}
	return v3_add(v3(color.x, color.y, color.z), v3_load(p->material->surface.emission));
}

/*
 * Share of the pixel that a smooth line or point covers (sec. 3.3.1, 3.4.2 leave the filter open), as in Mesa's draw
 * module (22.3). A line has ramps one pixel wide across its sides and ends, interpolated with perspective like any
 * attribute. A point covers all pixels whose centres are in its circle; the ramp of its rim continues inwards, beyond
 * 1, and is absent at the rim itself, so alphas increase towards the middle.
 */
static inline float stage_coverage(const struct point *p)
{
	struct vec4 c;
	float apart;

	if (!(p->geometry->flags & (GEOMETRY_SMOOTH_LINE | GEOMETRY_SMOOTH_POINT)))
		return 1.0f;
	c = point_mix(p, v4_load(p->vertex[0]->color[1]), v4_load(p->vertex[1]->color[1]), v4_load(p->vertex[2]->color[1]));
	if (p->geometry->flags & GEOMETRY_SMOOTH_LINE) {
		const float along = clamp01(c.w - M_ABS(c.z)), length = c.w * 2.0f - 1.0f;

		return clamp01(c.y - M_ABS(c.x)) * (p->geometry->flags & GEOMETRY_LENGTH_COVERS && length < along ? length : along);
	}
	apart = c.x * c.x + c.y * c.y;
	if (!(apart <= 1.0f))
		return 0.0f;
	return apart < c.z ? (1.0f - apart) / (1.0f - c.z) : 1.0f;
}

/* A pixel rectangle's extent along one axis: a window position (y from the top) and the texel there, at either end. */
struct stage_extent {
	float place[2], texel[2]; /* in order of ascending texel */
};

static inline struct stage_extent stage_extent_of(const struct point *p, uint32_t axis)
{
	struct stage_extent e;

	for (uint32_t i = 0u; i < 3u; i++) {
		const float texel = p->vertex[i]->color[1][axis], place = p->vertex[i]->size[axis];

		if (i == 0u || texel < e.texel[0]) {
			e.texel[0] = texel;
			e.place[0] = place;
		}
		if (i == 0u || texel > e.texel[1]) {
			e.texel[1] = texel;
			e.place[1] = place;
		}
	}
	return e;
}

/*
 * The texel of a rectangle at a pixel along one axis, in the order of operations of llvmpipe (22.3.6) for a texture
 * coordinate: with zoom, a pixel's centre is often on the border of two texels.
 * @param base    the end of the axis where its plane of coordinates starts
 * @param turned  1: texels are counted from the last one
 * @param across  the rectangle's size along the other axis, signed from its base
 */
static inline float stage_texel(const struct stage_extent *e, int base, int turned, float across, uint32_t pixel,
                                uint32_t n)
{
	const float first = e->texel[base] / (float)n, other = e->texel[!base] / (float)n,
		    size = e->place[base] - e->place[!base];
	const float from = turned ? 1.0f - first : first,
		    along = (turned ? other - first : first - other) * (across * (1.0f / (size * across)));
	const float texel = M_FLOOR(M_FMA(along, (float)pixel, from - along * (e->place[base] - 0.5f)) * (float)n);
	const float within = M_MIN(M_MAX(texel, 0.0f), (float)(n - 1u));

	return turned ? (float)(n - 1u) - within : within;
}

/*
 * The texel of a bitmap or pixel rectangle under a fragment; y from the top. llvmpipe's planes start at the last
 * column's end, and at the row's end where a triangle has two corners; for a mirrored rectangle, at the first column's
 * end and the last row's.
 */
static inline GLOBAL const uint32_t *stage_pixel_group(const struct tables *t, const struct point *p, uint32_t x,
                                                       uint32_t y, uint32_t *kind)
{
	const struct stage_extent columns = stage_extent_of(p, 0u), rows = stage_extent_of(p, 1u);
	GLOBAL const struct texture_image *image = &t->textures[(uint32_t)(p->vertex[0]->color[1][2] + 0.5f)];
	const uint32_t kind_and_origin = (uint32_t)(p->vertex[0]->color[1][3] + 0.5f);
	const int mirrored = (columns.place[1] > columns.place[0]) == (rows.place[1] > rows.place[0]);
	int high = 0, at_column = !mirrored, at_row;
	float column, row;

	for (uint32_t i = 0u; i < 3u; i++)
		high += p->vertex[i]->color[1][1] == rows.texel[1];
	at_row = mirrored || high == 2;
	column = stage_texel(&columns, at_column, 0, rows.place[!at_row] - rows.place[at_row], x, image->width);
	row = stage_texel(&rows, at_row, (kind_and_origin & SCENE_FROM_TOP) != 0u,
	                  columns.place[at_column] - columns.place[!at_column], y, image->height);
	*kind = kind_and_origin & ~SCENE_FROM_TOP;
	return t->texels + image->level_first[0] + ((uint32_t)row * image->width + (uint32_t)column) * image->words;
}

static inline struct vec4 stage_texel_color(GLOBAL const uint32_t *group, uint32_t kind)
{
	uint32_t texel = *group;

	if (kind == SCENE_FLOAT_PIXELS)
		return v4(M_FLOAT(group[0]), M_FLOAT(group[1]), M_FLOAT(group[2]), M_FLOAT(group[3]));
	return v4((float)(texel & 255u) / 255.0f, (float)(texel >> 8 & 255u) / 255.0f, (float)(texel >> 16 & 255u) / 255.0f,
	          (float)(texel >> 24) / 255.0f);
}

/* Store a fragment's flags, and for pixel rectangles its depth. group, kind: their texel; kind 0: not a pixel
 * rectangle */
static inline void stage_store_flags(const struct shade_arguments *a, const struct point *p, uint32_t lights,
                                     GLOBAL const uint32_t *group, uint32_t kind, GLOBAL struct shaded *out)
{
	if (kind == SCENE_DEPTH_PIXELS)
		out->depth = clamp01(M_FLOAT(*group));
	if (kind == SCENE_STENCIL_PIXELS) {
		out->depth = (float)(*group & 255u);
		out->flags = SHADED_THERE | SHADED_STENCIL;
		return;
	}
	out->flags = SHADED_THERE | (p->front ? SHADED_FRONT : 0u) |
	             stage_wanted(p, stage_lights(&a->tables, p, a->transport, lights));
}

/*
 * Place a fragment that is seen for the first time: set its attribute weights and depth from its triangle or line.
 * @return 0: clip planes or stipples leave nothing there
 */
static inline int stage_place_first(const struct shade_arguments *a, uint32_t x, uint32_t y,
                                    const struct setup_kept *kept, struct fragment *f)
{
	GLOBAL const struct view *view = &a->views[kept->p.geometry->view];
	const int clipped = userclip_outside(view, a->windows, &kept->p, (int32_t)x, (int32_t)y, (float)a->height);

	if (kept->have_setup)
		setup_unsnap(view, kept, x, y, a->height, f);
	else
		setup_line(&a->tables, a->views, x, a->height - 1u - y, f);
	return !clipped && !stage_undrawn(&kept->p, x, a->height - 1u - y) && !stage_stippled_away(&a->tables, &kept->p, x, y);
}

/* A fragment's colours between its lit vertices. again: as for point_lit_by_planes */
static inline struct lit stage_lit(const struct point *p, const struct lit *again, const struct point_window *w)
{
	const float middle = 0.5f - clip_origin(w->view), x = (float)w->x + middle;

	if (w->setup && !(p->geometry->flags & GEOMETRY_PIXELS))
		return point_lit_by_planes(p, again, w->setup, x, (float)(w->height - 1u - w->row) + middle);
	return again ? point_lit_between(p, again) : point_lit_from_vertices(p);
}

/*
 * shade: n_slots == 0 computes a fragment's GL colour, its depth and the lights whose visibility it needs; n_slots > 0
 * computes the colour of those fragments with the lights' visibility. transport: TRANSPORT_*. kept: cache for the
 * fragment's triangle. keeps: 1 if earlier fragments of this launch may have filled it (kept->instance SCENE_NONE: they
 * have not).
 */
static inline void shade_item(const struct shade_arguments *a, uint32_t item, int keeps, struct setup_kept *kept)
{
	const struct tables *t = &a->tables;
	GLOBAL struct shaded *out = &a->shaded[item];
	GLOBAL const uint32_t *group = t->texels;
	struct vec3 seen[SCENE_MAX_LIGHTS];
	struct point_window window;
	struct texturing texturing;
	struct lit from_vertices, lit;
	struct fragment f;
	struct point p;
	struct vec4 color;
	float coverage;
	uint32_t x, y, kind = 0u;
	int drawn = 1, is_lit_again;

	if (a->n_slots && (!stage_dimmed(a->visibility, a->n_slots, a->n, item) || !(out->flags & SHADED_THERE)))
		return;
	stage_seen(a->visibility, a->n_slots, a->n, item, seen);

	/* Place it, and decide whether it is drawn. */
	f = a->fragments[item];
	x = a->pixels[item] % a->width;
	y = a->pixels[item] / a->width;
	setup_keep(a, x, y, &f, keeps, kept);
	p = kept->p;
	if (!a->n_slots) {
		drawn = stage_place_first(a, x, y, kept, &f);
		a->fragments[item] = f;
	}
	fragment_weights(f, kept->w_inv[0], kept->w_inv[1], kept->w_inv[2], p.weight);
	coverage = stage_coverage(&p);
	if (!(coverage > 0.0f) && !(p.geometry->flags & GEOMETRY_SMOOTH_LINE)) /* a line's border still writes depth */
		drawn = a->n_slots != 0u;
	if (drawn && p.geometry->flags & GEOMETRY_PIXELS) {
		group = stage_pixel_group(t, &p, x, a->height - 1u - y, &kind);
		drawn = kind != SCENE_BITMAP || *group;
	}
	if (!drawn) {
		out->flags = 0u;
		return;
	}

	/* Its colour: lit, textured, with fog. */
	window.view = &a->views[p.geometry->view];
	window.setup = kept->have_setup ? &kept->setup : (const struct clip_setup *)0;
	window.kept = keeps ? &kept->sampling : (struct point_kept *)0;
	window.x = x;
	window.row = y;
	window.height = a->height;
	point_texture(t, &p, &window, &texturing);
	is_lit_again = a->n_slots && !p.material->surface.relit;
	if (is_lit_again)
		setup_keep_lit(t, seen, keeps, kept);
	lit = from_vertices = stage_lit(&p, is_lit_again ? kept->lit : (const struct lit *)0, &window);
	if (kind == SCENE_COLOR_PIXELS || kind == SCENE_FLOAT_PIXELS)
		lit.color = stage_texel_color(group, kind);
	color = point_finish(t, &p, &texturing, &lit);
	color = v4(pixel_nudge(color.x), pixel_nudge(color.y), pixel_nudge(color.z), color.w);
	v3_store(out->shadowed, v3(color.x, color.y, color.z));
	stage_store_direct(out, stage_number(a->transport, stage_relit(t, &p, &texturing, a->transport, seen, color)));
	if (a->n_slots)
		return;
	color.w *= coverage;
	v4_store(out->gl, color);
	color = a->albedo ? point_albedo_of(t, &p, &texturing, from_vertices) : v4(0.0f, 0.0f, 0.0f, 0.0f);
	v3_store(out->albedo, v3(color.x, color.y, color.z));
	out->depth = f.depth;
	stage_store_flags(a, &p, from_vertices.lights, group, kind, out);
}

/* --- Pixels ------------------------------------------------------------------------------------------------------ */

/* clear: clears a pixel of the rectangle. */
static inline void clear_item(const struct clear_arguments *a, uint32_t item)
{
	pixel_clear(&a->clear, &a->frame[stage_pixel(a->rectangle, a->width, item)], a->bits);
}

/* merge_samples: merges a pixel's samples. */
static inline void merge_samples_item(const struct merge_samples_arguments *a, uint32_t item)
{
	pixel_merge(&a->first[item], &a->second[item], &a->third[item], &a->fourth[item], &a->frame[item]);
}

static inline GLOBAL const struct scene_material *stage_material(const struct tables *t, uint32_t instance)
{
	return &t->materials[t->geometries[instance].material];
}

/* The number of a fragment's draw. */
static inline uint32_t stage_draw(const struct tables *t, uint32_t instance, uint32_t primitive)
{
	GLOBAL const struct geometry *g = &t->geometries[instance];

	return g->draw + (g->primitive_draw != SCENE_NONE ?
	                          t->indices[g->primitive_draw + (primitive & ~FRAGMENT_PERSPECTIVE)] :
	                          0u);
}

/* Run a pixel's listed fragments through the per-fragment operations, in draw order. */
static inline void stage_resolve(const struct resolve_arguments *a, uint32_t pixel)
{
	const struct tables *t = &a->tables;

	for (uint32_t i = a->first[pixel]; i < a->first[pixel] + a->counts[pixel]; i++) {
		GLOBAL const struct fragment *f = &a->fragments[i];

		pixel_draw(stage_material(t, f->instance), &a->shaded[i], f, stage_draw(t, f->instance, f->primitive),
		           &a->frame[pixel], a->bits);
	}
}

static inline void resolve_item(const struct resolve_arguments *a, uint32_t item)
{
	stage_resolve(a, stage_pixel(a->rectangle, a->width, item));
}

/* A row of FRAME_ROW pixels that resolve_packet draws to: its pixels from first to end are in the rectangle. */
struct stage_row {
	uint32_t number; /* index among the band's rows */
	uint32_t first, end;
};

/* Open a work item's row, and clear it if its first fragments are about to be drawn. */
static inline struct stage_row stage_open_row(const struct resolve_arguments *a, uint32_t item)
{
	const uint32_t columns = frame_columns(a->width), y = (uint32_t)a->rectangle.y0 + item / columns,
		       x = item % columns * FRAME_ROW;
	const uint32_t end = x + FRAME_ROW < a->width ? x + FRAME_ROW : a->width;
	const uint32_t left = (uint32_t)a->rectangle.x0, right = (uint32_t)a->rectangle.x1;
	uint32_t n = 0u;
	struct stage_row row;

	row.number = y * columns + item % columns;
	row.first = y * a->width + (x > left ? x : left);
	row.end = y * a->width + (end < right ? end : right);
	for (uint32_t pixel = row.first; pixel < row.end; pixel++)
		n += a->counts[pixel];
	for (uint32_t pixel = y * a->width + x; pixel < y * a->width + end && n && !a->drawn[row.number]; pixel++)
		a->frame[pixel] = *a->cleared;
	if (n)
		a->drawn[row.number] = 1u;
	else
		row.end = row.first;
	return row;
}
