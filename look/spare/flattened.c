#include "look/spare/flattened.h"

#include <math.h>
#include <string.h>

#include "base/err.h"
#include "look/draws/matrix.h"
#include "look/draws/modelview.h"
#include "look/draws/pairs.h"
#include "look/draws/solid.h"

/* Tolerance for the same light; lights of one level are further apart. */
#define SAME 0.01

double flattened_apart(const double a[4], const double b[4])
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

static void turn(double v[4], int n)
{
	for (int k = 0; k < n; k++)
		v[k] = -v[k];
}

/* Orient a plane towards the light. A direction is known only up to its sign; the plane then faces the viewer. */
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

/* Read the light and the plane from a flattening matrix. @return 0: it belongs to no shadow */
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

int flattened_from(const struct scene *s, uint32_t flat, uint32_t upright, double light[4], double plane[4])
{
	double eye[16], inverse[16], shadow[16], from_upright[16];

	matrix_from_floats(eye, s->instances[upright].modelview);
	matrix_from_floats(shadow, s->instances[flat].modelview);
	if (!matrix_invert(inverse, eye))
		return 0;
	matrix_mul(from_upright, shadow, inverse);
	return read_matrix(from_upright, light, plane);
}

/* 1 if a light of OpenGL's at a point of eye space lights a material. */
static int is_lit_from(const struct scene *s, const struct scene_material *m, const double eye[4])
{
	for (uint32_t k = 0; m->lighting && k < m->light_count; k++) {
		const float *at = s->lights[m->light_first + k].position_eye;
		double w = at[3] != 0 ? (double)at[3] : sqrt((double)(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]));
		double there[4] = { (double)at[0] / w, (double)at[1] / w, (double)at[2] / w, at[3] != 0 };

		if (flattened_apart(eye, there) < SAME)
			return 1;
	}
	return 0;
}

/* 1 if a triangle of a mesh lies in a plane of eye space, or close to it. */
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

int flattened_is_lit(const struct scene *s, const double light[4], const double *plane)
{
	uint32_t lit = 0, all = 0;

	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_material *m = &s->materials[in->material];

		if (!solid_is(s, in) || modelview_kind_of(in->modelview) != MODELVIEW_PLAIN ||
		    (plane && !touches(s, in, plane)))
			continue;
		all++;
		lit += (uint32_t)is_lit_from(s, m, light);
	}
	return 2 * lit > all;
}

int flattened_may_be(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];

	return s->meshes[in->mesh]->kind == SCENE_TRIANGLES && !in->rectangle &&
	       (m->color_mask & 7 ? !m->lighting : m->stencil_test) &&
	       modelview_kind_of(in->modelview) == MODELVIEW_SINGULAR;
}

/* --- In one frame -------------------------------------------------------------------------------- */

/* 1 if a light of OpenGL's is at a point of eye space. The light of a wrong pair usually is not. */
static int is_light(const struct scene *s, const double light[4])
{
	for (uint32_t i = 0; i < s->n_materials; i++)
		if (is_lit_from(s, &s->materials[i], light))
			return 1;
	return 0;
}

/* Decide about a flat draw, given the draws whose shadow it may be. @return the number of instances that received
 * bits */
static uint32_t decide(const struct scene *s, const struct pairs *pairs, uint32_t flat, int gives_way, uint32_t *bits)
{
	const int may_go = gives_way && (s->materials[s->instances[flat].material].color_mask & 7) != 0;
	const uint32_t first = pairs_find(pairs, s, flat, MODELVIEW_PLAIN);
	double light[4], plane[4];
	uint32_t n = 0;

	for (uint32_t upright = first; upright != SCENE_NONE && may_go; upright = pairs->next[upright])
		if (flattened_from(s, flat, upright, light, plane) && is_light(s, light) &&
		    flattened_is_lit(s, light, plane)) {
			bits[flat] |= SCENE_LEFT_OUT;
			return 1;
		}
	for (uint32_t upright = first; upright != SCENE_NONE; upright = pairs->next[upright])
		if (!(bits[upright] & SCENE_HIDDEN_FROM_LIGHTS) && flattened_from(s, flat, upright, light, plane)) {
			bits[upright] |= SCENE_HIDDEN_FROM_LIGHTS;
			n++;
		}
	return n;
}

int flattened_find(const struct scene *scene, int gives_way, uint32_t *bits, uint32_t *n)
{
	struct pairs pairs = { .next = NULL };
	uint32_t i = 0;
	int err = 0;

	while (i < scene->n_instances && !flattened_may_be(scene, &scene->instances[i]))
		i++;
	if (i < scene->n_instances)
		err = pairs_make(&pairs, scene);
	for (; i < scene->n_instances && !err; i++)
		if (flattened_may_be(scene, &scene->instances[i]))
			*n += decide(scene, &pairs, i, gives_way, bits);
	pairs_free(&pairs);
	return err;
}
