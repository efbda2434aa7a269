/*
 * Acceleration structures: one BLAS per mesh, kept for as long as the mesh is used, and the top levels of one frame.
 */
#ifndef TRACER_ACCEL_ACCEL_H
#define TRACER_ACCEL_ACCEL_H

#include "kernels/shared.h"
#include "scene/scene.h"
#include "tracer/accel/blas.h"
#include "tracer/accel/blas_cache.h"
#include "tracer/accel/blas_store.h"
#include "tracer/accel/builders.h"

/* Top level of one eye space, for secondary rays: instances with INSTANCE_SECONDARY, or its skies (INSTANCE_SKY). */
struct accel_space {
	uint32_t space;      /* number as in scene_view.space */
	int sky;             /* 1: of the skies; such spaces are there only where the frame has skies */
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
	uint64_t generation; /* grows whenever the pools above changed */
	size_t same[N_BLAS_PARTS]; /* items at the front of each pool that are as they were when accel_copied was called last */

	/* Of the current frame: leaves of both hold indices into instance_list. */
	struct node2 *top2;
	struct node8 *top8;
	uint32_t *instance_list;
	size_t n_top2, n_top8, n_instance_list;

	unsigned wide;        /* of ACCEL_ROWS and ACCEL_COMPRESSED, those wanted; ACCEL_ROWS at first; settled before the first frame */
	enum accel_kind kind; /* of the BLASes that the next frame finds or builds; ACCEL_BVH at first */
	struct blas_store *store;  /* where trees are kept beyond this run; borrowed, NULL: nowhere, as at first */
	struct blas_cache *shared; /* BLASes that other accels share with it; borrowed, NULL: none, as at first */
	uint64_t n_made, n_fitted; /* trees of meshes so far: built or read here, and fitted to vertices that have moved */
	struct accel_cache *cache; /* private: mesh hash -> place in the pools, last frame of use */
	struct accel_space *spaces;
	size_t n_spaces;
};

int accel_create(struct accel **out);
void accel_destroy(struct accel **accel);

/**
 * Find or build the BLASes of a frame's instances (accel->kind), then its top levels.
 *
 * BLASes are kept across frames by the mesh's hash, and dropped some frames after their last use, once they are a good part of all. A mesh of the same
 * triangles as one of these but with other vertices gets its tree with other boxes, as long as that does not cost much
 * more than when it was built, else a binned one (ACCEL_BVH). Those of INSTANCE_BAKED instances live for one frame.
 * Triangles with a vertex that is not finite are left out; those with a vertex at w <= 0 cannot be bounded and stay as
 * candidates for camera rays only. A mesh of another kind than triangles is an error of the caller: lines and points
 * come as `extra` meshes.
 *
 * @param scene      meshes and views
 * @param extra      [n], or NULL: the triangle mesh of an instance that is not one of the scene's (screen geometry: x y
 *                   in pixels); NULL entries stand for the scene's own mesh. Used during the call only. Its hash should
 *                   differ from frame to frame when its content does
 * @param eye_vertices  eye-space positions [4] of the vertices of INSTANCE_BAKED instances, at instance.vertex_first of
 *                   each; NULL where there is none of these
 * @param instances  [n]; matrices, flags, pad, view, vertex_first and scene_instance are filled in by the caller;
 *                   node2_first, node8_first, triangle_first, triangle8_first, node8c_first and triangle8c_first are filled
 *                   in here. The matrices of
 *                   BAKED and SCREEN instances are the identity
 * @param views      [scene->n_views]; tlas_first and tlas_count are filled in here
 * @param spaces     receives an array owned by accel, valid until the next call
 * @return 0 or ERR_SYSTEM (reported)
 */
int accel_build_frame(struct accel *accel, const struct scene *scene, const struct scene_mesh *const *extra,
                      const float (*eye_vertices)[4], struct instance *instances, uint32_t n, struct view *views,
                      const struct accel_space **spaces, uint32_t *n_spaces);

/* One of the pools: its items, how many, and how many of these, from the first on, are those that its user has a copy of. */
struct accel_pool {
	const void *items;
	size_t n, same;
};
struct accel_pool accel_pool(const struct accel *accel, enum blas_part part);

/** Its user has a copy of all pools now. */
void accel_copied(struct accel *accel);

#endif
