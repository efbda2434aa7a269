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
	int sky;             /* 1: holds the skies; only frames with skies have such spaces */
	uint32_t top2_first; /* in accel.top2 */
	uint32_t top8_first; /* in accel.top8 */
	uint32_t n_nodes;    /* 0: there is nothing to hit */
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
	uint64_t generation; /* incremented whenever the pools above change */
	size_t same[N_BLAS_PARTS]; /* items at the front of each pool that have not changed since accel_copied */

	/* The TLASes of the current frame: leaves of both hold indices into instance_list. */
	struct node2 *top2;
	struct node8 *top8;
	uint32_t *instance_list;
	size_t n_top2, n_top8, n_instance_list;

	unsigned wide; /* which of ACCEL_ROWS and ACCEL_COMPRESSED to build; initially ACCEL_ROWS; fixed before the
	                * first frame */
	enum accel_kind kind; /* kind of BLAS that the next frame finds or builds; initially ACCEL_BVH */
	struct blas_store *store;  /* keeps trees for other runs; borrowed; NULL (the initial value): none */
	struct blas_cache *shared; /* BLASes shared with other accels; borrowed; NULL (the initial value): none */
	uint64_t n_made, n_fitted; /* mesh trees so far: built or read here; refitted to moved vertices */
	struct accel_cache *cache; /* private: mesh hash -> place in the pools, last frame of use */
	struct accel_space *spaces;
	size_t n_spaces;
};

int accel_create(struct accel **out);
void accel_destroy(struct accel **accel);

/**
 * Find or build the BLASes of a frame's instances (accel->kind), then its TLASes.
 *
 * BLASes persist across frames and are found by the hash of their mesh. BLASes that have gone unused for some frames
 * are dropped once they are a large share of all. If a mesh has the triangles of an existing BLAS but other vertices,
 * it takes over that tree with refitted boxes; if refitting raises the tree's cost too far, a binned tree (ACCEL_BVH)
 * is built instead. BLASes of INSTANCE_BAKED instances live for one frame. Triangles with a vertex that is not finite
 * are left out. Triangles with a vertex at w <= 0 have no bounds, so only camera rays find them. Meshes must consist of
 * triangles; lines and points are passed as `extra` meshes.
 *
 * @param scene      meshes and views
 * @param extra      [n], or NULL: triangle meshes that replace the scene's own (screen geometry: x y in pixels); a NULL
 *                   entry keeps the scene's own mesh. Used during the call only. Meshes with different content should
 *                   have different hashes
 * @param eye_vertices  eye-space positions of the vertices of INSTANCE_BAKED instances, each at its
 *                      instance.vertex_first; NULL if there is no such instance
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

/* One of the pools: n items. The caller already has a copy of the first `same`. */
struct accel_pool {
	const void *items;
	size_t n, same;
};
struct accel_pool accel_pool(const struct accel *accel, enum blas_part part);

/** Record that the caller now has a copy of every pool. */
void accel_copied(struct accel *accel);
