#include "look/study/tricks/volumes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "gl_tokens.h"
#include "look/draws/matrix.h"
#include "look/spare/flattened.h"

enum { MAX_LINES = 3000, GUESSES = 400, LEAST_MEETING = 8 };

/* A line along an edge: a point and a unit vector. */
struct line {
	double at[3], along[3], length; /* HUGE_VAL: infinite */
};

static int counts(uint32_t op)
{
	return op == GL_INCR || op == GL_DECR || op == GL_INCR_WRAP || op == GL_DECR_WRAP;
}

/* The kind of volume that a draw counts; N_TRICKS: none. */
static enum trick volume_of(const struct scene_material *m)
{
	if ((m->color_mask & 7) || !m->stencil_test || !m->depth_test)
		return N_TRICKS;
	if (counts(m->stencil_front.zfail) || counts(m->stencil_back.zfail))
		return TRICK_VOLUME_Z_FAIL;
	return counts(m->stencil_front.zpass) || counts(m->stencil_back.zpass) ? TRICK_VOLUME_Z_PASS : N_TRICKS;
}

/* The line through two vertices of a mesh, in eye space; w 0 is at infinity. @return 0: there is none */
static int line_through(const double eye[16], const float *a, const float *b, struct line *line)
{
	double p[4], q[4], length;

	matrix_transform(p, eye, (double[4]){ (double)a[0], (double)a[1], (double)a[2], (double)a[3] });
	matrix_transform(q, eye, (double[4]){ (double)b[0], (double)b[1], (double)b[2], (double)b[3] });
	if (p[3] == 0 && q[3] == 0)
		return 0;
	for (int k = 0; k < 3; k++) {
		line->at[k] = p[3] != 0 ? p[k] / p[3] : q[k] / q[3];
		line->along[k] = p[3] == 0 ? p[k] : q[3] == 0 ? q[k] : q[k] / q[3] - line->at[k];
	}
	length = sqrt(matrix_dot3(line->along, line->along));
	line->length = p[3] == 0 || q[3] == 0 ? HUGE_VAL : length;
	for (int k = 0; k < 3; k++)
		line->along[k] /= length > 0 ? length : 1;
	return length > 0;
}

static int longer(const void *a, const void *b)
{
	double x = ((const struct line *)a)->length, y = ((const struct line *)b)->length;

	return x < y ? 1 : x > y ? -1 : 0;
}

/* Lines along the longest edges of a volume: those that lead away from the light, and some others. @return how many */
static size_t longest_edges(const struct scene_mesh *mesh, const double eye[16], struct line *lines)
{
	size_t n = 0;
	double longest;

	for (uint32_t i = 0; i < mesh->primitive_count; i++)
		for (int k = 0; k < 3; k++)
			n += (size_t)line_through(eye, mesh->position + 4 * mesh->index[3 * i + k],
			                          mesh->position + 4 * mesh->index[3 * i + (k + 1) % 3], &lines[n]);
	qsort(lines, n, sizeof(*lines), longer);
	longest = n ? lines[0].length : 0;
	while (n && !(lines[n - 1].length >= 0.5 * longest))
		n--;
	return n < MAX_LINES ? n : MAX_LINES;
}

/*
 * The distance of a line from a point over the distance of the point from the line's beginning: the sine of the angle
 * of error. `to` is homogeneous; w 0 is a direction.
 */
static double passes_by(const struct line *l, const double to[4])
{
	double way[3], along, square;

	for (int k = 0; k < 3; k++)
		way[k] = to[3] == 0 ? to[k] : to[k] - l->at[k];
	along = matrix_dot3(way, l->along);
	square = matrix_dot3(way, way);
	return square > 0 ? sqrt(fmax(0, square - along * along) / square) : 0;
}

/* The midpoint of the closest approach of two lines, or their direction if they are parallel. */
static void meet(const struct line *a, const struct line *b, double out[4])
{
	double ab = matrix_dot3(a->along, b->along), below = 1 - ab * ab, way[3], s;

	for (int k = 0; k < 3; k++)
		way[k] = b->at[k] - a->at[k];
	s = below > 1e-10 ? (matrix_dot3(way, a->along) - matrix_dot3(way, b->along) * ab) / below : 0;
	for (int k = 0; k < 3; k++)
		out[k] = below > 1e-10 ? a->at[k] + s * a->along[k] : a->along[k];
	out[3] = below > 1e-10;
}

/* The point nearest to all lines that pass close to it: least squares (normal equations, solved by Cramer's rule). */
static void refine(const struct line *lines, size_t n, double near, double light[4])
{
	double m[16] = { 0 }, right[4] = { 0 }, inverse[16];

	m[15] = 1;
	for (size_t i = 0; i < n; i++) {
		const struct line *l = &lines[i];

		if (passes_by(l, light) > near)
			continue;
		for (int r = 0; r < 3; r++)
			for (int c = 0; c < 3; c++) {
				double across = (r == c) - l->along[r] * l->along[c];

				m[4 * c + r] += across;
				right[r] += across * l->at[c];
			}
	}
	if (!matrix_invert(inverse, m))
		return;
	right[3] = 0;
	matrix_transform(light, inverse, right);
	light[3] = 1;
}

/* The point where most lines meet. @return how many do; 0: too few for a light */
static size_t find_light(const struct line *lines, size_t n, double light[4])
{
	const double near = 2e-3;
	uint32_t state = 12345;
	size_t best = 0, final = 0;

	for (int guess = 0; guess < GUESSES && n > 1; guess++) {
		double at[4];
		size_t meeting = 0;
		uint32_t a, b;

		state = state * 1664525u + 1013904223u;
		a = (state >> 8) % (uint32_t)n;
		state = state * 1664525u + 1013904223u;
		b = (state >> 8) % (uint32_t)n;
		meet(&lines[a], &lines[b], at);
		for (size_t i = 0; i < n; i++)
			meeting += passes_by(&lines[i], at) < near;
		if (meeting <= best)
			continue;
		best = meeting;
		memcpy(light, at, sizeof(at));
	}
	for (int round = 0; round < 3 && best && light[3] != 0; round++)
		refine(lines, n, near, light);
	for (size_t i = 0; i < n; i++)
		final += passes_by(&lines[i], light) < near;
	if (light[3] == 0 && lines[0].length < HUGE_VAL)
		return 0; /* the far end is unknown */
	return final >= LEAST_MEETING && 4 * final >= n ? final : 0;
}

/* Make a direction point towards the light: edges begin at outlines and lead away from it. */
static void face_light(const struct line *lines, size_t n, double light[4])
{
	double sum = 0;

	for (size_t i = 0; i < n; i++)
		sum += matrix_dot3(lines[i].along, light);
	for (int k = 0; k < 3 && sum > 0 && light[3] == 0; k++)
		light[k] = -light[k];
}

static int study_volume(struct tricks *t, const struct scene *s, const struct scene_instance *in, enum trick kind,
                        const struct motion *motion)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	struct line *lines = malloc((3 * (size_t)mesh->primitive_count + 1) * sizeof(*lines));
	struct trick_found what = { .kind = kind, .plane = { 0, 0, 0, 0 } };
	double eye[16], inverse[16], light[4] = { 0 };
	size_t n;

	if (!lines)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	matrix_from_floats(eye, in->modelview);
	n = longest_edges(mesh, eye, lines);
	if (find_light(lines, n, light) && matrix_invert(inverse, motion_now(motion)->eye_from_world)) {
		face_light(lines, n, light);
		what.has_opengl_light = flattened_is_lit(s, light, NULL);
		matrix_transform(what.light, inverse, light);
		what.light[3] = light[3]; /* the camera's position does not change an infinite distance */
		tricks_note(t, &what, motion->n_frames);
	}
	free(lines);
	return 0;
}

int volumes_add(struct tricks *t, const struct scene *s, const struct motion *motion)
{
	uint64_t last[2] = { 0, 0 };
	int err = 0, any = 0;

	for (uint32_t i = 0; i < s->n_instances && !err; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_material *m = &s->materials[in->material];
		enum trick kind = volume_of(m);

		any |= kind != N_TRICKS;
		t->darkenings += any && m->stencil_test && m->blend && !m->depth_test && (m->color_mask & 7);
		if (kind == N_TRICKS || s->meshes[in->mesh]->kind != SCENE_TRIANGLES ||
		    memcmp(last, s->meshes[in->mesh]->hash, sizeof(last)) == 0)
			continue; /* the same faces, from the other side */
		memcpy(last, s->meshes[in->mesh]->hash, sizeof(last));
		err = study_volume(t, s, in, kind, motion);
	}
	return err;
}
