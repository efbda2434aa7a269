/*
 * The triangles of one mesh that can be hit, each with its bounds. Input of the tree builders.
 */
#pragma once

#include "kernels/shared.h"
#include "tracer/accel/bvh.h"

/* Coordinate that stands for infinity in boxes that cannot be bounded; its square is still finite as a float. */
#define SOUP_UNBOUNDED 1e18f

struct soup {
	struct triangle *triangles; /* [n], in the mesh's order */
	struct bvh_box *boxes;      /* [n]; widened by the hit tolerance at edges (kernels/rays/rays.h) */
	uint32_t n;
	struct bvh_box box;         /* bounds of all triangles */
	int bounded;                /* 1: every box is the bounds of its triangle */
};

/**
 * Collect a mesh's triangles. Those with a vertex that is not finite are left out. Triangles with a vertex at w <= 0
 * have no bounds: they get the largest box and no edges, so only camera rays find them.
 *
 * @param mesh       a mesh of triangles
 * @param positions  [mesh->vertex_count][4], homogeneous
 * @param out        receives the soup; free with soup_free, also after an error
 * @return 0 or ERR_SYSTEM (reported)
 */
int soup_make(const struct scene_mesh *mesh, const float (*positions)[4], struct soup *out);
void soup_free(struct soup *soup);
