/*
 * A level as its author writes it: brushes that add and subtract, portals, lights, objects. Everything begins solid.
 *
 * A level file holds one thing a line; # begins a comment. y is up, lengths are in metres, textures are numbers.
 *
 *     subtract box X0 Y0 Z0 X1 Y1 Z1 TEXTURE
 *     add cylinder X Z RADIUS Y0 Y1 SIDES TEXTURE            upright
 *     add cone X Z RADIUS Y0 Y1 SIDES TEXTURE                its tip at Y1
 *     add plane NX NY NZ D X0 Y0 Z0 X1 Y1 Z1 TEXTURE         what of a box lies behind n . p = D
 *     portal X0 Y0 Z0 X1 Y1 Z1                               a rectangle across a doorway; one extent is 0
 *     light X Y Z RED GREEN BLUE                             radiant at 1 m
 *     object X Y Z                                           the first turns and throws a shadow, the second mirrors
 *                                                            its surroundings
 *     start X Y Z YAW
 */
#pragma once

#include <stddef.h>

#include "winding.h"

enum { BRUSH_MAX_PLANES = 34, N_TEXTURES = 4, TEXTURE_MIRROR = N_TEXTURES };

/* A convex solid: what lies behind all of its planes. */
struct brush {
	int adds; /* 0: it subtracts */
	int n_planes, texture;
	struct plane planes[BRUSH_MAX_PLANES];
	struct box box;
};

struct light {
	struct vec at;
	double color[3];
};

struct level {
	struct brush *brushes; /* a later one overrules those before it */
	size_t n_brushes;
	struct winding *portals; /* as written: may reach into walls */
	size_t n_portals;
	struct light *lights;
	size_t n_lights;
	struct vec *objects;
	size_t n_objects;
	struct vec start;
	double start_yaw_deg;
	struct vec *path; /* a walk from the start through all rooms; none in a level that was read */
	size_t n_path;
};

/** Read a level file. Ends the program with a message where it is wrong. */
void level_read(struct level *level, const char *path);

/** Make a level of rooms on a grid, joined by doorways, from a number. */
void level_generate(struct level *level, unsigned seed, unsigned n_lights);

/** 1 where a point is in solid matter. */
int level_is_solid(const struct level *level, struct vec p);

void level_free(struct level *level);
