#include "tracer/frame/place/perspective.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/mat4.h"
#include "kernels/camera/camera.h"
#include "kernels/gl/vertex_program.h"
#include "tracer/frame/common/frame.h"

#define LEAST_FACTOR 0.2 /* cotangent of half the field of view: 157 degrees */
#define MOST_FACTOR 20.0 /* 6 degrees */
#define MOST_W 1e15f /* nothing is drawn beyond */
#define MOST_ROUNDING 1e-5f /* rounding error of a depth, relative to its position's largest number */
#define USUAL_FACTOR 2.414213562 /* 45 degrees */

/* Measurements from the draws of one view of the scene. */
struct found {
	int perspective; /* 0: the view already has a perspective, or an instance in it is not displaced */
	float least_w, most_w; /* least and greatest w above 0 */
	double factor[2];      /* factors of x and y; 0: unknown */
	double sums[5]; /* sums of 1, w, w w, z and z w over all clip positions, each divided by the square of the
	                 * larger of its z and w */
	int is_bent;           /* 1: depths are not linear in w */
	uint32_t vertices;     /* vertices of the mesh that the factors are from */
};

/* Solve a x = b for three right-hand sides. @return 0: a is singular or nearly so */
static int solve(double a[4][4], double b[4][3])
{
	for (int col = 0; col < 4; col++) {
		int pivot = col;

		for (int row = col + 1; row < 4; row++)
			pivot = fabs(a[row][col]) > fabs(a[pivot][col]) ? row : pivot;
		if (!(fabs(a[pivot][col]) > 1e-6 * fabs(a[0][0])))
			return 0;
		for (int k = 0; k < 4; k++) {
			const double kept = a[col][k];

			a[col][k] = a[pivot][k];
			a[pivot][k] = kept;
		}
		for (int k = 0; k < 3; k++) {
			const double kept = b[col][k];

			b[col][k] = b[pivot][k];
			b[pivot][k] = kept;
		}
		for (int row = 0; row < 4; row++) {
			const double share = row == col ? 0 : a[row][col] / a[col][col];

			for (int k = 0; k < 4; k++)
				a[row][k] -= share * a[col][k];
			for (int k = 0; k < 3; k++)
				b[row][k] -= share * b[col][k];
		}
	}
	for (int row = 0; row < 4; row++)
		for (int k = 0; k < 3; k++)
			b[row][k] /= a[row][row];
	return 1;
}

static double length_of(const double b[4][3], int k)
{
	return sqrt(b[0][k] * b[0][k] + b[1][k] * b[1][k] + b[2][k] * b[2][k]);
}

/*
 * Find the factors from a mesh transformed by a single matrix: a rotation, a uniform scale and a translation, then the
 * projection. The lengths of the matrix's rows for x, y and w are then the two factors and 1, all times the scale.
 */
static void find_factors(const struct scene_mesh *mesh, const float (*clip)[4], struct found *f)
{
	static const int parts[3] = { 0, 1, 3 };
	double a[4][4] = { { 0 } }, b[4][3] = { { 0 } }, x, y;

	if (mesh->vertex_count <= f->vertices)
		return;
	for (uint32_t v = 0; v < mesh->vertex_count; v++)
		for (int row = 0; row < 4; row++) {
			for (int k = 0; k < 4; k++)
				a[row][k] += (double)mesh->position[4 * (size_t)v + (size_t)row] *
				             mesh->position[4 * (size_t)v + (size_t)k];
			for (int k = 0; k < 3; k++)
				b[row][k] += (double)mesh->position[4 * (size_t)v + (size_t)row] * clip[v][parts[k]];
		}
	if (!solve(a, b))
		return; /* the mesh is flat */
	for (uint32_t v = 0; v < mesh->vertex_count; v++)
		for (int k = 0; k < 3; k++) {
			const float *p = mesh->position + 4 * (size_t)v;
			const double at = b[0][k] * p[0] + b[1][k] * p[1] + b[2][k] * p[2] + b[3][k] * p[3];

			if (!(fabs(at - clip[v][parts[k]]) <= 1e-3 * (fabs((double)clip[v][3]) + 1e-6)))
				return; /* not transformed by a single matrix */
		}
	x = length_of((const double (*)[3])b, 0) / length_of((const double (*)[3])b, 2);
	y = length_of((const double (*)[3])b, 1) / length_of((const double (*)[3])b, 2);
	if (!(x > LEAST_FACTOR && x < MOST_FACTOR && y > LEAST_FACTOR && y < MOST_FACTOR))
		return;
	f->factor[0] = x;
	f->factor[1] = y;
	f->vertices = mesh->vertex_count;
}

/* Read the clip positions of a prepared instance; the caller frees them. */
static int read_clips(const struct frame *frame, uint32_t i, float (**clip)[4])
{
	const struct geometry *g = &frame->prepared.geometries[i];

	*clip = calloc((size_t)g->vertex_count + 1, sizeof(**clip));
	if (!*clip)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	return device_read(frame->tr->dev, frame->tr->placed.clips.buffer, g->vertex_first * sizeof(**clip), *clip,
	                   g->vertex_count * sizeof(**clip));
}

/* Add a vertex to the sums for a linear fit of depth as a function of w. */
static void add_depth(const float clip[4], double sums[5])
{
	const double z = (double)clip[2], w = (double)clip[3], largest = fmax(fabs(z), fabs(w)),
		     share = 1 / (largest * largest);

	if (!(largest > 0 && largest < (double)MOST_W))
		return;
	sums[0] += share;
	sums[1] += share * w;
	sums[2] += share * w * w;
	sums[3] += share * z;
	sums[4] += share * z * w;
}

static int look_at(const struct frame *frame, uint32_t i, struct found *f)
{
	const struct prepared *p = &frame->prepared;
	const struct geometry *g = &p->geometries[i];
	const struct scene_mesh *mesh =
		frame->scene->meshes[frame->scene->instances[p->instances[i].scene_instance].mesh];
	float (*clip)[4];
	int err = read_clips(frame, i, &clip);

	for (uint32_t v = 0; v < g->vertex_count && !err; v++) {
		add_depth(clip[v], f->sums);
		if (clip[v][3] > 0 && clip[v][3] < MOST_W) {
			f->least_w = fminf(f->least_w, clip[v][3]);
			f->most_w = fmaxf(f->most_w, clip[v][3]);
		}
	}
	if (!err)
		find_factors(mesh, (const float (*)[4])clip, f);
	free(clip);
	return err;
}

/*
 * If depths are linear in w and grow with it, use them in the projection: it then clips at the program's near and far
 * planes. Otherwise the projection's depths are arbitrary and start right at the eye, and columns find which fragment
 * is in front (perspective_check_depths).
 */
static void make_depths(const struct found *f, float out[16])
{
	const double *s = f->sums, all = s[0] * s[2] - s[1] * s[1];
	const double slope = (s[0] * s[4] - s[1] * s[3]) / all, first = (s[2] * s[3] - s[1] * s[4]) / all;
	const int grows = all > 0 && slope > -1 && first < 0 && !f->is_bent;

	out[10] = grows ? (float)-slope : -1;
	out[14] = grows ? (float)first : -1e-6f * f->least_w;
}

static void make_projection(const struct scene_view *view, const struct found *f, float out[16])
{
	const double width = view->viewport[2], height = view->viewport[3];

	memset(out, 0, 16 * sizeof(*out));
	out[0] = (float)(f->vertices ? f->factor[0] : USUAL_FACTOR * height / width);
	out[5] = (float)(f->vertices ? f->factor[1] : USUAL_FACTOR);
	out[11] = -1;
	make_depths(f, out);
}

/* Find the views of the scene that have no perspective and are drawn only by programs. */
static void find_views(const struct frame *frame, struct found *found)
{
	const struct scene *s = frame->scene;
	const struct prepared *p = &frame->prepared;

	for (uint32_t v = 0; v < s->n_views; v++) {
		const float *m = s->views[v].projection;

		found[v] = (struct found){ .perspective = m[3] == 0 && m[7] == 0 && m[11] == 0 &&
			                                  s->views[v].viewport[2] > 0,
			                   .least_w = FLT_MAX };
	}
	for (uint32_t i = 0; i < p->n_instances; i++)
		found[s->instances[p->instances[i].scene_instance].view].perspective &=
			prepare_is_displaced(s, &s->instances[p->instances[i].scene_instance]);
}

/* 1 if a clip position's depth differs from the projection's depth at the same x, y and w. */
static int has_own_depth(const struct view *view, const float clip[4])
{
	const float *m = view->projection;
	const struct vec4 at = v4_load(clip), eye = vertex_eye_from_clip(view, at);
	const float depth = m[2] * eye.x + m[6] * eye.y + m[10] * eye.z + m[14] * eye.w;
	const float largest = fmaxf(fmaxf(fabsf(at.x), fabsf(at.y)), fmaxf(fabsf(at.z), fabsf(at.w)));

	return !(fabsf(depth - at.z) <= MOST_ROUNDING * largest);
}

/* Check the depths of a prepared instance. *own: set if one differs from the projection's */
static int look_at_depths(const struct frame *frame, uint32_t i, int *own)
{
	const struct prepared *p = &frame->prepared;
	const struct geometry *g = &p->geometries[i];
	const struct scene_instance *from = &frame->scene->instances[p->instances[i].scene_instance];
	const struct view *view = &p->views[g->view];
	float (*clip)[4];
	int err;

	if (!prepare_is_displaced(frame->scene, from))
		return 0;
	err = read_clips(frame, i, &clip);
	for (uint32_t v = 0; v < g->vertex_count && !err && !*own; v++)
		*own = has_own_depth(view, clip[v]);
	free(clip);
	return err;
}

/* 1 if a view is given a perspective. */
static int is_given(const struct found *f)
{
	return f->perspective && f->most_w > 1.001f * f->least_w;
}

/* @return 1 if any view is given a perspective */
static int give_projections(struct frame *frame, const struct found *found)
{
	const struct scene *s = frame->scene;
	struct prepared *p = &frame->prepared;
	int given = 0;

	for (uint32_t i = 0; i < p->n_instances; i++) {
		const uint32_t from = s->instances[p->instances[i].scene_instance].view, to = p->geometries[i].view;

		if (!is_given(&found[from]))
			continue;
		make_projection(&s->views[from], &found[from], p->views[to].projection);
		memcpy(p->scene_views[to].projection, p->views[to].projection, sizeof(p->views[to].projection));
		given |= mat4_invert(p->views[to].inverse, p->views[to].projection);
	}
	return given;
}

int perspective_find(struct frame *frame, int *changed)
{
	const struct scene *s = frame->scene;
	const struct prepared *p = &frame->prepared;
	struct found *found = calloc((size_t)s->n_views + 1, sizeof(*found));
	int err = 0;

	*changed = 0;
	if (!found)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	find_views(frame, found);
	for (uint32_t i = 0; i < p->n_instances && !err; i++) {
		struct found *f = &found[s->instances[p->instances[i].scene_instance].view];

		if (f->perspective)
			err = look_at(frame, i, f);
	}
	if (!err)
		*changed = give_projections(frame, found);
	for (uint32_t i = 0; i < p->n_instances && !err && *changed; i++) {
		struct found *f = &found[s->instances[p->instances[i].scene_instance].view];

		if (is_given(f))
			err = look_at_depths(frame, i, &f->is_bent);
	}
	if (!err && *changed)
		give_projections(frame, found);
	free(found);
	return err;
}

int perspective_check_depths(struct frame *frame)
{
	struct prepared *p = &frame->prepared;
	int err = 0;

	for (uint32_t k = 0; k < p->n_segments && !err; k++) {
		struct segment *segment = &p->segments[k];
		int own = 0;

		for (uint32_t i = 0; i < segment->instance_count && segment->mode != CAMERA_COLUMN && !err && !own; i++)
			err = look_at_depths(frame, segment->instance_first + i, &own);
		if (own)
			segment->mode = CAMERA_COLUMN;
	}
	return err;
}
