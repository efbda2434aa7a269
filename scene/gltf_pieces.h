/*
 * The contents of a glTF file: the binary chunk, and the numbered objects that refer to it. gltf_parts.c collects them
 * from a scene, with the materials of gltf_looks.c; gltf.c writes the text.
 */
#pragma once

#include "scene/gltf.h"

enum { GLTF_VERTICES = 34962, GLTF_INDICES = 34963 }; /* bufferView.target: ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER */

/* A piece of the binary chunk: vertices, indices or an image. */
struct gltf_piece {
	size_t offset, n_bytes;
	uint32_t target;
};

struct gltf_accessor {
	uint32_t piece, component, count;
	const char *type;
	int has_bounds;
	float min[3], max[3];
};

/* A glTF material; compared by its bytes. */
struct gltf_look {
	float base[4], emissive[3];
	float metallic, roughness, transmission, ior, cutoff;
	uint32_t unlit, blend, mask, double_sided;
	uint32_t texture; /* index into gltf.sampled, or SCENE_NONE */
};

/* A texture with its sampler: a glTF image, a sampler and a texture that share one number. */
struct gltf_sampled {
	uint32_t texture; /* index in the scene */
	uint32_t piece;   /* its PNG */
	uint32_t wrap_s, wrap_t, min_filter, mag_filter;
};

/* A glTF mesh: a mesh of the scene with one material and one set of current attributes. */
struct gltf_part {
	uint32_t mesh, material, current, flipped;
	uint32_t baked; /* the instance whose eye space the vertices are in; SCENE_NONE: object space */
	uint32_t position, normal, color, texcoord, index; /* accessors, or SCENE_NONE */
	uint32_t look;
};

enum gltf_node_kind { GLTF_INSTANCE, GLTF_CAMERA, GLTF_LIGHT };

struct gltf_node {
	enum gltf_node_kind kind;
	uint32_t index; /* index of the scene's instance, view or light */
	uint32_t part;  /* index of an instance's part */
};

/* Views that share an eye space: a glTF scene. */
struct gltf_space {
	uint32_t space; /* scene_view.space */
	uint32_t node_first, node_count;
	uint64_t n_primitives;
	float middle[3]; /* middle of the drawn geometry, in eye space */
};

struct gltf {
	const struct scene *s;
	struct gltf_losses *losses;
	int failed; /* 1: out of memory; nothing is written */

	uint8_t *bytes;
	size_t n_bytes, room;
	struct gltf_piece *pieces;
	struct gltf_accessor *accessors;
	struct gltf_look *looks;
	struct gltf_sampled *sampled;
	struct gltf_part *parts;
	struct gltf_node *nodes;
	struct gltf_space *spaces;
	uint32_t n_pieces, n_accessors, n_looks, n_sampled, n_parts, n_nodes, n_spaces;
};

/** Append one item to a growing array. Yields its index, or SCENE_NONE if out of memory. */
#define GLTF_PUSH(g, array, value) \
	(gltf_grow((g), (void **)&(g)->array, (g)->n_##array, \
	sizeof(*(g)->array)) ? SCENE_NONE : ((g)->array[(g)->n_##array] = (value), (g)->n_##array++))
int gltf_grow(struct gltf *g, void **items, uint32_t n, size_t size);

/** Reserve a piece, aligned to 4 bytes; NULL if out of memory. Valid until the next call. */
void *gltf_put_piece(struct gltf *g, size_t n, uint32_t target, uint32_t *number);

/** Shorten the last piece to n bytes. */
void gltf_shrink_piece(struct gltf *g, uint32_t piece, size_t n);

void gltf_free(struct gltf *g);

/** From GL's display-referred values to glTF's linear ones (IEC 61966-2-1). */
float gltf_linear(float v);

/** Scale to length 1; (0, 0, 1) if there is no direction. */
void gltf_normalise(float v[3]);
