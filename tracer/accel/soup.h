/*
 * The triangles of one mesh that can be hit, each with its bounds: what builders build from.
 */
#pragma once

#include "kernels/shared.h"
#include "tracer/accel/bvh.h"

/* Stands for the coordinates of what cannot be bounded; its square is still a float. */
#define SOUP_UNBOUNDED 1e18f

struct soup {
	struct triangle *triangles; /* [n], in the mesh's order */
	struct bvh_box *boxes;      /* [n]; widened by what counts as a hit beside a triangle (kernels/rays/rays.h) */
	uint32_t n;
	struct bvh_box box;         /* around all */
	int bounded;                /* 1: all boxes are those of triangles */
};

/**
 * Collect a mesh's triangles. Those with a vertex that is not finite are left out. Those with a vertex at w <= 0 have
 * no bounds: they get the largest box and no edges, so that only camera rays find them.
 *
 * @param mesh       of triangles
 * @param positions  [mesh->vertex_count][4], homogeneous
 * @param out        receives the soup; free with soup_free, also after an error
 * @return 0 or ERR_SYSTEM (reported)
 */
int soup_make(const struct scene_mesh *mesh, const float (*positions)[4], struct soup *out);
void soup_free(struct soup *soup);
