/*
 * A level as its author writes it: brushes that add and subtract, portals, lights, objects. All space is solid at
 * first.
 *
 * A level file has one item per line; # begins a comment. y is up, lengths are in metres, textures are numbers.
 *
 *     subtract box X0 Y0 Z0 X1 Y1 Z1 TEXTURE
 *     add cylinder X Z RADIUS Y0 Y1 SIDES TEXTURE            upright
 *     add cone X Z RADIUS Y0 Y1 SIDES TEXTURE                its tip at Y1
 *     add plane NX NY NZ D X0 Y0 Z0 X1 Y1 Z1 TEXTURE         the part of a box behind n . p = D
 *     portal X0 Y0 Z0 X1 Y1 Z1                               a rectangle across a doorway; one extent is 0
 *     light X Y Z RED GREEN BLUE                             radiance at 1 m
 *     object X Y Z                                           the first turns and casts a shadow, the second mirrors
 *                                                            its surroundings
 *     start X Y Z YAW
 */
#pragma once

#include <stddef.h>

#include "winding.h"

enum { BRUSH_MAX_PLANES = 34, N_TEXTURES = 4, TEXTURE_MIRROR = N_TEXTURES };

/* A convex solid: the space behind all of its planes. */
struct brush {
	int adds; /* 0: subtracts */
	int n_planes, texture;
	struct plane planes[BRUSH_MAX_PLANES];
	struct box box;
};

struct light {
	struct vec at;
	double color[3];
};

struct level {
	struct brush *brushes; /* later ones override earlier ones */
	size_t n_brushes;
	struct winding *portals; /* as written: may extend into walls */
	size_t n_portals;
	struct light *lights;
	size_t n_lights;
	struct vec *objects;
	size_t n_objects;
	struct vec start;
	double start_yaw_deg;
	struct vec *path; /* a walk from the start through all rooms; empty for a level read from a file */
	size_t n_path;
};

/** Read a level file. Ends the program with a message if it is invalid. */
void level_read(struct level *level, const char *path);

/** Generate a level of rooms on a grid, joined by doorways, from a seed. */
void level_generate(struct level *level, unsigned seed, unsigned n_lights);

/** 1 if a point is in solid matter. */
int level_is_solid(const struct level *level, struct vec p);

void level_free(struct level *level);
