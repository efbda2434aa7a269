#include "look/globes.h"

#include <math.h>
#include <string.h>

#include "base/mat4.h"
#include "gl_tokens.h"
#include "look/blockers.h"
#include "look/modelview.h"

#define HALF_TURN 3.14159265358979
/* A place is within a body whose winding number about it is nearer to 1 than to 0. */
#define INSIDE 0.5
/* A triangle that is seen edge-on may seem to show either side: by rounding, it fills so much of all directions. */
#define EDGE_ON 1e-6

/* A triangle in eye space, and the side that it shows: its corners run counter-clockwise there. */
struct facet {
	double corner[3][3];
};

static void cross(const double a[3], const double b[3], double out[3])
{
	for (int k = 0; k < 3; k++)
		out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* 1 where normals say which side OpenGL lights; they may be there without lighting, too. */
static int has_side(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];

	return (m->lighting || s->meshes[in->mesh]->normal) && !m->two_side;
}

/* 1 where a triangle's back is the side that is shown. mirrors: 1 where the modelview does */
static int is_turned(const struct scene *s, const struct scene_instance *in, uint32_t primitive, const double normal[3],
                     int mirrors)
{
	const struct scene_material *m = &s->materials[in->material];
	const int by_winding = (m->front_face == GL_CW) ^ mirrors;
	double sum = 0;

	if (m->cull_face == GL_FRONT || m->cull_face == GL_BACK)
		return (m->cull_face == GL_FRONT) ^ by_winding;
	if (!has_side(s, in))
		return by_winding;
	for (unsigned c = 0; c < 3; c++) {
		const float *n = blockers_normal(s, in, primitive, c);

		sum += n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2];
	}
	return sum < 0;
}

/* A triangle with its shown side outwards. mirrors: 1 where the modelview does */
static struct facet facet_of(const struct scene *s, const struct scene_instance *in, uint32_t primitive, int mirrors)
{
	double object[3][3], edge[2][3], normal[3];
	struct facet f;
	int turned;

	for (unsigned c = 0; c < 3; c++) {
		const float *at = blockers_corner(s->meshes[in->mesh], primitive, c);
		float eye[4];

		mat4_transform(eye, in->modelview, at);
		for (int k = 0; k < 3; k++) {
			object[c][k] = at[k];
			f.corner[c][k] = eye[k];
		}
	}
	for (int k = 0; k < 3; k++) {
		edge[0][k] = object[1][k] - object[0][k];
		edge[1][k] = object[2][k] - object[0][k];
	}
	cross(edge[0], edge[1], normal);
	turned = is_turned(s, in, primitive, normal, mirrors) != mirrors;
	for (int k = 0; k < 3 && turned; k++) {
		const double swapped = f.corner[1][k];

		f.corner[1][k] = f.corner[2][k];
		f.corner[2][k] = swapped;
	}
	return f;
}

/*
 * The solid angle that a triangle fills seen from a place, positive where its back is seen, as a share of all
 * directions (van Oosterom and Strackee 1983, equation 8).
 */
static double share_around(const struct facet *f, const double place[3])
{
	double r[3][3], length[3], across[3], beside;

	for (int c = 0; c < 3; c++) {
		for (int k = 0; k < 3; k++)
			r[c][k] = f->corner[c][k] - place[k];
		length[c] = sqrt(dot(r[c], r[c]));
	}
	cross(r[1], r[2], across);
	beside = length[0] * length[1] * length[2] + dot(r[0], r[1]) * length[2] + dot(r[1], r[2]) * length[0] +
	         dot(r[2], r[0]) * length[1];
	return atan2(dot(r[0], across), beside) / (2 * HALF_TURN);
}

/*
 * 1 where a place sees no side of an instance that is shown. share, viewers: receive how much of all directions it
 * fills from there, and from the viewer's place
 */
static int shows_back(const struct scene *s, const struct scene_instance *in, const double place[3], double *share,
                      double *viewers)
{
	const int mirrors = modelview_kind_of(in->modelview) == MODELVIEW_MIRRORED;

	*share = *viewers = 0;
	for (uint32_t i = 0; i < s->meshes[in->mesh]->primitive_count; i++) {
		const struct facet f = facet_of(s, in, i, mirrors);
		const double part = share_around(&f, place);

		if (!(part > -EDGE_ON))
			return 0;
		*share += part;
		*viewers += share_around(&f, (const double[3]){ 0, 0, 0 });
	}
	return 1;
}

/* Parts that follow each other in the order of drawing. */
struct body {
	uint32_t first;
	double around, around_viewer;
};

/* Mark a body that is complete with instance end - 1. @return how many instances */
static uint32_t mark(const struct scene *s, const struct blockers *b, const struct body *body, uint32_t end,
                     uint32_t *bits)
{
	uint32_t n = 0;

	if (!(body->around > INSIDE) || body->around_viewer > INSIDE)
		return 0;
	for (uint32_t i = body->first; i < end; i++) {
		if (!blockers_has(b, i))
			continue;
		bits[i] |= has_side(s, &s->instances[i]) ? SCENE_ONE_SIDED : SCENE_HIDDEN_FROM_LIGHTS;
		n++;
	}
	return n;
}

uint32_t globes_find(const struct scene *scene, const struct blockers *blockers, const float position[4],
                     uint32_t space, uint32_t *bits)
{
	const double place[3] = { position[0] / position[3], position[1] / position[3], position[2] / position[3] };
	struct body body = { 0, 0, 0 };
	uint32_t n = 0;

	if (position[3] == 0)
		return 0;
	for (uint32_t i = 0; i < scene->n_instances; i++) {
		const struct scene_instance *in = &scene->instances[i];
		double share, viewers;

		if (!blockers_has(blockers, i))
			continue;
		if (scene->views[in->view].space == space && shows_back(scene, in, place, &share, &viewers)) {
			body.around += share;
			body.around_viewer += viewers;
			continue;
		}
		n += mark(scene, blockers, &body, i, bits);
		body = (struct body){ i + 1, 0, 0 };
	}
	return n + mark(scene, blockers, &body, scene->n_instances, bits);
}
