/* Meshes: drawn vertices, found by content and kept across frames. Equal vertices share one mesh, in all frames. */
#pragma once

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

struct gls_exec;
struct gls_geometry;

/* The cache, lists and scenes hold references; the last release frees it. */
struct gls_mesh {
	struct scene_mesh mesh; /* must be first */
	atomic_uint refs;
	uint64_t used_frame;    /* last frame that drew it */
	uint32_t slot;          /* its index in the scene whose serial is slot_frame */
	uint64_t slot_frame;
	uint32_t n_draws;       /* number of draws in it: highest primitive_draw + 1 */
	size_t bytes;
};

/** Find or make the mesh of collected vertices. @return a reference; NULL: nothing to draw, or out of memory
 * (reported) */
struct gls_mesh *gls_geometry_mesh(struct gls_exec *x, struct gls_geometry *g);
void gls_mesh_release(struct gls_mesh *mesh);
/**
 * Call between frames: if the cache is large, drop meshes that only the cache holds and that were not drawn for a
 * while.
 */
void gls_mesh_cache_trim(struct gls_exec *x);
void gls_mesh_cache_free(struct gls_exec *x);
