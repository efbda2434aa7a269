#include "tracer/frame/prepare/expand_quad.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "gl_tokens.h"
#include "scene/mesa.h"

int expand_reserve_quad(const struct expand_input *in, struct expanded *out)
{
	const size_t quads = out->n_vertices / 4, room = 2 * quads + 64, units = in->material->unit_count;
	int err;

	if (quads < out->room)
		return 0;
	if ((err = memory_resize(&out->vertices, 4 * room, sizeof(*out->vertices))) ||
	    (err = memory_resize(&out->windows, 4 * room, sizeof(*out->windows))) ||
	    (err = memory_resize(&out->texcoords, 4 * room * units, sizeof(*out->texcoords))) ||
	    (err = memory_resize(&out->position, 4 * room, sizeof(*out->position))) ||
	    (err = memory_resize(&out->index, 6 * room, sizeof(*out->index))) ||
	    (err = memory_resize(&out->primitive_draw, 2 * room, sizeof(*out->primitive_draw))))
		return err;
	out->room = (uint32_t)room;
	return 0;
}

int32_t expand_round(const struct expand_input *in, float x)
{
	if (in->mesa & SCENE_MESA_ROUNDS_TO_EVEN)
		return (int32_t)rintf(x);
	return (int32_t)(x >= 0 ? x + 0.5f : x - 0.5f);
}

int32_t expand_snap(const struct expand_input *in, float pixels)
{
	return expand_round(in, (pixels - 0.5f) * 256) + 128;
}

void expand_add_corner(const struct expand_input *in, struct expanded *out, const struct expand_end *e, int32_t x,
                       int32_t y)
{
	uint32_t at = out->n_vertices++, units = in->material->unit_count;
	int32_t up = (int32_t)in->height * 256 - y;
	const float *v = in->view->viewport, *range = in->view->depth_range;
	float w = 1 / e->w_inv, px = (float)x / 256, py = (float)up / 256;
	float half_range = (range[1] - range[0]) * 0.5f;
	struct shaded_vertex *vertex = &out->vertices[at];

	*vertex = e->v;
	vertex->clip[0] = (2 * (px - v[0]) / v[2] - 1) * w;
	vertex->clip[1] = (2 * (py - v[1]) / v[3] - 1) * w;
	vertex->clip[2] = half_range != 0 ? (e->z - range[0] - half_range) / half_range * w : 0;
	vertex->clip[3] = w;
	vertex->lit[0] = vertex->lit[1] = 0;
	out->windows[at] = (struct window_vertex){ x, up, e->z, e->w_inv };
	memcpy(out->position[at], (float[4]){ px, py, 0, 1 }, sizeof(out->position[at]));
	if (units)
		memcpy(out->texcoords + (size_t)at * units, e->texcoord, units * sizeof(e->texcoord[0]));
	out->n_texcoords += units;
}

/*
 * Corners are in the order of Mesa's draw module, which decides the last bits of interpolated values. Turning a
 * triangle swaps its first two, as llvmpipe does.
 */
void expand_add_triangles(const struct expand_input *in, struct expanded *out, uint32_t draw)
{
	uint32_t first = out->n_vertices - 4, *index = out->index + 3 * (size_t)out->n_primitives;
	const struct window_vertex *w = out->windows + first;
	int64_t area = ((int64_t)w[1].x - w[0].x) * ((int64_t)w[2].y - w[0].y) -
	               ((int64_t)w[2].x - w[0].x) * ((int64_t)w[1].y - w[0].y);
	uint32_t turn = (area > 0) != (in->material->front_face == GL_CCW);
	const uint32_t corners[2][3] = { { 2, 0, 1 }, { 3, 0, 2 } };

	for (unsigned i = 0; i < 2; i++) {
		*index++ = first + corners[i][turn];
		*index++ = first + corners[i][!turn];
		*index++ = first + corners[i][2];
	}
	out->primitive_draw[out->n_primitives] = out->primitive_draw[out->n_primitives + 1] = draw;
	out->n_primitives += 2;
}

void expand_add_smooth_corner(const struct expand_input *in, struct expanded *out, const struct expand_end *e, float x,
                              float y, const float coverage[4])
{
	struct shaded_vertex *vertex = &out->vertices[out->n_vertices];
	const float *v = in->view->viewport;
	float w = 1 / e->w_inv;

	expand_add_corner(in, out, e, expand_snap(in, x), expand_snap(in, y));
	vertex->clip[0] = (2 * (x - v[0]) / v[2] - 1) * w;
	vertex->clip[1] = (2 * ((float)in->height - y - v[1]) / v[3] - 1) * w;
	vertex->size[0] = x;
	vertex->size[1] = y;
	memcpy(vertex->color[1], coverage, sizeof(vertex->color[1]));
}
