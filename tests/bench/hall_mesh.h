/* The hall of corpus/ with 262,267 triangles as one bench_mesh, in the eye space of hall.c's first frame. */
#pragma once

#include "base/err.h"
#include "corpus/hall.h"
#include "verbs/render/bench/bench.h"

/** @return 0 or ERR_SYSTEM (reported); release with bench_mesh_free */
static inline int hall_mesh_create(struct bench_mesh *out)
{
	/* gluLookAt(0, 2.2, 13, 0, 2.4, 0, 0, 1, 0) */
	const float eye_y = 2.2f, eye_z = 13, length = sqrtf(13 * 13 + 0.2f * 0.2f), c = 13 / length, s = 0.2f / length;

	build_hall();
	memset(out, 0, sizeof(*out));
	snprintf(out->source, sizeof(out->source), "hall");
	for (int i = 0; i < N_PARTS; i++) {
		out->n_vertices += (uint32_t)parts[i].n_vertices;
		out->n_triangles += (uint32_t)(parts[i].n_indices / 3);
	}
	out->position = malloc(out->n_vertices * sizeof(*out->position));
	out->index = malloc(out->n_triangles * sizeof(*out->index));
	if (!out->position || !out->index) {
		bench_mesh_free(out);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	out->n_vertices = out->n_triangles = 0;
	for (int i = 0; i < N_PARTS; i++) {
		const uint32_t base = out->n_vertices;

		for (size_t v = 0; v < parts[i].n_vertices; v++) {
			const float *p = parts[i].vertices[v].position, y = p[1] - eye_y, z = p[2] - eye_z;
			const float eye[4] = { p[0], c * y + s * z, c * z - s * y, 1 };

			memcpy(out->position[out->n_vertices++], eye, sizeof(eye));
		}
		for (size_t k = 0; k < parts[i].n_indices; k++)
			out->index[out->n_triangles + k / 3][k % 3] = base + parts[i].indices[k];
		out->n_triangles += (uint32_t)(parts[i].n_indices / 3);
		free(parts[i].vertices);
		free(parts[i].indices);
		memset(&parts[i], 0, sizeof(parts[i]));
	}
	return 0;
}
