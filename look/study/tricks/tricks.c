#include "look/study/tricks/tricks.h"

#include <math.h>
#include <string.h>

#include "look/spare/flattened.h"

/* Tolerance for the same light or plane; lights of one level are further apart. */
#define SAME 0.01

static double planes_apart(const double a[4], const double b[4])
{
	double off = 0;

	for (int k = 0; k < 3; k++)
		off += (a[k] - b[k]) * (a[k] - b[k]);
	return fmax(sqrt(off), fabs(a[3] - b[3]) / (1 + fabs(a[3])));
}

/* Update the mean of all observations. */
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
	return a->kind == b->kind && (b->kind == TRICK_MIRROR || !(flattened_apart(a->light, b->light) > SAME)) &&
	       !(planes_apart(a->plane, b->plane) > SAME);
}

struct trick_found *tricks_note(struct tricks *t, const struct trick_found *said, uint64_t frame)
{
	struct trick_found *f = t->found, turned = *said;
	const struct trick_found *what = said;

	for (int k = 0; k < 4; k++)
		turned.plane[k] = -said->plane[k];
	for (; f < t->found + t->n && !is_same_trick(f, said); f++)
		if (said->kind == TRICK_MIRROR && is_same_trick(f, &turned)) {
			what = &turned; /* the same plane, seen from its other side */
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
		if (t->found[k].kind == f->kind && t->found[k].votes > 4 * f->votes &&
		    planes_apart(t->found[k].plane, f->plane) < SAME)
			return 1;
	return 0;
}
