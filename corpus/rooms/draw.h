/* A level drawn by OpenGL as programs of its day drew it: 1.3, its extensions, and fixed functions alone. */
#pragma once

#include "bake.h"
#include "cull.h"

enum lighting {
	LIGHTING_MULTITEXTURE, /* lightmaps by a second texture unit */
	LIGHTING_PASS,         /* lightmaps by a second pass, multiplied onto the first */
	LIGHTING_OPENGL,       /* no lightmaps: OpenGL's own lights at the vertices */
	LIGHTING_COLORS,       /* light baked into vertex colours, of walls cut into small triangles */
	LIGHTING_PAINT,        /* the same with colours that are no light */
	LIGHTING_NONE,         /* textures as they are, on walls and objects */
	LIGHTING_WHITE         /* the same, on walls cut as those with light in their colours */
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

/** Textures and lightmaps. With the context current. */
void draw_init(struct drawing *d);

/** One frame, without the swap. */
void draw_frame(struct drawing *d, const struct view *view, long frame);

/** What is seen without mirror and shadow: walls and objects, under the current matrices. visible NULL: all walls */
void draw_world(struct drawing *d, const unsigned char *visible, long frame, int with_mirroring_object);

/** The walls alone, as polygons of one colour: for stencil and depth. */
void draw_face_plain(const struct mesh *mesh, const struct face *face);

/** The largest face that is a mirror; NULL: the level has none. */
const struct face *draw_mirror_of(const struct mesh *mesh);

/* --- tricks.c ---------------------------------------------------------------------------------------------------- */

/** The surroundings of the second object into the environment map, by six pictures of the world. */
void trick_environment(struct drawing *d, const struct view *view, long frame);
/** Draw the second object with it. */
void trick_mirroring_object(struct drawing *d);
/** The world behind the mirror, and the mirror over it. Leaves depth as of a frame in which only the mirror was
 * drawn. */
void trick_planar_mirror(struct drawing *d, long frame);
/** Darken what lies in the first object's shadow (z-fail: Bilodeau and Songy 1999; Carmack 2000). */
void trick_shadow(struct drawing *d, long frame);

/* --- torus.c ----------------------------------------------------------------------------------------------------- */

enum { TORUS_AROUND = 24, TORUS_ACROSS = 12, N_TORUS_TRIANGLES = 2 * TORUS_AROUND * TORUS_ACROSS };

/** Where the first object stands in a frame: column-major. */
void torus_matrix(const struct level *level, long frame, float out[16]);
void torus_draw(void);
/** The shadow volume of the torus, closed at both ends; light in its own space. Front faces outwards. */
void torus_draw_shadow_volume(struct vec light, double reach);
