/*
 * Which alpha a surface can have within a cell of a triangle, and so what it does to a ray to a light that hits the
 * cell: bounds of its texels, and of what texture environments make of them.
 */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

/* Least and greatest alpha of the blocks of 1, 2, 4, .. texels of a texture's finest level. */
#define OPACITY_BLOCK_LEVELS 16
struct opacity_blocks {
	uint8_t (*alpha)[2];
	size_t first[OPACITY_BLOCK_LEVELS];
	uint32_t width[OPACITY_BLOCK_LEVELS], height[OPACITY_BLOCK_LEVELS], n_levels;
};

/**
 * Find the bounds of a two-dimensional texture with alpha, 8 bits per component and no border.
 * @param out  free with opacity_blocks_free; out->alpha is NULL if there is no memory for them
 */
void opacity_blocks_make(const struct scene_texture *texture, struct opacity_blocks *out);
void opacity_blocks_free(struct opacity_blocks *blocks);

/* A mesh drawn with a material. */
struct opacity_surface {
	const struct scene *scene;
	const struct scene_mesh *mesh; /* triangles */
	const struct scene_material *material;
	const struct scene_current *current;
	uint32_t unit; /* index in scene.units of the unit whose texels are looked at; SCENE_NONE: none */
	const struct opacity_blocks *blocks; /* its texture's */
};

/** The first unit of a material whose texels can be looked at: index in scene.units; SCENE_NONE: there is none. */
uint32_t opacity_unit(const struct scene *scene, const struct scene_material *material);

struct opacity_range {
	float lo, hi;
};

/* A triangle, divided into n x n cells along b1 and b2. */
struct opacity_cells {
	const struct opacity_surface *surface;
	struct opacity_range primary;         /* alpha without textures */
	int anywhere;                         /* 1: its texture coordinates are not known; any texel counts */
	float first[2], right[2], up[2];      /* texture coordinates at b1 = b2 = 0, and their changes along a cell */
};

void opacity_cells_start(const struct opacity_surface *s, const uint32_t index[3], uint32_t n,
                         struct opacity_cells *out);

/** The opacity of the cell (i, j), on sides that light does not pass: OPACITY_STOPS, _PASSES or _ASK. */
uint32_t opacity_cells_at(const struct opacity_cells *cells, uint32_t i, uint32_t j);
