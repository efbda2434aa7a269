/* The triangles of a scene in one space, for queries. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

/* The origin of a triangle. */
struct soup_source {
	uint32_t draw, primitive; /* as in struct relume_rays_triangle */
};

struct query_soup {
	float (*position)[4]; /* [n_vertices], w is 1 */
	uint32_t (*index)[3];
	struct soup_source *sources; /* [n_triangles]; NULL: the caller's own */
	uint32_t n_vertices, n_triangles;
};

/**
 * The triangles of a frame that rays see, in eye space; if there are several eye spaces, those of the one with the
 * most. Triangles with a corner at infinity or beyond it are left out.
 * @param out  query_soup_free
 * @return 0 or ERR_SYSTEM (reported)
 */
int query_soup_of_frame(const struct scene *scene, struct query_soup *out);

/**
 * The caller's own triangles.
 * @param where  their name in messages
 * @return 0; ERR_SYSTEM (reported); ERR_USAGE (reported: an index out of range or a number that is not finite)
 */
int query_soup_of_triangles(const float (*position)[3], size_t n_vertices, const uint32_t (*index)[3],
                            size_t n_triangles, const char *where, struct query_soup *out);
void query_soup_free(struct query_soup *soup);
