/*
 * Scenes built by hand, without a recording: triangles in eye space, each with a draw of its own.
 *
 * Functions that add something return its index. If memory or room runs out they set made->err, and the index means
 * nothing: check it once, when everything is added.
 */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

#define MADE_MAX 16

/* A scene that owns everything it points to except textures. Must not be moved. */
struct made {
	struct scene scene;
	struct scene_instance instances[MADE_MAX];
	struct scene_material materials[MADE_MAX];
	struct scene_light lights[MADE_MAX];
	struct scene_view view;
	struct scene_current current;
	struct scene_clear clear;
	struct scene_mesh meshes[MADE_MAX];
	const struct scene_mesh *mesh_list[MADE_MAX];
	int err; /* 0, or ERR_SYSTEM (reported): something is missing */
};

/**
 * An empty frame, cleared to black.
 * @param tangent  of half the horizontal angle of view; 0: a parallel view, 2 units wide. Near is 1, far 100
 */
void made_init(struct made *made, uint32_t width, uint32_t height, float tangent);
void made_free(struct made *made);

/** A matte grey material, lit by all lights added before it. */
uint32_t made_add_material(struct made *made, float diffuse);

/** A white light. @param x,y,z,w  in eye space, homogeneous */
uint32_t made_add_light(struct made *made, float x, float y, float z, float w);

/**
 * Triangles as one draw.
 * @param position, normal  [n][3], copied
 * @param n                 vertices, a multiple of 3
 */
uint32_t made_add_triangles(struct made *made, uint32_t material, const float (*position)[3], const float (*normal)[3],
                            uint32_t n);

/** A square around a centre: corners at centre +- r u +- r v, normal u x v, cut into cells x cells squares. */
uint32_t made_add_square(struct made *made, uint32_t material, const float centre[3], const float u[3],
                         const float v[3], float r, uint32_t cells);

/** A ball of `rings` rings and twice as many sectors. @param inside 1: turned inside out, to be seen from within */
uint32_t made_add_ball(struct made *made, uint32_t material, const float centre[3], float r, uint32_t rings,
                       int inside);
