/*
 * Acceleration structures: one BLAS per mesh, kept while the mesh is in use, and the TLASes of one frame.
 */
#pragma once

#include "kernels/shared.h"
#include "scene/scene.h"
#include "tracer/accel/blas.h"
#include "tracer/accel/blas_cache.h"
#include "tracer/accel/blas_store.h"
#include "tracer/accel/builders.h"

/* The TLAS of one eye space, for secondary rays: instances with INSTANCE_SECONDARY, or its skies (INSTANCE_SKY). */
struct accel_space {
	uint32_t space;      /* number as in scene_view.space */
	int sky;             /* 1: of the skies; only frames with skies have such spaces */
	uint32_t top2_first; /* in accel.top2 */
	uint32_t top8_first; /* in accel.top8 */
	uint32_t n_nodes;    /* 0: nothing to hit */
};

/* Flat pools, as uploaded. BLAS indices inside nodes are relative to the BLAS's own first node or triangle. */
struct accel {
	struct node2 *nodes2;         /* BLASes, one after the other */
	struct node8 *nodes8;
	struct triangle *triangles;   /* leaf order of nodes2 */
	struct triangle8 *triangles8; /* leaf order of nodes8 */
	struct face8 *faces8;         /* their corners */
	struct node8c *nodes8c;
	struct triangle *triangles8c; /* leaf order of nodes8c */
	size_t n_nodes2, n_nodes8, n_triangles, n_triangles8, n_faces8, n_nodes8c, n_triangles8c;
	uint64_t generation; /* grows whenever the pools above change */
	size_t same[N_BLAS_PARTS]; /* items at the front of each pool that have not changed since accel_copied */

	/* The TLASes of the current frame: leaves of both hold indices into instance_list. */
	struct node2 *top2;
	struct node8 *top8;
	uint32_t *instance_list;
	size_t n_top2, n_top8, n_instance_list;

	unsigned wide; /* which of ACCEL_ROWS and ACCEL_COMPRESSED to make; ACCEL_ROWS at first; fixed before the first
	                  frame */
	enum accel_kind kind; /* of BLASes that the next frame finds or builds; ACCEL_BVH at first */
	struct blas_store *store;  /* keeps trees for other runs; borrowed; NULL, as at first: nothing does */
	struct blas_cache *shared; /* BLASes that other accels use too; borrowed; NULL, as at first: none */
	uint64_t n_made, n_fitted; /* trees of meshes so far: built or read here; fitted to vertices that have moved */
	struct accel_cache *cache; /* private: mesh hash -> place in the pools, last frame of use */
	struct accel_space *spaces;
	size_t n_spaces;
};

int accel_create(struct accel **out);
void accel_destroy(struct accel **accel);

/**
 * Find or build the BLASes of a frame's instances (accel->kind), then its TLASes.
 *
 * A BLAS stays across frames, found by its mesh's hash. Some frames after their last use BLASes go, once they are a
 * good part of all. A mesh that has moved, with the triangles of one that is here but other vertices, gets that tree
 * with new boxes; where that costs much more than the tree when it was built, it gets a binned one (ACCEL_BVH). BLASes
 * of INSTANCE_BAKED instances live for one frame. Triangles with a vertex that is not finite are left out. Those with a
 * vertex at w <= 0 have no bounds: only camera rays find them. Meshes must be of triangles: lines and points come as
 * `extra` meshes.
 *
 * @param scene      meshes and views
 * @param extra      [n], or NULL: triangle meshes in place of the scene's own (screen geometry: x y in pixels); NULL
 *                   entries stand for the scene's own. Used during the call only. The hash should differ where the
 *                   content does
 * @param eye_vertices  eye-space positions of the vertices of INSTANCE_BAKED instances, each at its
 *                      instance.vertex_first; NULL where there is no such instance
 * @param instances  [n]; the caller fills in matrices, flags, pad, view, vertex_first and scene_instance (BAKED and
 *                   SCREEN instances have identity matrices); this function fills in node2_first, node8_first,
 *                   node8c_first, triangle_first, triangle8_first and triangle8c_first
 * @param views      [scene->n_views]; this function fills in tlas_first and tlas_count
 * @param spaces     receives an array that accel owns, valid until the next call
 * @return 0 or ERR_SYSTEM (reported)
 */
int accel_build_frame(struct accel *accel, const struct scene *scene, const struct scene_mesh *const *extra,
                      const float (*eye_vertices)[4], struct instance *instances, uint32_t n, struct view *views,
                      const struct accel_space **spaces, uint32_t *n_spaces);

/* One of the pools: n items, of which its user has a copy of the first `same`. */
struct accel_pool {
	const void *items;
	size_t n, same;
};
struct accel_pool accel_pool(const struct accel *accel, enum blas_part part);

/** The user has a copy of all pools now. */
void accel_copied(struct accel *accel);
