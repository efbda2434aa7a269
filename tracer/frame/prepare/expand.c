#include "tracer/frame/prepare/expand.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "gl_tokens.h"
#include "tracer/frame/prepare/expand_line.h"
#include "tracer/frame/prepare/expand_point.h"
#include "tracer/frame/prepare/expand_quad.h"

/* Compute the polygon offset of a triangle drawn as lines or points (sec. 3.5.5). */
static float polygon_offset(const struct expand_input *in, const struct expand_end *e)
{
	const struct scene_material *m = in->material;
	uint32_t bit = in->shape == PREPARED_LINES ? 2 : 1, bits = in->depth_bits > 24 ? 24 : in->depth_bits;
	struct expand_end p[3] = { e[0], e[1], e[2] };
	float x1, y1, z1, x2, y2, z2, area, slope = 0;

	if (!(m->polygon_offset & bit))
		return 0;
	for (int i = 0; i < 3; i++)
		expand_project(in, &p[i]);
	x1 = p[1].x - p[0].x;
	y1 = p[1].y - p[0].y;
	z1 = p[1].z - p[0].z;
	x2 = p[2].x - p[0].x;
	y2 = p[2].y - p[0].y;
	z2 = p[2].z - p[0].z;
	area = x1 * y2 - x2 * y1;
	if (area != 0)
		slope = fmaxf(fabsf((z1 * y2 - z2 * y1) / area), fabsf((z2 * x1 - z1 * x2) / area));
	return slope * m->polygon_offset_factor + m->polygon_offset_units / (float)((1u << (bits ? bits : 24)) - 1);
}

/* 1 if a triangle is front facing (sign of its area in clip space). */
static int is_front(const struct expand_input *in, const uint32_t *index)
{
	const float *a = in->vertices[index[0]].clip, *b = in->vertices[index[1]].clip,
		    *c = in->vertices[index[2]].clip;
	float det = a[3] * (b[0] * c[1] - c[0] * b[1]) + b[3] * (c[0] * a[1] - a[0] * c[1]) +
	            c[3] * (a[0] * b[1] - b[0] * a[1]);

	return (det > 0) == (in->material->front_face == GL_CCW);
}

static int polygon_of_mesh(const struct expand_input *in, struct expanded *out, uint32_t primitive, uint32_t draw)
{
	const uint32_t *index = in->mesh->index + 3 * (size_t)primitive;
	uint32_t flags = in->mesh->edge_flags ? in->mesh->edge_flags[primitive] : 7;
	int front = is_front(in, index), side = in->material->two_side && !front, err = 0, n, cut;
	struct expand_end e[EXPAND_CORNERS];
	float offset;

	if (in->cull & (front ? INSTANCE_CULL_FRONT : INSTANCE_CULL_BACK))
		return 0;
	for (int i = 0; i < 3; i++) {
		e[i] = expand_load_end(in, index[i], side);
		e[i].edge = flags >> i & 1;
	}
	if (in->material->shade_model == GL_FLAT)
		for (int i = 0; i < 2; i++)
			expand_take_color(&e[i], &e[2]);
	cut = expand_is_cut(in, e);
	n = expand_clip_triangle(in, e);
	offset = n ? polygon_offset(in, e) : 0;
	/* Mesa (22.3.6) restarts the pattern at each clipped triangle, and draws the lines of unclipped ones from their
	 * last side on. */
	if (n && (cut || !(flags & SCENE_CONTINUES)))
		*in->dashed = 0;
	for (int k = 0; k < n && !err; k++) {
		int i = cut || in->shape != PREPARED_LINES ? k : (k + n - 1) % n;
		struct expand_end a = e[i], b = e[(i + 1) % n];

		if (a.edge)
			err = in->shape == PREPARED_LINES ? expand_edge(in, out, &a, &b, offset, draw) :
			                                    expand_corner(in, out, a, offset, draw);
	}
	return err;
}

static int line_of_mesh(const struct expand_input *in, struct expanded *out, uint32_t primitive, uint32_t draw)
{
	const uint32_t *index = in->mesh->index + 2 * (size_t)primitive;
	struct expand_end a = expand_load_end(in, index[0], 0), b = expand_load_end(in, index[1], 0);

	if (in->material->shade_model == GL_FLAT)
		expand_take_color(in->material->first_provokes ? &b : &a, in->material->first_provokes ? &a : &b);
	if (!expand_clip_line(in, &a, &b))
		return 0;
	/* If the first line of a strip is invisible, Mesa does not restart the pattern. */
	if (!in->mesh->edge_flags || !(in->mesh->edge_flags[primitive] & SCENE_CONTINUES))
		*in->dashed = 0;
	return expand_edge(in, out, &a, &b, 0, draw);
}

static void make_mesh(struct expanded *e)
{
	XXH128_hash_t hash;

	e->mesh = (struct scene_mesh){ .kind = SCENE_TRIANGLES, .vertex_count = e->n_vertices,
		                       .primitive_count = e->n_primitives, .position = (const float *)e->position,
		                       .index = e->index, .primitive_draw = e->primitive_draw };
	hash = XXH3_128bits(e->position, e->n_vertices * sizeof(*e->position));
	/* the hash must differ from that of a scene mesh with the same positions, and from the same quads of another
	 * draw */
	hash = XXH3_128bits_withSeed(e->index, e->n_primitives * 3 * sizeof(*e->index), hash.low64 ^ hash.high64 ^ 1);
	hash = XXH3_128bits_withSeed(e->primitive_draw, e->n_primitives * sizeof(*e->primitive_draw),
	                             hash.low64 ^ hash.high64);
	e->mesh.hash[0] = hash.low64;
	e->mesh.hash[1] = hash.high64;
}

/* Index of the i-th primitive in drawing order. Flags may come from a damaged index. */
static uint32_t primitive_of(const struct scene_mesh *mesh, uint32_t i)
{
	const uint8_t *flags = mesh->edge_flags;

	if (!flags)
		return i;
	if (i > 0 && flags[i] & SCENE_EARLIER)
		return i - 1;
	return i + 1 < mesh->primitive_count && flags[i + 1] & SCENE_EARLIER ? i + 1 : i;
}

int expand_primitives(const struct expand_input *in, struct expanded *out)
{
	int err = expand_reserve_quad(in, out);

	for (uint32_t k = 0; k < in->mesh->primitive_count && !err; k++) {
		uint32_t i = primitive_of(in->mesh, k);
		uint32_t draw = in->mesh->primitive_draw ? in->mesh->primitive_draw[i] : 0;

		if (in->rectangles)
			err = expand_rectangle(in, out, in->mesh->index[i], draw);
		else if (in->mesh->kind == SCENE_TRIANGLES)
			err = polygon_of_mesh(in, out, i, draw);
		else if (in->mesh->kind == SCENE_LINES)
			err = line_of_mesh(in, out, i, draw);
		else
			err = expand_point(in, out, expand_load_end(in, in->mesh->index[i], 0), 0, draw);
	}
	if (err)
		expanded_free(out);
	else
		make_mesh(out);
	return err;
}

void expanded_free(struct expanded *e)
{
	free(e->vertices);
	free(e->windows);
	free(e->texcoords);
	free(e->position);
	free(e->index);
	free(e->primitive_draw);
	memset(e, 0, sizeof(*e));
}
