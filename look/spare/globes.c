#include "look/spare/globes.h"

#include <math.h>
#include <string.h>

#include "base/mat4.h"
#include "base/vec3.h"
#include "look/draws/corner.h"
#include "look/draws/modelview.h"
#include "look/spare/blockers.h"
#include "look/spare/sides.h"

#define HALF_TURN 3.14159265358979
/* A place is inside a body if the winding number there is nearer to 1 than to 0. */
#define INSIDE 0.5
/* A triangle seen edge-on may seem to show either side: because of rounding, it covers up to this share of all
 * directions. */
#define EDGE_ON 1e-6

/* A triangle in eye space; its corners run counterclockwise seen from the side that it shows. */
struct facet {
	double corner[3][3];
};

/* A triangle with its visible side outwards. */
static struct facet facet_of(const struct scene *s, const struct scene_instance *in, struct sides sides,
                             uint32_t primitive, int mirrors)
{
	const struct sides wound = { SIDES_BOTH, 0 };
	double counter_clockwise[3], shown[3];
	struct facet f;
	int turned;

	for (unsigned c = 0; c < 3; c++) {
		float eye[4];

		mat4_transform(eye, in->modelview, corner_place(s->meshes[in->mesh], primitive, c));
		for (int k = 0; k < 3; k++)
			f.corner[c][k] = eye[k];
	}
	sides_towards(s, in, wound, primitive, counter_clockwise);
	sides_towards(s, in, sides, primitive, shown);
	turned = (vec3_dot(counter_clockwise, shown) < 0) != mirrors;
	for (int k = 0; k < 3 && turned; k++) {
		const double swapped = f.corner[1][k];

		f.corner[1][k] = f.corner[2][k];
		f.corner[2][k] = swapped;
	}
	return f;
}

/*
 * The solid angle of a triangle seen from a place, as a share of all directions, positive if its back is seen (van
 * Oosterom and Strackee 1983, equation 8).
 */
static double share_around(const struct facet *f, const double place[3])
{
	double r[3][3], length[3], across[3], beside;

	for (int c = 0; c < 3; c++) {
		for (int k = 0; k < 3; k++)
			r[c][k] = f->corner[c][k] - place[k];
		length[c] = sqrt(vec3_dot(r[c], r[c]));
	}
	vec3_cross(r[1], r[2], across);
	beside = length[0] * length[1] * length[2] + vec3_dot(r[0], r[1]) * length[2] + vec3_dot(r[1], r[2]) * length[0] +
	         vec3_dot(r[2], r[0]) * length[1];
	return atan2(vec3_dot(r[0], across), beside) / (2 * HALF_TURN);
}

/*
 * 1 if no visible side of an instance can be seen from a place. @param share, viewers  receive the share of all
 * directions that it covers, seen from there and from the viewer
 */
static int shows_back(const struct scene *s, const struct scene_instance *in, const double place[3], double *share,
                      double *viewers)
{
	const int mirrors = modelview_kind_of(in->modelview) == MODELVIEW_MIRRORED;
	const struct sides sides = sides_of(s, in);

	*share = *viewers = 0;
	for (uint32_t i = 0; i < s->meshes[in->mesh]->primitive_count; i++) {
		const struct facet f = facet_of(s, in, sides, i, mirrors);
		const double part = share_around(&f, place);

		if (!(part > -EDGE_ON))
			return 0;
		*share += part;
		*viewers += share_around(&f, (const double[3]){ 0, 0, 0 });
	}
	return 1;
}

/* Parts that are drawn one after another. */
struct body {
	uint32_t first;
	double around, around_viewer;
};

/* Mark a body that ends before instance `end`, if it is complete. @return the number of instances marked */
static uint32_t mark(const struct scene *s, const struct blockers *b, const struct body *body, uint32_t end,
                     uint32_t *bits)
{
	uint32_t n = 0;

	if (!(body->around > INSIDE) || body->around_viewer > INSIDE)
		return 0;
	for (uint32_t i = body->first; i < end; i++) {
		if (!blockers_has(b, i) || sides_of(s, &s->instances[i]).shown != SIDES_BOTH)
			continue;
		bits[i] |= SCENE_HIDDEN_FROM_LIGHTS;
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
