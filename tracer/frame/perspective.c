#include "tracer/frame/perspective.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/mat4.h"
#include "kernels/camera/camera.h"
#include "kernels/gl/vertex_program.h"
#include "tracer/frame/frame.h"

#define LEAST_FACTOR 0.2 /* cotangents of half the angle that a picture spans: 157 degrees, */
#define MOST_FACTOR 20.0 /* 6 */
#define MOST_W 1e15f /* beyond that nothing is drawn */
#define MOST_ROUNDING 1e-5f /* of a depth, as a share of its position's largest number */
#define USUAL_FACTOR 2.414213562 /* 45 degrees */

/* What the draws of a view of the scene tell. */
struct found {
	int perspective; /* 0: the view has a perspective already, or something in it is not displaced */
	float least_w, most_w; /* those above 0 */
	double factor[2];      /* of x and y; 0: not known */
	double sums[5]; /* of 1, w, w w, z and z w of all clip positions, each by the square of its larger number of the
	                   two */
	int is_bent;           /* depths are not linear in w */
	uint32_t vertices;     /* of the mesh that they are of */
};

/* Solve a x = b for three right sides. @return 0: there is no solution, or hardly one */
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
 * The factors of a mesh that one matrix has moved: a turn, one scale and a shift, then the projection. Its rows for x,
 * y and w are then as long as the factors, and 1, times the scale.
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
				a[row][k] += (double)mesh->position[4 * (size_t)v + (size_t)row] * mesh->position[4 * (size_t)v + (size_t)k];
			for (int k = 0; k < 3; k++)
				b[row][k] += (double)mesh->position[4 * (size_t)v + (size_t)row] * clip[v][parts[k]];
		}
	if (!solve(a, b))
		return; /* flat */
	for (uint32_t v = 0; v < mesh->vertex_count; v++)
		for (int k = 0; k < 3; k++) {
			const float *p = mesh->position + 4 * (size_t)v;
			const double at = b[0][k] * p[0] + b[1][k] * p[1] + b[2][k] * p[2] + b[3][k] * p[3];

			if (!(fabs(at - clip[v][parts[k]]) <= 1e-3 * (fabs((double)clip[v][3]) + 1e-6)))
				return; /* it is bent */
		}
	x = length_of((const double (*)[3])b, 0) / length_of((const double (*)[3])b, 2);
	y = length_of((const double (*)[3])b, 1) / length_of((const double (*)[3])b, 2);
	if (!(x > LEAST_FACTOR && x < MOST_FACTOR && y > LEAST_FACTOR && y < MOST_FACTOR))
		return;
	f->factor[0] = x;
	f->factor[1] = y;
	f->vertices = mesh->vertex_count;
}

/* The clip positions of a prepared instance; the caller frees them. */
static int read_clips(const struct job *job, uint32_t i, float (**clip)[4])
{
	const struct geometry *g = &job->prepared.geometries[i];

	*clip = calloc((size_t)g->vertex_count + 1, sizeof(**clip));
	if (!*clip)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	return device_read(job->tr->dev, job->tr->buffers.clips.buffer, g->vertex_first * sizeof(**clip), *clip,
	                   g->vertex_count * sizeof(**clip));
}

/* Sums by which depths are found as numbers that are linear in w. */
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

static int look_at(const struct job *job, uint32_t i, struct found *f)
{
	const struct prepared *p = &job->prepared;
	const struct geometry *g = &p->geometries[i];
	const struct scene_mesh *mesh = job->scene->meshes[job->scene->instances[p->instances[i].scene_instance].mesh];
	float (*clip)[4];
	int err = read_clips(job, i, &clip);

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
 * Depths that are linear in w and grow with it are the projection's: they cut off what is nearer than the program's own
 * plane, and what lies behind what is drawn. Of others it has none; from the eye on all is there, and columns tell what
 * lies before what (perspective_check_depths).
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

/* Which views of the scene are drawn in by programs alone, and have no perspective. */
static void find_views(const struct job *job, struct found *found)
{
	const struct scene *s = job->scene;
	const struct prepared *p = &job->prepared;

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

/* 1 where a clip position's depth is not the one that the projection gives what has its x, y and w. */
static int has_own_depth(const struct view *view, const float clip[4])
{
	const float *m = view->projection;
	const struct vec4 at = v4_load(clip), eye = vertex_eye_from_clip(view, at);
	const float depth = m[2] * eye.x + m[6] * eye.y + m[10] * eye.z + m[14] * eye.w;
	const float largest = fmaxf(fmaxf(fabsf(at.x), fabsf(at.y)), fmaxf(fabsf(at.z), fabsf(at.w)));

	return !(fabsf(depth - at.z) <= MOST_ROUNDING * largest);
}

/* *own: set where a prepared instance has such a depth */
static int look_at_depths(const struct job *job, uint32_t i, int *own)
{
	const struct prepared *p = &job->prepared;
	const struct geometry *g = &p->geometries[i];
	const struct scene_instance *from = &job->scene->instances[p->instances[i].scene_instance];
	const struct view *view = &p->views[g->view];
	float (*clip)[4];
	int err;

	if (!prepare_is_displaced(job->scene, from))
		return 0;
	err = read_clips(job, i, &clip);
	for (uint32_t v = 0; v < g->vertex_count && !err && !*own; v++)
		*own = has_own_depth(view, clip[v]);
	free(clip);
	return err;
}

/* Whether a view is given a perspective. */
static int is_given(const struct found *f)
{
	return f->perspective && f->most_w > 1.001f * f->least_w;
}

/* @return whether any is given */
static int give_projections(struct job *job, const struct found *found)
{
	const struct scene *s = job->scene;
	struct prepared *p = &job->prepared;
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

int perspective_find(struct job *job, int *changed)
{
	const struct scene *s = job->scene;
	const struct prepared *p = &job->prepared;
	struct found *found = calloc((size_t)s->n_views + 1, sizeof(*found));
	int err = 0;

	*changed = 0;
	if (!found)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	find_views(job, found);
	for (uint32_t i = 0; i < p->n_instances && !err; i++) {
		struct found *f = &found[s->instances[p->instances[i].scene_instance].view];

		if (f->perspective)
			err = look_at(job, i, f);
	}
	if (!err)
		*changed = give_projections(job, found);
	for (uint32_t i = 0; i < p->n_instances && !err && *changed; i++) {
		struct found *f = &found[s->instances[p->instances[i].scene_instance].view];

		if (is_given(f))
			err = look_at_depths(job, i, &f->is_bent);
	}
	if (!err && *changed)
		give_projections(job, found);
	free(found);
	return err;
}

int perspective_check_depths(struct job *job)
{
	struct prepared *p = &job->prepared;
	int err = 0;

	for (uint32_t k = 0; k < p->n_segments && !err; k++) {
		struct segment *segment = &p->segments[k];
		int own = 0;

		for (uint32_t i = 0; i < segment->instance_count && segment->mode != CAMERA_COLUMN && !err && !own; i++)
			err = look_at_depths(job, segment->instance_first + i, &own);
		if (own)
			segment->mode = CAMERA_COLUMN;
	}
	return err;
}
