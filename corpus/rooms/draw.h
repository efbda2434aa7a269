/* Draws a level as programs of its time did: OpenGL 1.3 with extensions, fixed function only. */
#pragma once

#include "bake.h"
#include "cull.h"

enum lighting {
	LIGHTING_MULTITEXTURE, /* lightmaps by a second texture unit */
	LIGHTING_PASS,         /* lightmaps by a second pass, multiplied onto the first */
	LIGHTING_OPENGL,       /* no lightmaps: OpenGL's own lights at the vertices */
	LIGHTING_COLORS,       /* light baked into vertex colours, on walls cut into small triangles */
	LIGHTING_PAINT,        /* the same with arbitrary colours in place of light */
	LIGHTING_NONE,         /* plain textures, on walls and objects */
	LIGHTING_WHITE         /* plain textures, on walls cut as for LIGHTING_COLORS */
};

enum environment { ENVIRONMENT_NONE, ENVIRONMENT_CUBE, ENVIRONMENT_SPHERE };

struct drawing {
	const struct level *level;
	const struct world *world;
	enum culling culling;
	enum lighting lighting;
	enum environment environment;
	int has_mirror; /* a planar mirror by stencil */
	int has_shadow; /* stencil shadow volumes of the first object */
	struct lightmap *maps; /* [n_faces] */
	unsigned char *visible; /* [n_faces] */
};

enum { ENVIRONMENT_SIZE = 128 };

/** Create textures and lightmaps. Needs a current context. */
void draw_init(struct drawing *d);

/** Draw one frame, without the swap. */
void draw_frame(struct drawing *d, const struct view *view, long frame);

/** Draw walls and objects under the current matrices, without mirror and shadow. visible NULL: all walls */
void draw_world(struct drawing *d, const unsigned char *visible, long frame, int with_mirroring_object);

/** Draw a wall as a polygon without state: for stencil and depth. */
void draw_face_plain(const struct mesh *mesh, const struct face *face);

/** The largest mirror face; NULL: none. */
const struct face *draw_mirror_of(const struct mesh *mesh);

/* --- tricks.c ---------------------------------------------------------------------------------------------------- */

/** Render the surroundings of the second object into the environment map, by six pictures of the world. */
void trick_environment(struct drawing *d, const struct view *view, long frame);
/** Draw the second object with the environment map. */
void trick_mirroring_object(struct drawing *d);
/** Draw the world behind the mirror, and the mirror over it. The depth left is that of the mirror alone. */
void trick_planar_mirror(struct drawing *d, long frame);
/** Darken the first object's shadow (z-fail: Bilodeau and Songy 1999; Carmack 2000). */
void trick_shadow(struct drawing *d, long frame);

/* --- torus.c ----------------------------------------------------------------------------------------------------- */

enum { TORUS_AROUND = 24, TORUS_ACROSS = 12, N_TORUS_TRIANGLES = 2 * TORUS_AROUND * TORUS_ACROSS };

/** Matrix of the first object in a frame: column-major. */
void torus_matrix(const struct level *level, long frame, float out[16]);
void torus_draw(void);
/** The shadow volume of the torus, closed at both ends; light in object space. Front faces point outwards. */
void torus_draw_shadow_volume(struct vec light, double reach);
