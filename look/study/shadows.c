#include "look/study/shadows.h"

#include <math.h>
#include <string.h>

#include "look/modelview.h"
#include "look/study/matrix.h"
#include "look/study/pairs.h"

static void turn(double v[4], int n)
{
	for (int k = 0; k < n; k++)
		v[k] = -v[k];
}

/* A plane shows its lit side: to the light; of a direction, which is known but for its sign, to the viewer. */
static void orient(double light[4], double plane[4])
{
	double along = 0;

	if (light[3] == 0 && plane[3] < 0)
		turn(plane, 4);
	for (int k = 0; k < 4; k++)
		along += plane[k] * light[k];
	if (along < 0 && light[3] == 0)
		turn(light, 3);
	else if (along < 0)
		turn(plane, 4);
}

/* What the flattening matrix says, in eye space; @return 0: it is none of a shadow */
static int read_matrix(const double from_upright[16], double light[4], double plane[4])
{
	double length, along = 0;

	if (matrix_null(light, from_upright, 0) > 1e-3 || matrix_null(plane, from_upright, 1) > 1e-3)
		return 0;
	length = sqrt(light[0] * light[0] + light[1] * light[1] + light[2] * light[2]);
	if (fabs(light[3]) < 1e-6 * length)
		light[3] = 0;
	length = light[3] != 0 ? light[3] : length;
	for (int k = 0; k < 4; k++)
		light[k] /= length;
	length = sqrt(plane[0] * plane[0] + plane[1] * plane[1] + plane[2] * plane[2]);
	if (!(length > 1e-9))
		return 0;
	for (int k = 0; k < 4; k++) {
		plane[k] /= length;
		along += plane[k] * light[k];
	}
	orient(light, plane);
	return fabs(along) > 1e-9;
}

static void into_world(const struct motion_camera *camera, double light[4], double plane[4])
{
	double inverse[16], out[4];

	if (!matrix_invert(inverse, camera->eye_from_world))
		return;
	matrix_transform(out, inverse, light);
	memcpy(light, out, 3 * sizeof(*out)); /* the camera neither brings near nor takes away what is infinitely far */
	for (int c = 0; c < 4; c++) {
		out[c] = 0;
		for (int r = 0; r < 4; r++)
			out[c] += plane[r] * camera->eye_from_world[4 * c + r];
	}
	memcpy(plane, out, sizeof(out));
}

/* One flat draw beside the draws of the same mesh as it is: what most of all say is true, and tricks_note counts. */
static void study_flat(struct tricks *t, const struct scene *s, const struct pairs *pairs, uint32_t flat, const struct motion *motion)
{
	uint32_t upright = pairs_find(pairs, s, flat, MODELVIEW_PLAIN);
	double shadow[16];

	t->unmatched += upright == SCENE_NONE;
	matrix_from_floats(shadow, s->instances[flat].modelview);
	for (int tries = 0; upright != SCENE_NONE && tries < 4; upright = pairs->next[upright], tries++) {
		struct trick_found what = { .kind = TRICK_PLANAR_SHADOW };
		double eye[16], inverse[16], from_upright[16];

		matrix_from_floats(eye, s->instances[upright].modelview);
		if (!matrix_invert(inverse, eye))
			continue;
		matrix_mul(from_upright, shadow, inverse);
		if (!read_matrix(from_upright, what.light, what.plane))
			continue;
		what.stencil = !(s->materials[s->instances[flat].material].color_mask & 7);
		what.has_opengl_light = tricks_opengl_lights(s, what.light, what.plane);
		into_world(motion_now(motion), what.light, what.plane);
		tricks_note(t, &what, motion->n_frames);
	}
}

int shadows_add(struct tricks *t, const struct scene *s, const struct motion *motion)
{
	struct pairs pairs = { .next = NULL };
	int flat = 0, err = 0;

	for (uint32_t i = 0; i < s->n_instances && !flat; i++)
		flat = modelview_kind_of(s->instances[i].modelview) == MODELVIEW_SINGULAR;
	if (flat)
		err = pairs_make(&pairs, s);
	for (uint32_t i = 0; i < s->n_instances && flat && !err; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_material *m = &s->materials[in->material];

		if (s->meshes[in->mesh]->kind == SCENE_TRIANGLES && !in->rectangle && (m->color_mask & 7 ? !m->lighting : m->stencil_test) &&
		    modelview_kind_of(in->modelview) == MODELVIEW_SINGULAR)
			study_flat(t, s, &pairs, i, motion);
	}
	pairs_free(&pairs);
	return err;
}
