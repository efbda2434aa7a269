/*
 * Lines (expand_line.h), points and pixel rectangles (expand_point.h) as triangles in the window, at the positions of
 * Mesa's llvmpipe. Polygons drawn as lines or points (GL 2.1 sec. 3.5.4) are handled in the same way, edge by edge.
 */
#pragma once

#include "kernels/shared.h"
#include "scene/scene.h"
#include "tracer/frame/prepare/prepare.h"

/* The primitives of one instance after the vertex stage. All pointers are borrowed. */
struct expand_input {
	const struct scene_mesh *mesh;
	const struct scene_material *material;
	const struct scene_unit *units; /* units of the material */
	const struct view *view;
	enum prepared_shape shape;
	const struct scene_rectangle *rectangles; /* [mesh vertices]; NULL: no bitmaps or pixel rectangles */
	uint32_t cull; /* INSTANCE_CULL_*: faces of polygons not drawn in this shape */
	uint32_t width, height, depth_bits;
	uint32_t from_below, mesa; /* scene.samples_from_below and .mesa */
	/*
	 * 1: clip at twice the width and height of the view. llvmpipe does so if there is neither a depth nor a stencil
	 * buffer and colours have 8 bits and one sample (lp_state_derived.c, 22.3.6). Clipped primitives then start at
	 * another subpixel position.
	 */
	int guards;
	const struct shaded_vertex *vertices; /* [mesh vertices] */
	const float (*texcoords)[4];          /* [mesh vertices][unit_count] */
	float *dashed; /* pixels since the line stipple was restarted; carried over from one instance to the next, as in
	                * Mesa's draw module */
};

/* The resulting quads, with four vertices and two triangles each. */
struct expanded {
	struct shaded_vertex *vertices;
	struct window_vertex *windows;
	float (*texcoords)[4];
	float (*position)[4]; /* pixels, for the tree */
	uint32_t *index, *primitive_draw;
	uint32_t n_vertices, n_primitives, n_texcoords;
	uint32_t room; /* most quads */
	struct scene_mesh mesh; /* borrows position, index and primitive_draw; has a hash */
};

/** @param out  all zero; free with expanded_free. @return 0 or ERR_SYSTEM (reported) */
int expand_primitives(const struct expand_input *in, struct expanded *out);
void expanded_free(struct expanded *e);
