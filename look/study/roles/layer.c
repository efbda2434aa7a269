#include "look/study/roles/layer.h"

#include <math.h>
#include <string.h>

#include "look/draws/drawn.h"
#include "look/draws/matrix.h"
#include "look/draws/modelview.h"
#include "look/draws/solid.h"
#include "look/study/motion/box.h"
#include "look/study/motion/face.h"

/* A ground reaches from below the viewer to the horizon; a sky is nowhere this much nearer than elsewhere. */
#define NEAREST 0.1
/* The viewer is inside the painted layer's box, enlarged by this share: a dome may end at the viewer's height. */
#define MARGIN 0.05
/* A backdrop covers this share of the window in width and in height. */
#define COVERS 0.95
enum { MOST_TRIANGLES = 512 }; /* that are sampled in a mesh */

/* 1 if a draw leaves colour in the window. */
static int is_painted(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];

	return s->views[in->view].target == 0 && !in->rectangle && m->color_mask & 7 && !m->stencil_test &&
	       modelview_kind_of(in->modelview) == MODELVIEW_PLAIN && s->meshes[in->mesh]->primitive_count;
}

/* 1 if a view shows the surroundings of the origin of eye space. */
static int is_from_origin(const struct scene_view *view)
{
	const float *p = view->projection;

	return p[3] == 0 && p[7] == 0 && p[11] != 0 && p[12] == 0 && p[13] == 0 && p[15] == 0;
}

static int is_world(const struct scene *s, const struct scene_instance *in)
{
	return solid_is(s, in) && !drawn_in_parallel(&s->views[in->view]);
}

/* The distance from the origin to the nearest point of a triangle. */
static double nearest_of(const struct face *f)
{
	double best = HUGE_VAL, along = matrix_dot3(f->normal, f->corner[0]);
	int inside = 1;

	for (int c = 0; c < 3; c++) {
		const double *a = f->corner[c], *b = f->corner[(c + 1) % 3];
		double edge[3], at[3], out[3], length, t;

		for (int k = 0; k < 3; k++)
			edge[k] = b[k] - a[k];
		length = matrix_dot3(edge, edge);
		t = length > 0 ? fmin(1, fmax(0, -matrix_dot3(a, edge) / length)) : 0;
		for (int k = 0; k < 3; k++) {
			at[k] = a[k] + t * edge[k];
			out[k] = edge[(k + 1) % 3] * f->normal[(k + 2) % 3] - edge[(k + 2) % 3] * f->normal[(k + 1) % 3];
		}
		best = fmin(best, sqrt(matrix_dot3(at, at)));
		inside &= -matrix_dot3(a, out) <= 0;
	}
	return inside ? fabs(along) : best;
}

/* 1 if a draw surrounds the viewer or may be part of something that does. @param box  in eye space, enlarged by it */
static int is_about(const struct scene *s, const struct scene_instance *in, struct box *box)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const uint32_t stride = mesh->primitive_count / MOST_TRIANGLES + 1;
	double eye[16], nearest = HUGE_VAL, farthest = 0;

	matrix_from_floats(eye, in->modelview);
	for (uint32_t v = 0; v < mesh->vertex_count; v++) {
		const float *p = mesh->position + 4 * (size_t)v;
		double at[3];

		matrix_point(at, eye, (double[3]){ (double)p[0], (double)p[1], (double)p[2] });
		box_widen(box, at);
		farthest = fmax(farthest, sqrt(matrix_dot3(at, at)));
		if (mesh->kind != SCENE_TRIANGLES)
			nearest = fmin(nearest, sqrt(matrix_dot3(at, at)));
	}
	for (uint32_t p = 0; p < mesh->primitive_count && mesh->kind == SCENE_TRIANGLES; p += stride) {
		struct face face;

		if (face_of(mesh, eye, p, &face))
			nearest = fmin(nearest, nearest_of(&face));
	}
	return nearest >= NEAREST * farthest && isfinite(nearest);
}

/* 1 if a picture covers the window. */
static int covers_window(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	double eye[16], projection[16], clip[16];
	struct box box;

	matrix_from_floats(eye, in->modelview);
	matrix_from_floats(projection, s->views[in->view].projection);
	matrix_mul(clip, projection, eye);
	box = box_of(mesh, clip);
	return mesh->kind == SCENE_TRIANGLES && box.low[0] <= -COVERS && box.low[1] <= -COVERS &&
	       box.high[0] >= COVERS && box.high[1] >= COVERS;
}

/* The number of instances from `first` on that belong to the world. */
static uint32_t count_world(const struct scene *s, uint32_t first, uint32_t end)
{
	uint32_t n = 0;

	for (uint32_t i = first; i < end; i++)
		n += (uint32_t)is_world(s, &s->instances[i]);
	return n;
}

/* The first instance after a depth clear that only draws around the viewer precede. @return 0: there is none */
static uint32_t end_by_clear(const struct scene *s)
{
	for (uint32_t c = 0; c < s->n_clears; c++) {
		const struct scene_clear *clear = &s->clears[c];
		struct box box = box_empty;
		uint32_t i = 0;

		if (clear->target || (clear->buffers & 3) != 2 || !clear->before_instance || (uint32_t)clear->scissor[2] < s->width ||
		    (uint32_t)clear->scissor[3] < s->height || !count_world(s, 0, clear->before_instance))
			continue;
		while (i < clear->before_instance && (!is_world(s, &s->instances[i]) || is_about(s, &s->instances[i], &box)))
			i++;
		if (i == clear->before_instance && count_world(s, i, s->n_instances))
			return i;
	}
	return 0;
}

/* The first instance of the world; 0: nothing precedes it, or there is no world. */
static uint32_t find_end(const struct scene *s)
{
	uint32_t end = end_by_clear(s), i = 0;

	if (end)
		return end;
	while (i < s->n_instances && !is_world(s, &s->instances[i]))
		i++;
	return i < s->n_instances ? i : 0;
}

static int is_within(const struct box *b)
{
	double size = 0;

	for (int k = 0; k < 3; k++)
		size = fmax(size, b->high[k] - b->low[k]);
	for (int k = 0; k < 3; k++)
		if (b->low[k] > MARGIN * size || b->high[k] < -MARGIN * size)
			return 0;
	return size > 0;
}

/* 1 if the world contains the same object at the same place, so that the draw is one of its passes. */
static int is_in_world(const struct scene *s, const struct scene_instance *in, uint32_t end)
{
	for (uint32_t i = end; i < s->n_instances; i++)
		if (s->instances[i].mesh == in->mesh && memcmp(s->instances[i].modelview, in->modelview, sizeof(in->modelview)) == 0)
			return 1;
	return 0;
}

void layer_find(const struct scene *s, uint8_t *out)
{
	const uint32_t end = find_end(s);
	struct box all = box_empty;

	memset(out, LAYER_WORLD, s->n_instances);
	for (uint32_t i = 0; i < end; i++) {
		const struct scene_instance *in = &s->instances[i];
		struct box box = all;

		if (!is_painted(s, in) || is_in_world(s, in, end))
			continue;
		if (drawn_in_parallel(&s->views[in->view])) {
			out[i] = covers_window(s, in) ? LAYER_SKY : LAYER_WORLD;
		} else if (is_from_origin(&s->views[in->view]) && is_about(s, in, &box)) {
			out[i] = LAYER_UNKNOWN;
			all = box;
		}
	}
	for (uint32_t i = 0; i < end && is_within(&all); i++)
		out[i] = out[i] == LAYER_UNKNOWN ? LAYER_SKY : out[i];
}
