#include "look/study/tricks.h"

#include <math.h>
#include <string.h>

#include "look/modelview.h"
#include "look/solid.h"
#include "look/study/matrix.h"

/* The same light or plane, said twice: lights of one level are farther from each other. */
#define SAME 0.01

/* How far apart two lights are, over how far they are from the origin; of directions the angle. */
static double apart(const double a[4], const double b[4])
{
	double off = 0, far = 0;

	if ((a[3] == 0) != (b[3] == 0))
		return HUGE_VAL;
	for (int k = 0; k < 3; k++) {
		off += (a[k] - b[k]) * (a[k] - b[k]);
		far += a[k] * a[k];
	}
	return sqrt(off) / (a[3] == 0 ? 1 : 1 + sqrt(far));
}

static double planes_apart(const double a[4], const double b[4])
{
	double off = 0;

	for (int k = 0; k < 3; k++)
		off += (a[k] - b[k]) * (a[k] - b[k]);
	return fmax(sqrt(off), fabs(a[3] - b[3]) / (1 + fabs(a[3])));
}

/* The mean of all that was said so far. */
static void take_in(struct trick_found *f, const struct trick_found *what)
{
	double length = 0;

	for (int k = 0; k < 4; k++) {
		f->light[k] += (what->light[k] - f->light[k]) / (f->votes + 1);
		f->plane[k] += (what->plane[k] - f->plane[k]) / (f->votes + 1);
	}
	for (int k = 0; k < 3; k++)
		length += f->plane[k] * f->plane[k];
	for (int k = 0; k < 4 && length > 0; k++)
		f->plane[k] /= sqrt(length);
}

static int is_same_trick(const struct trick_found *a, const struct trick_found *b)
{
	return a->kind == b->kind && (b->kind == TRICK_MIRROR || !(apart(a->light, b->light) > SAME)) && !(planes_apart(a->plane, b->plane) > SAME);
}

struct trick_found *tricks_note(struct tricks *t, const struct trick_found *said, uint64_t frame)
{
	struct trick_found *f = t->found, turned = *said;
	const struct trick_found *what = said;

	for (int k = 0; k < 4; k++)
		turned.plane[k] = -said->plane[k];
	for (; f < t->found + t->n && !is_same_trick(f, said); f++)
		if (said->kind == TRICK_MIRROR && is_same_trick(f, &turned)) {
			what = &turned; /* seen from its other side */
			break;
		}
	if (f == t->found + TRICKS_MAX)
		return NULL;
	if (f == t->found + t->n) {
		*f = *what;
		f->votes = f->frames = 0;
		f->last = 0;
		t->n++;
	}
	take_in(f, what);
	f->votes++;
	f->frames += f->last != frame;
	f->last = frame;
	f->has_opengl_light |= what->has_opengl_light;
	f->stencil |= what->stencil;
	return f;
}

int tricks_is_outvoted(const struct tricks *t, unsigned i)
{
	const struct trick_found *f = &t->found[i];

	for (unsigned k = 0; k < t->n && f->kind == TRICK_PLANAR_SHADOW; k++)
		if (t->found[k].kind == f->kind && t->found[k].votes > 4 * f->votes && planes_apart(t->found[k].plane, f->plane) < SAME)
			return 1;
	return 0;
}

/* 1 where a material is lit by a light of OpenGL's at a place of eye space. */
static int is_lit_from(const struct scene *s, const struct scene_material *m, const double eye[4])
{
	for (uint32_t k = 0; m->lighting && k < m->light_count; k++) {
		const float *at = s->lights[m->light_first + k].position_eye;
		double w = at[3] != 0 ? (double)at[3] : sqrt((double)(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]));
		double there[4] = { (double)at[0] / w, (double)at[1] / w, (double)at[2] / w, at[3] != 0 };

		if (apart(eye, there) < SAME)
			return 1;
	}
	return 0;
}

/* 1 where a triangle of a mesh lies in a plane of eye space, or a little beside it. */
static int touches(const struct scene *s, const struct scene_instance *in, const double plane[4])
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	double eye[16];

	matrix_from_floats(eye, in->modelview);
	for (uint32_t i = 0, run = 0; i < 3 * mesh->primitive_count; i++) {
		const float *p = mesh->position + 4 * mesh->index[i];
		double at[3];

		matrix_point(at, eye, (double[3]){ (double)p[0], (double)p[1], (double)p[2] });
		run = i % 3 ? run : 0;
		run += fabs(plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2] + plane[3]) <=
		       0.01 * (1 + fabs(at[0]) + fabs(at[1]) + fabs(at[2]));
		if (run == 3)
			return 1;
	}
	return 0;
}

int tricks_opengl_lights(const struct scene *s, const double light[4], const double *plane)
{
	uint32_t lit = 0, all = 0;

	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_material *m = &s->materials[in->material];

		if (!solid_is(s, in) || modelview_kind_of(in->modelview) != MODELVIEW_PLAIN || (plane && !touches(s, in, plane)))
			continue;
		all++;
		lit += (uint32_t)is_lit_from(s, m, light);
	}
	return 2 * lit > all;
}
