#include "look/apply/crease.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/vec3.h"

#define DEGREE 0.017453292519943295f
/* Positions are equal if they agree in this many steps of the mesh's size: programs close circles with sin(2 pi). */
#define STEPS 262144.0f
/* Most corners at one position: with more, each corner keeps the normal of its face. */
enum { MOST_CORNERS = 1024 };

struct corner {
	int32_t place[3]; /* position, in STEPS */
	uint32_t number; /* 3 x primitive + corner */
};

/* One primitive. */
struct facet {
	float normal[3]; /* unit vector on the side of the program's normal; all 0: the primitive has no area */
	float angle[3];  /* at its corners, radians */
	int is_flat;     /* 1: it is shaded flat, or its corners have the same normal */
};

/* Normalize a vector in place; 0 stays 0. @return its length before */
static float normalize(float v[3])
{
	const float length = sqrtf(vec3f_dot(v, v));

	for (int k = 0; k < 3; k++)
		v[k] = length > 0 ? v[k] / length : 0;
	return length;
}

static const float *corner_position(const struct scene_mesh *mesh, uint32_t number)
{
	return mesh->position + 4 * (size_t)mesh->index[number];
}

static const float *corner_normal(const struct scene_mesh *mesh, uint32_t number)
{
	return mesh->normal + 3 * (size_t)mesh->index[number];
}

static struct facet facet_of(const struct scene_mesh *mesh, uint32_t primitive, int flat)
{
	const uint32_t first = 3 * primitive;
	struct facet f = { .is_flat = 1 };
	float edge[3][3], sign;

	for (uint32_t i = 0; i < 3; i++) {
		vec3f_subtract(corner_position(mesh, first + (i + 1) % 3), corner_position(mesh, first + i), edge[i]);
		normalize(edge[i]);
		f.is_flat &= flat || memcmp(corner_normal(mesh, first), corner_normal(mesh, first + i), 3 * sizeof(float)) == 0;
	}
	for (int i = 0; i < 3; i++)
		f.angle[i] = acosf(fmaxf(-1, fminf(1, -vec3f_dot(edge[i], edge[(i + 2) % 3]))));
	vec3f_cross(edge[0], edge[1], f.normal);
	normalize(f.normal);
	sign = vec3f_dot(f.normal, corner_normal(mesh, first + 2)) < 0 ? -1 : 1;
	for (int k = 0; k < 3; k++)
		f.normal[k] *= sign;
	return f;
}

static int compare_corners(const void *a, const void *b)
{
	const struct corner *one = a, *other = b;

	for (int k = 0; k < 3; k++)
		if (one->place[k] != other->place[k])
			return one->place[k] < other->place[k] ? -1 : 1;
	return one->number < other->number ? -1 : one->number > other->number;
}

/* All corners, sorted so that those at one position are adjacent. */
static void sort_corners(const struct scene_mesh *mesh, struct corner *corners)
{
	const uint32_t n = 3 * mesh->primitive_count;
	float most = 0;

	for (uint32_t i = 0; i < n; i++)
		for (int k = 0; k < 3; k++)
			most = fmaxf(most, fabsf(corner_position(mesh, i)[k]));
	for (uint32_t i = 0; i < n; i++) {
		corners[i].number = i;
		for (int k = 0; k < 3; k++) {
			const float at = corner_position(mesh, i)[k] / most * STEPS;

			corners[i].place[k] = at >= -STEPS && at <= STEPS ? (int32_t)lrintf(at) : 0;
		}
	}
	qsort(corners, n, sizeof(*corners), compare_corners);
}

/*
 * The normal of corner `own`: the mean over the faces of all corners at its position, as in crease_smooth.
 * @param corners, n  those at its position, with `own`
 * @param least       cosine of the largest angle between faces that are smoothed over
 */
static void mean_normal(const struct facet *facets, const struct corner *corners, uint32_t n, const struct corner *own,
                        float least, float out[3])
{
	const float *face = facets[own->number / 3].normal;
	float sum[3] = { 0, 0, 0 };

	for (uint32_t i = 0; i < n && n <= MOST_CORNERS; i++) {
		const struct facet *f = &facets[corners[i].number / 3];

		for (int k = 0; k < 3 && vec3f_dot(f->normal, face) >= least; k++)
			sum[k] += f->normal[k] * f->angle[corners[i].number % 3];
	}
	memcpy(out, normalize(sum) > 0 ? sum : face, sizeof(sum));
}

/* @param corners  sorted. @param out  [3 * primitive_count][3] */
static void smooth_all(const struct scene_mesh *mesh, const struct facet *facets, const struct corner *corners,
                       float angle, float *out)
{
	const float least = cosf(angle * DEGREE) - 1e-6f;
	const uint32_t n = 3 * mesh->primitive_count;

	for (uint32_t first = 0, end; first < n; first = end) {
		for (end = first + 1;
		     end < n && memcmp(corners[first].place, corners[end].place, sizeof(corners[end].place)) == 0;
		     end++)
			;
		for (uint32_t i = first; i < end; i++) {
			const struct facet *f = &facets[corners[i].number / 3];
			float *normal = out + 3 * (size_t)corners[i].number;

			if (f->is_flat && vec3f_dot(f->normal, f->normal) > 0)
				mean_normal(facets, corners + first, end - first, &corners[i], least, normal);
			else
				memcpy(normal, corner_normal(mesh, corners[i].number), 3 * sizeof(*normal));
		}
	}
}

int crease_smooth(const struct scene_mesh *mesh, int flat, float angle, struct scene_mesh **out)
{
	const size_t n = mesh->kind == SCENE_TRIANGLES && mesh->normal ? mesh->primitive_count : 0;
	struct facet *facets = malloc((n + 1) * sizeof(*facets));
	struct corner *corners = malloc((3 * n + 1) * sizeof(*corners));
	struct scene_mesh *made = NULL;
	uint32_t bits;
	int any = 0, err = 0;

	*out = NULL;
	if (!facets || !corners)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < n && !err; i++) {
		facets[i] = facet_of(mesh, i, flat);
		any |= facets[i].is_flat;
	}
	if (any && !err) {
		made = malloc(sizeof(*made) + 9 * n * sizeof(float));
		err = made ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	if (made) {
		float *normals = (float *)(made + 1);

		sort_corners(mesh, corners);
		smooth_all(mesh, facets, corners, angle, normals);
		*made = *mesh;
		made->crease = normals;
		memcpy(&bits, &angle, sizeof(bits));
		made->hash[0] ^= 0x63726561u + (uint32_t)flat; /* caches must treat it as another mesh */
		made->hash[1] ^= bits;
		*out = made;
	}
	free(facets);
	free(corners);
	return err;
}
