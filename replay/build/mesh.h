/* Meshes: vertices that were drawn, found by content and kept across frames. */
#ifndef REPLAY_BUILD_MESH_H
#define REPLAY_BUILD_MESH_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

struct gls_exec;
struct gls_geometry;

/* A mesh of the cache. Referenced by the cache itself, by lists and by scenes; freed with the last reference. */
struct gls_mesh {
	struct scene_mesh mesh; /* first */
	atomic_uint refs;
	uint64_t used_frame;    /* last frame that drew it */
	uint32_t slot;          /* its place in the scene under construction, where slot_frame says so */
	uint64_t slot_frame;
	uint32_t n_draws;       /* draws inside: highest primitive_draw + 1 */
	size_t bytes;
};

/** Find or make the mesh of what is collected. @return a reference, or NULL: nothing to draw, or out of memory (reported) */
struct gls_mesh *gls_geometry_mesh(struct gls_exec *x, struct gls_geometry *g);
void gls_mesh_release(struct gls_mesh *mesh);
/** Drop meshes that the cache alone holds and that were not drawn for some frames, where the cache is large. */
void gls_mesh_cache_trim(struct gls_exec *x);
void gls_mesh_cache_free(struct gls_exec *x);

#endif
