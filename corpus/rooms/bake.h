/*
 * Lightmaps: the light that reaches each wall, computed once in plain C.
 *
 * A texel holds AMBIENT + sum over lights of color x max(0, cos) x visible / d^2, d in metres, each channel clamped to
 * 1. Walls are matte and reflect no light onto each other.
 */
#pragma once

#include "bsp.h"
#include "level.h"

#define BAKE_AMBIENT 0.08

struct lightmap {
	unsigned width, height;  /* powers of two */
	unsigned char *texels;   /* owned, [height][width][3] */
	struct vec u, v;         /* unit vectors in the wall's plane */
	double u0, v0, du, dv;   /* texture coordinates of p: (u . p - u0) / du, (v . p - v0) / dv */
};

void bake_face(struct lightmap *map, const struct level *level, const struct mesh *mesh, const struct bsp *bsp,
               const struct face *face);

/** The light at a point of a wall, as in its lightmap. */
void bake_point(const struct level *level, const struct mesh *mesh, const struct bsp *bsp, const struct face *face,
                struct vec p, unsigned char out[3]);

/** Texture coordinates of a point of the wall. */
void bake_coordinates(const struct lightmap *map, struct vec p, float st[2]);
