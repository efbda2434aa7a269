/*
 * Random scenes for the tests of the traversal kernels: a few meshes under several matrices, including degenerate and
 * repeated triangles. The same seed gives the same scene.
 */
#pragma once

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "tests/check/on_devices.h"
#include "tracer/accel/accel.h"
#include "tracer/device/device.h"

#define MESHES 3
#define INSTANCES 6
#define MAX_TRIANGLES 400

struct random_scene {
	uint32_t random;
	struct scene scene;
	struct scene_mesh meshes[MESHES];
	const struct scene_mesh *mesh_list[MESHES];
	float position[MESHES][3 * MAX_TRIANGLES][4];
	uint32_t index[MESHES][MAX_TRIANGLES][3];
	struct scene_instance scene_instances[INSTANCES];
	struct scene_view scene_view;
	struct instance instances[INSTANCES];
	struct view view;
	struct accel *accel;
	const struct accel_space *spaces;
	uint32_t n_spaces, n_vertices;
};

static inline float next_random(struct random_scene *s)
{
	s->random = s->random * 1664525u + 1013904223u;
	return (float)(s->random >> 8) / 16777216.0f;
}

static inline float between(struct random_scene *s, float lo, float hi)
{
	return lo + (hi - lo) * next_random(s);
}

/* The seed of this run: RELUME_SEED, or the clock; printed. Set by main, because the tests are children of that
 * process: if each read the clock, its seed would differ from the one printed. */
static uint32_t seed_of_run;

static inline void choose_seed(void)
{
	const char *text = getenv("RELUME_SEED");

	seed_of_run = text ? (uint32_t)strtoul(text, NULL, 10) : (uint32_t)time(NULL);
	printf("seed %u\n", seed_of_run);
	fflush(stdout);
}

static inline void fill_mesh(struct random_scene *s, int m, uint32_t n)
{
	struct scene_mesh *mesh = &s->meshes[m];

	for (uint32_t t = 0; t < n; t++) {
		const float size = between(s, 0.02f, 0.6f);
		const float centre[3] = { between(s, -1, 1), between(s, -1, 1), between(s, -1, 1) };

		for (int i = 0; i < 3; i++) {
			float *p = s->position[m][3 * t + (uint32_t)i];

			for (int a = 0; a < 3; a++)
				p[a] = centre[a] + between(s, -size, size);
			p[3] = 1;
			s->index[m][t][i] = 3 * t + (uint32_t)i;
		}
		if (t % 17 == 3) /* no area */
			memcpy(s->position[m][3 * t + 2], s->position[m][3 * t + 1], 4 * sizeof(float));
		if (t % 19 == 5) /* flat along an axis */
			for (int i = 0; i < 3; i++)
				s->position[m][3 * t + (uint32_t)i][t % 3] = centre[t % 3];
		if (t % 23 == 7 && t) /* a copy of the previous one */
			for (int i = 0; i < 3; i++)
				s->index[m][t][i] = s->index[m][t - 1][i];
	}
	if (n > 40) { /* not finite: omitted */
		s->position[m][3 * 37][0] = NAN;
		s->position[m][3 * 38][1] = INFINITY;
	}
	*mesh = (struct scene_mesh){ .hash = { (uint64_t)m + 1, n }, .kind = SCENE_TRIANGLES, .vertex_count = 3 * n,
		                     .primitive_count = n, .position = s->position[m][0], .index = s->index[m][0] };
	s->mesh_list[m] = mesh;
}

/* A random rotation, a scale on each axis, a translation; and the inverse. */
static inline void fill_instance(struct random_scene *s, int i, const float at[3])
{
	struct instance *instance = &s->instances[i];
	const float a = between(s, 0, 6.28f), b = between(s, 0, 6.28f), scale[3] = { between(s, 0.5f, 2), between(s, 0.5f, 2),
		                                                                      between(s, 0.5f, 2) };
	const float ca = cosf(a), sa = sinf(a), cb = cosf(b), sb = sinf(b);
	const float turn[3][3] = { { ca, -sa * cb, sa * sb }, { sa, ca * cb, -ca * sb }, { 0, sb, cb } };

	for (int row = 0; row < 3; row++) {
		for (int col = 0; col < 3; col++) {
			instance->eye_from_obj[4 * row + col] = turn[row][col] * scale[col];
			instance->obj_from_eye[4 * row + col] = turn[col][row] / scale[row];
		}
		instance->eye_from_obj[4 * row + 3] = at[row];
	}
	for (int row = 0; row < 3; row++)
		instance->obj_from_eye[4 * row + 3] = -(instance->obj_from_eye[4 * row] * at[0] +
		                                        instance->obj_from_eye[4 * row + 1] * at[1] +
		                                        instance->obj_from_eye[4 * row + 2] * at[2]);
	instance->flags = INSTANCE_SECONDARY | INSTANCE_OPAQUE;
	instance->scene_instance = (uint32_t)i;
	s->scene_instances[i].mesh = (uint32_t)i % MESHES;
	instance->vertex_first = s->n_vertices;
	s->n_vertices += s->meshes[i % MESHES].vertex_count;
	instance->primitive_first = i ? s->instances[i - 1].primitive_first +
	                                        s->meshes[(i - 1) % MESHES].primitive_count : 0;
	instance->pad = 0.02f;
}

/*
 * A scene in front of the viewer, between z = -8 and z = -1, with its structures built. Release with random_scene_free.
 */
static inline struct random_scene *random_scene_create(uint32_t seed)
{
	struct random_scene *s = calloc(1, sizeof(*s));

	ck_assert_ptr_nonnull(s);
	s->random = seed;
	fill_mesh(s, 0, MAX_TRIANGLES);
	fill_mesh(s, 1, 60);
	fill_mesh(s, 2, 1);
	for (int i = 0; i < INSTANCES; i++) {
		const float at[3] = { between(s, -2, 2), between(s, -2, 2), between(s, -7, -2) };

		fill_instance(s, i, at);
	}
	s->scene.meshes = s->mesh_list;
	s->scene.instances = s->scene_instances;
	s->scene.views = &s->scene_view;
	s->scene.n_meshes = MESHES;
	s->scene.n_instances = INSTANCES;
	s->scene.n_views = 1;
	ck_assert_int_eq(accel_create(&s->accel), 0);
	s->accel->wide = ACCEL_ROWS | ACCEL_COMPRESSED;
	ck_assert_int_eq(accel_build_frame(s->accel, &s->scene, NULL, NULL, s->instances, INSTANCES, &s->view, &s->spaces,
	                                   &s->n_spaces), 0);
	ck_assert_uint_eq(s->n_spaces, 1);
	return s;
}

/** The same scene with trees of another kind. Spatial splits must find something to cut. */
static inline void random_scene_rebuild(struct random_scene *s, enum accel_kind kind)
{
	const size_t before = s->accel->n_triangles;
	const uint64_t generation = s->accel->generation;

	s->accel->kind = kind;
	ck_assert_int_eq(accel_build_frame(s->accel, &s->scene, NULL, NULL, s->instances, INSTANCES, &s->view, &s->spaces,
	                                   &s->n_spaces), 0);
	if ((kind == ACCEL_SBVH || kind == ACCEL_KD) && s->accel->generation != generation)
		ck_assert_uint_gt(s->accel->n_triangles, 2 * before);
}

static inline void random_scene_free(struct random_scene *s)
{
	accel_destroy(&s->accel);
	free(s);
}

