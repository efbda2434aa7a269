#include "tracer/frame/place/opacity_sides.h"

#include <math.h>

#include "gl_tokens.h"
#include "kernels/frame/light/transparency.h"

/* How far a matrix's rows may be from equally long and perpendicular, as a share of their squared length. */
#define TURN_SLACK 1e-4

static double dot(const float a[3], const float b[3])
{
	return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

static void cross(const float a[3], const float b[3], float out[3])
{
	for (int i = 0; i < 3; i++)
		out[i] = (float)((double)a[(i + 1) % 3] * b[(i + 2) % 3] - (double)a[(i + 2) % 3] * b[(i + 1) % 3]);
}

uint32_t opacity_turn_of(const struct instance *instance)
{
	const float *m = instance->eye_from_obj;
	const double length = dot(m, m);
	uint32_t turn = 0;
	float across[3];

	for (int i = 0; i < 3; i++)
		if (!(fabs(dot(m + 4 * i, m + 4 * i) - length) <= TURN_SLACK * length &&
		      fabs(dot(m + 4 * i, m + 4 * ((i + 1) % 3))) <= TURN_SLACK * length))
			turn = OPACITY_WARPED;
	cross(m, m + 4, across);
	return dot(across, m + 8) < 0 ? turn | OPACITY_MIRRORED : turn;
}

/* The side of a lit triangle that its normals face. */
static uint32_t side_by_normals(const struct opacity_surface *s, const uint32_t index[3], int *sure)
{
	const float *corner[3];
	float e1[3], e2[3], plane[3], sum[3] = { 0 };
	double along;

	for (int i = 0; i < 3; i++) {
		const float *normal = s->mesh->normal ? s->mesh->normal + 3 * (size_t)index[i] : s->current->normal;
		const double length = s->material->normalize ? sqrt(dot(normal, normal)) : 1;

		corner[i] = s->mesh->position + 4 * (size_t)index[i];
		for (int a = 0; a < 3; a++)
			sum[a] += length > 0 ? (float)(normal[a] / length) : 0;
	}
	for (int a = 0; a < 3; a++) {
		e1[a] = corner[1][a] - corner[0][a];
		e2[a] = corner[2][a] - corner[0][a];
	}
	cross(e1, e2, plane);
	along = dot(plane, sum) / sqrt(dot(plane, plane) * dot(sum, sum));
	*sure = fabs(along) > 10 * TRANSPARENCY_ACROSS;
	return !*sure ? 0 : along > 0 ? INSTANCE_PASS_COUNTER : INSTANCE_PASS_CLOCKWISE;
}

uint32_t opacity_sides_of(const struct opacity_surface *s, uint32_t turn, const uint32_t index[3], int *sure)
{
	const struct scene_material *m = s->material;

	*sure = 1;
	if (!(m->surface.hidden & SCENE_ONE_SIDED))
		return 0;
	if (m->cull_face == GL_FRONT || m->cull_face == GL_BACK) {
		const int front_is_counter = (m->front_face != GL_CW) != ((turn & OPACITY_MIRRORED) != 0);

		return front_is_counter == (m->cull_face == GL_BACK) ? INSTANCE_PASS_COUNTER : INSTANCE_PASS_CLOCKWISE;
	}
	if (!m->lighting || m->two_side)
		return 0;
	*sure = !(turn & OPACITY_WARPED);
	return *sure ? side_by_normals(s, index, sure) : 0;
}
