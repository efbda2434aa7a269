/*
 * Sixteen fragments of the list at once, one per lane, from any triangles of one material: loads them and finds their
 * places in their triangles, in the order of operations of setup.h and with bit-identical results. OpenCL C only.
 *
 * Triangles that leave the view volume are clipped one at a time, and the results are cached.
 */
#pragma once

#include "kernels/frame/pack/pack_texture.h"
#include "kernels/gl/stages.h"
#include "kernels/rays/gather.h"

/* Sixteen of struct window_vertex. */
struct window_vertex_16 {
	packi x, y;
	packf z, w_inv;
};

#include "kernels/sixteen_lanes.h"
#include "kernels/gl/clip_lanes.h"
#include "kernels/one_lanes.h"

#define PACK_SIZE 16u

/* Fragments as in the list. item: their indices there */
struct pack_list {
	uint item[PACK_SIZE], instance[PACK_SIZE], primitive[PACK_SIZE], pixel[PACK_SIZE];
	float b1[PACK_SIZE], b2[PACK_SIZE], depth[PACK_SIZE];
};

/* The fragments' triangles, and their places in them. */
struct pack {
	__global const struct scene_material *material;
	__global const struct view *view;
	uint instance, primitive; /* the whole triangle that all lanes were in last; SCENE_NONE: none */
	packi x, row;             /* pixels, row 0 at the top */
	int uniform;              /* 1: all lanes are in the same triangle */
	packi cut, front;         /* all ones: the triangle leaves the view volume; it shows its front */
	packu number[3];          /* vertex numbers in the mesh */
	packu vertex[3];          /* vertex numbers in the frame */
	packf px[3], py[3], z[3], w_inv[3]; /* corners of the triangle or of its covering part, from clip_origin */
	uint part[PACK_SIZE];               /* pack_part of the lanes whose triangle is cut */
	packf corner1[3], corner2[3];       /* for parts: the corners' weights of vertices 1 and 2 */
	packf vertex_w_inv[3];
	struct pack_edges edges;
	packf b1, b2, depth, weight[3];
	packf away; /* as struct geometry */
	packu attributes;
};

/* Clipping results that the fragments of a triangle share, cached for later fragments. */
#define PACK_CUTS 4u
struct pack_cut {
	uint instance, primitive; /* SCENE_NONE: the entry is empty */
	struct clip_polygon polygon;
};

/* The vertices of a triangle lit with its lights' visibility, cached for later fragments. */
struct pack_lit {
	uint instance, primitive; /* SCENE_NONE: the entry is empty */
	struct point p;
	struct vec3 seen[SCENE_MAX_LIGHTS];
	struct lit lit[3];
};

struct pack_kept {
	struct pack last;
	struct pack_cut cuts[PACK_CUTS];
	struct pack_lit lit[SHADE_TRIANGLES];
};

static inline void pack_keep_nothing(struct pack_kept *kept)
{
	kept->last.instance = kept->last.primitive = SCENE_NONE;
	for (uint i = 0; i < SHADE_TRIANGLES; i++)
		kept->lit[i].instance = SCENE_NONE;
	for (uint i = 0; i < PACK_CUTS; i++)
		kept->cuts[i].instance = SCENE_NONE;
}

/* Sixteen numbers with the alignment of one. PoCL's vload16 and vstore16 move them one by one. */
typedef float16 pack_loose_floats __attribute__((aligned(4)));
typedef uint16 pack_loose_uints __attribute__((aligned(4)));

/* Load a fragment of the list into a lane. */
static inline void pack_take(__global const struct fragment *fragments, __global const uint *pixels, uint item,
                             uint lane, struct pack_list *list)
{
	list->item[lane] = item;
	list->instance[lane] = fragments[item].instance;
	list->primitive[lane] = fragments[item].primitive;
	list->b1[lane] = fragments[item].b1;
	list->b2[lane] = fragments[item].b2;
	list->depth[lane] = fragments[item].depth;
	list->pixel[lane] = pixels[item];
}

/* Sixteen of n fragments, starting at `first`. Lanes beyond them repeat the last. */
static inline void pack_list(__global const struct fragment *fragments, __global const uint *pixels, uint first, uint n,
                             struct pack_list *list)
{
	for (uint lane = 0; lane < PACK_SIZE; lane++)
		pack_take(fragments, pixels, min(first + lane, n - 1), lane, list);
}

/* --- Which ones -------------------------------------------------------------------------------------------------- */

/* Test whether a pack can handle fragments of a geometry together with others of its material. */
static inline int pack_knows_geometry(__global const struct geometry *g)
{
	return !g->flags && !(g->attributes & SCENE_HAS_FACE);
}

/*
 * The lanes, out of a set, that a pack can handle together with the first of them. material: receives the first one's
 */
static inline uint pack_same_kind(const struct tables *t, const struct pack_list *list, uint lanes, uint *material)
{
	const uint first = list->instance[popcount((lanes & -lanes) - 1)];
	const uint others = lanes & pack_bits(*(const pack_loose_uints *)list->instance != first);
	uint same = pack_knows_geometry(&t->geometries[first]) ? lanes & ~others : 0;

	*material = t->geometries[first].material;
	for (uint left = others; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);
		__global const struct geometry *g = &t->geometries[list->instance[lane]];

		if (g->material == *material && pack_knows_geometry(g))
			same |= left & -left;
	}
	return same;
}

/* The SHADE_PACKET items of a work item: a bit for each that is left, and for each that packs can handle. */
struct pack_left {
	uint first;
	ulong all, packed;
	uint material[SHADE_PACKET];
};

/*
 * The first item left, with other items of its material that share a pack with it. Lanes beyond them repeat the last.
 * @return a bit for each lane; 0: packs cannot handle it, and item[0] is processed alone
 */
static inline uint pack_next(struct pack_left *left, uint *item)
{
	const uint next = popcount((left->all & -left->all) - 1);
	uint n = 0;

	item[0] = left->first + next;
	if (!(left->packed >> next & 1)) {
		left->all &= left->all - 1;
		return 0;
	}
	for (ulong rest = left->all & left->packed; rest && n < PACK_SIZE; rest &= rest - 1) {
		const uint i = popcount((rest & -rest) - 1);

		if (left->material[i] != left->material[next])
			continue;
		item[n++] = left->first + i;
		left->all &= ~((ulong)1 << i);
	}
	for (uint lane = n; lane < PACK_SIZE; lane++)
		item[lane] = item[n - 1];
	return (1u << n) - 1;
}

/* --- Loading ----------------------------------------------------------------------------------------------------- */

/* The lanes that are in one triangle. */
WIDE_VECTORS static inline uint pack_in_triangle(const struct pack_list *list, uint instance, uint primitive)
{
	return pack_bits((*(const pack_loose_uints *)list->primitive == primitive) &
	                 (*(const pack_loose_uints *)list->instance == instance));
}

/* Load the lanes' triangles. Unselected lanes repeat the first selected one. */
WIDE_VECTORS static inline void pack_load_triangles(const struct tables *t, const struct pack_list *list, uint lanes,
                                                    struct pack *p)
{
	const uint first = popcount((lanes & -lanes) - 1), step = sizeof(struct geometry) / sizeof(uint);
	const packi asked = pack_mask(lanes);
	const packu instance = select((packu)(list->instance[first]), *(const pack_loose_uints *)list->instance, asked);
	const packu primitive = select((packu)(list->primitive[first]), *(const pack_loose_uints *)list->primitive, asked);
	__global const struct geometry *g = &t->geometries[list->instance[first]];
	packu index = g->index, vertex = g->vertex_first;

	p->uniform = !any_pack((instance != instance.s0) | (primitive != primitive.s0));
	p->cut = (primitive & FRAGMENT_PERSPECTIVE) != 0;
	p->away = g->away;
	p->attributes = g->attributes;
	if (any_pack(instance != instance.s0)) {
		p->away = as_float16(PACK_WORDS((__global const uint *)&t->geometries->away, instance * step));
		p->attributes = PACK_WORDS(&t->geometries->attributes, instance * step);
		index = PACK_WORDS(&t->geometries->index, instance * step);
		vertex = PACK_WORDS(&t->geometries->vertex_first, instance * step);
	}
	index += 3 * (primitive & ~FRAGMENT_PERSPECTIVE);
	for (uint k = 0; k < 3; k++) {
		p->number[k] = p->uniform ? (packu)(t->indices[index.s0 + k]) : PACK_WORDS(t->indices, index + k);
		p->vertex[k] = vertex + p->number[k];
	}
}

/* Load their pixels. */
WIDE_VECTORS static inline void pack_load_pixels(uint width, uint height, const struct pack_list *list, struct pack *p)
{
	const packu pixel = *(const pack_loose_uints *)list->pixel;

	p->b1 = *(const pack_loose_floats *)list->b1;
	p->b2 = *(const pack_loose_floats *)list->b2;
	p->depth = *(const pack_loose_floats *)list->depth;
	p->row = convert_int16(convert_float16(pixel) / (float)width);
	p->x = as_int16(pixel) - p->row * (int)width;
	p->row += (p->x < 0) - (p->x >= (int)width); /* the quotient may be off by one; true is -1 in vectors */
	p->x = as_int16(pixel) - p->row * (int)width;
	p->row = (int)height - 1 - p->row;
}

static inline void pack_load(const struct tables *t, uint width, uint height, const struct pack_list *list, uint lanes,
                             struct pack *p)
{
	pack_load_triangles(t, list, lanes, p);
	pack_load_pixels(width, height, list, p);
}

/* The lanes' entries of a table of four numbers each; a single load in a uniform pack. */
WIDE_VECTORS static inline void pack_row(__global const float *table, const struct pack *p, packu index, packf *row)
{
	float4 all;

	if (!p->uniform) {
		pack_gather(table, index, row);
		return;
	}
	all = vload4(index.s0, table);
	row[0] = all.x;
	row[1] = all.y;
	row[2] = all.z;
	row[3] = all.w;
}

/* Rows of the vertex stage's output, four numbers at a time: struct shaded_vertex has eight of them. */
#define PACK_CLIP 0u
#define PACK_EYE 1u
#define PACK_COLOR 2u     /* + 1: back side */
#define PACK_SECONDARY 4u /* + 1 */
#define PACK_NORMAL 6u    /* and the fog coordinate */
#define PACK_LIT 7u

WIDE_VECTORS static inline void pack_vertex(const struct tables *t, const struct pack *p, int k, packu four, packf *row)
{
	pack_row((__global const float *)t->vertices, p, p->vertex[k] * 8 + four, row);
}

WIDE_VECTORS static inline struct vec4_16 pack_vertex4(const struct tables *t, const struct pack *p, int k, packu four)
{
	packf row[4];

	pack_vertex(t, p, k, four, row);
	return v4_16(row[0], row[1], row[2], row[3]);
}

/* Triangles that run clockwise, judged from clip space. */
WIDE_VECTORS static inline packi pack_by_clip(packf (*c)[4])
{
	const packf x = c[0][1] * c[1][3] - c[0][3] * c[1][1], y = c[0][3] * c[1][0] - c[0][0] * c[1][3];
	const packf z = c[0][0] * c[1][1] - c[0][1] * c[1][0];

	return x * c[2][0] + y * c[2][1] + z * c[2][3] < 0.0f;
}

/* The triangles in the window, and the side that they show. */
WIDE_VECTORS static inline void pack_window(const struct tables *t, __global const struct window_vertex *windows,
                                            struct pack *p)
{
	packf x[3], y[3], window[4];
	packi placed = -1, clockwise;

	for (int k = 0; k < 3; k++) {
		pack_row((__global const float *)windows, p, p->vertex[k], window);
		x[k] = convert_float16(as_int16(window[0]));
		y[k] = convert_float16(as_int16(window[1]));
		placed &= window[3] > 0.0f;
		p->z[k] = window[2];
		p->w_inv[k] = p->vertex_w_inv[k] = window[3];
	}
	clockwise = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]) < 0.0f;
	if (any_pack(~placed)) {
		packf clip[3][4];

		for (int k = 0; k < 3; k++)
			pack_vertex(t, p, k, PACK_CLIP, clip[k]);
		clockwise = select(pack_by_clip(clip), clockwise, placed);
	}
	p->front = p->material->front_face == GL_CW ? clockwise : ~clockwise;
}

/* Window positions of the vertices, not snapped. */
WIDE_VECTORS static inline void pack_corners(const struct shade_arguments *a, struct pack *p)
{
	for (int k = 0; k < 3; k++) {
		packf place[2];

		clip_place(p->view, pack_vertex4(&a->tables, p, k, PACK_CLIP), (float)a->height, place);
		p->px[k] = place[0] - clip_origin(p->view);
		p->py[k] = place[1] - clip_origin(p->view);
	}
}

/* The part of a lane's triangle inside the view volume. */
static inline const struct clip_polygon *pack_polygon(const struct shade_arguments *a, const struct pack_list *list,
                                                      const struct pack *p, uint lane, struct pack_kept *kept)
{
	struct pack_cut *cut = &kept->cuts[list->primitive[lane] % PACK_CUTS];
	__global const struct shaded_vertex *v = a->tables.vertices;

	if (cut->instance != list->instance[lane] || cut->primitive != list->primitive[lane]) {
		cut->instance = list->instance[lane];
		cut->primitive = list->primitive[lane];
		clip_triangle(p->view, (float)a->height, v4_load(v[LANE(p->vertex[0], uint, lane)].clip),
		              v4_load(v[LANE(p->vertex[1], uint, lane)].clip),
		              v4_load(v[LANE(p->vertex[2], uint, lane)].clip), &cut->polygon);
	}
	return &cut->polygon;
}

/* clip_inside for all lanes. x, y: sample positions, 1/256 pixel from the bottom */
WIDE_VECTORS static inline packi pack_inside(struct window_vertex a, struct window_vertex b, int sign, packi x, packi y)
{
	const int dx = sign * (b.x - a.x), dy = sign * (b.y - a.y), has_edge = dy < 0 || (dy == 0 && dx > 0);
	const long16 e = convert_long16(y - a.y) * (long)dx - convert_long16(x - a.x) * (long)dy;

	return convert_int16(e > (long)(has_edge ? -1 : 0));
}

/* clip_covers for all lanes. */
WIDE_VECTORS static inline packi pack_covers_part(struct window_vertex v0, struct window_vertex v1,
                                                  struct window_vertex v2, packi x, packi y)
{
	const clip_area area = (clip_area)(v1.x - v0.x) * (v2.y - v0.y) - (clip_area)(v2.x - v0.x) * (v1.y - v0.y);
	const int sign = area > 0 ? 1 : -1;

	if (area == 0)
		return 0;
	return pack_inside(v0, v1, sign, x, y) & pack_inside(v1, v2, sign, x, y) & pack_inside(v2, v0, sign, x, y);
}

/* The part of a polygon that covers each lane's pixel, as the number of its second corner; polygon->n: none does. */
WIDE_VECTORS static inline packu pack_part(const struct shade_arguments *a, const struct clip_polygon *polygon,
                                           const struct pack *p)
{
	const packi x = p->x * 256 + 128 + p->view->sample[0],
		    y = ((int)a->height - 1 - p->row) * 256 + 128 + p->view->sample[1];
	packu part = polygon->n;

	for (uint k = polygon->n; k-- > 2;) /* the first of several wins */
		part = select(part, (packu)(k),
		              pack_covers_part(polygon->corner[k - 1].window, polygon->corner[k].window,
		                               polygon->corner[0].window, x, y));
	return part;
}

/* Corner k of a part. */
static inline const struct clip_corner *pack_corner(const struct clip_polygon *polygon, uint part, uint k)
{
	return &polygon->corner[k == 2 ? 0 : part - 1 + k];
}

/* The lanes, out of a set, that are in the same part of the same triangle as the first of them. */
WIDE_VECTORS static inline uint pack_same_part(const struct pack_list *list, const struct pack *p, uint lanes)
{
	const uint lane = popcount((lanes & -lanes) - 1);

	return lanes & pack_in_triangle(list, list->instance[lane], list->primitive[lane]) &
	       pack_bits(vload16(0, p->part) == p->part[lane]);
}

/* Replace the corners of the lanes' triangle by those of a part. */
WIDE_VECTORS static inline void pack_place_part(const struct clip_polygon *polygon, uint part, packi lanes,
                                                struct pack *p)
{
	for (uint k = 0; k < 3; k++) {
		const struct clip_corner *c = pack_corner(polygon, part, k);

		p->px[k] = select(p->px[k], (packf)(c->place[0] - clip_origin(p->view)), lanes);
		p->py[k] = select(p->py[k], (packf)(c->place[1] - clip_origin(p->view)), lanes);
		p->z[k] = select(p->z[k], (packf)(c->window.z), lanes);
		p->w_inv[k] = select(p->w_inv[k], (packf)(c->window.w_inv), lanes);
		p->corner1[k] = select(p->corner1[k], (packf)(c->b1), lanes);
		p->corner2[k] = select(p->corner2[k], (packf)(c->b2), lanes);
	}
}

/*
 * Replace four numbers at the vertices of a lane's triangle by those at its part's corners, in all lanes of the part.
 */
WIDE_VECTORS static inline void pack_cut_row(const struct clip_polygon *polygon, uint lane, packi lanes,
                                             const struct pack *p, packf (*row)[4])
{
	struct vec4 pool[3 + CLIP_MAX_CUTS];

	for (uint k = 0; k < 3; k++)
		pool[k] = v4(LANE(row[k][0], float, lane), LANE(row[k][1], float, lane), LANE(row[k][2], float, lane),
		             LANE(row[k][3], float, lane));
	for (uint k = 0; k < polygon->cuts.n; k++)
		pool[3 + k] = v4_mix(pool[polygon->cuts.from[k]], pool[polygon->cuts.to[k]], polygon->cuts.t[k]);
	for (uint k = 0; k < 3; k++) {
		const struct vec4 c = pool[pack_corner(polygon, p->part[lane], k)->number];

		row[k][0] = select(row[k][0], (packf)(c.x), lanes);
		row[k][1] = select(row[k][1], (packf)(c.y), lanes);
		row[k][2] = select(row[k][2], (packf)(c.z), lanes);
		row[k][3] = select(row[k][3], (packf)(c.w), lanes);
	}
}

/* --- Where they are ---------------------------------------------------------------------------------------------- */

/* setup_offset for all lanes. */
WIDE_VECTORS static inline packf pack_offset(const struct pack *p, uint bits)
{
	const struct pack_edges *e = &p->edges;
	const packf first = select(p->z[0], p->z[1], e->turned), dz01 = first - select(p->z[1], p->z[0], e->turned),
		    dz20 = p->z[2] - first;
	const packf slope = fmax(fabs((dz20 * e->dy01 - e->dy20 * dz01) * e->one_over_area),
	                         fabs((e->dx20 * dz01 - dz20 * e->dx01) * e->one_over_area));

	return p->material->polygon_offset_units * setup_step(bits) + slope * p->material->polygon_offset_factor;
}

/* Depth, and the vertices' weights on the screen, as in setup_unsnap. bits: of the depth buffer */
WIDE_VECTORS static inline void pack_unsnap(struct pack *p, uint bits)
{
	__global const struct view *view = p->view;
	const float middle = 0.5f - clip_origin(view);
	const packf x = convert_float16(p->x) + middle, y = convert_float16(p->row) + middle;
	const struct pack_plane depth = pack_plane_through(&p->edges, p->z);
	packf px[3], py[3], at;

	at = pack_plane_at(&depth, x + (float)view->sample[0] * 0.00390625f, y + (float)-view->sample[1] * 0.00390625f);
	p->depth = clamp01(p->material->polygon_offset & 4u ? at + pack_offset(p, bits) : at);
	for (int k = 0; k < 3; k++) {
		px[k] = p->px[k] - x;
		py[k] = p->py[k] - y;
	}
	p->b1 = -(px[2] * py[0] - px[0] * py[2]) / p->edges.area;
	p->b2 = -(px[0] * py[1] - px[1] * py[0]) / p->edges.area;
	if (any_pack(p->cut)) {
		const packf p0 = (1.0f - p->b1 - p->b2) * p->w_inv[0], p1 = p->b1 * p->w_inv[1],
			    p2 = p->b2 * p->w_inv[2], sum = p0 + p1 + p2;

		p->b1 = select(p->b1, (p0 * p->corner1[0] + p1 * p->corner1[1] + p2 * p->corner1[2]) / sum, p->cut);
		p->b2 = select(p->b2, (p0 * p->corner2[0] + p1 * p->corner2[1] + p2 * p->corner2[2]) / sum, p->cut);
	}
}

/* fragment_weights for all lanes. */
WIDE_VECTORS static inline void pack_weigh(struct pack *p)
{
	const packf one = 1.0f;
	const packf c0 = (1.0f - p->b1 - p->b2) * select(p->vertex_w_inv[0], one, p->cut);
	const packf c1 = p->b1 * select(p->vertex_w_inv[1], one, p->cut), c2 = p->b2 * select(p->vertex_w_inv[2], one, p->cut);
	const packf sum = c0 + c1 + c2;

	p->weight[0] = c0 / sum;
	p->weight[1] = c1 / sum;
	p->weight[2] = c2 / sum;
}

/* All ones in lanes that use the back side's colours. */
WIDE_VECTORS static inline packi pack_side(const struct pack *p)
{
	return p->material->two_side ? ~p->front : (packi)(0);
}

/* The lanes' triangles and the weights of their vertices, for fragments that are already shaded. */
static inline void pack_locate(const struct tables *t, __global const struct window_vertex *windows, uint width,
                               uint height, const struct pack_list *list, uint lanes, struct pack *p)
{
	pack_load(t, width, height, list, lanes, p);
	pack_window(t, windows, p);
	pack_weigh(p);
}

/* The corners and edges of the lanes' triangles. @return the lanes whose pixel is covered by a part of the triangle */
static inline uint pack_find(const struct shade_arguments *a, const struct pack_list *list, uint lanes,
                             struct pack_kept *kept, struct pack *p)
{
	pack_window(&a->tables, a->windows, p);
	pack_corners(a, p);
	for (int k = 0; k < 3; k++)
		p->corner1[k] = p->corner2[k] = 0.0f;
	*(pack_loose_uints *)p->part = 0;
	for (uint left = lanes & pack_bits(p->cut), same; left; left &= ~same) {
		const uint lane = popcount((left & -left) - 1);
		const struct clip_polygon *polygon = pack_polygon(a, list, p, lane, kept);
		const packu part = pack_part(a, polygon, p);

		same = left & pack_in_triangle(list, list->instance[lane], list->primitive[lane]);
		*(pack_loose_uints *)p->part = select(*(const pack_loose_uints *)p->part, part, pack_mask(same));
		for (uint k = 2; k < polygon->n; k++)
			if (same & pack_bits(part == k))
				pack_place_part(polygon, k, pack_mask(same) & (part == k), p);
		lanes &= ~(same & pack_bits(part >= polygon->n));
	}
	pack_edges_of(p->px, p->py, &p->edges);
	return lanes;
}

/*
 * Find the lanes' places in their triangles. p: material and view are set, and instance and primitive, which are the
 * last call's or SCENE_NONE
 * @return the lanes that have a place; the others are in slivers
 */
static inline uint pack_place(const struct shade_arguments *a, const struct pack_list *list, uint lanes, int first_time,
                              struct pack_kept *kept, struct pack *p)
{
	const uint first = popcount((lanes & -lanes) - 1);
	const int is_known = p->primitive != SCENE_NONE && !(lanes & ~pack_in_triangle(list, p->instance, p->primitive));

	pack_load_pixels(a->width, a->height, list, p);
	if (!is_known) {
		pack_load_triangles(&a->tables, list, lanes, p);
		lanes = pack_find(a, list, lanes, kept, p);
		p->instance = list->instance[first];
		p->primitive = p->uniform && !p->cut.s0 ? list->primitive[first] : SCENE_NONE;
	}
	lanes &= pack_bits(fabs(p->edges.area) > 1.0e-6f);
	if (first_time)
		pack_unsnap(p, a->bits);
	pack_weigh(p);
	return lanes;
}
