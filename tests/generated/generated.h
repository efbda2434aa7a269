/* A generator of legacy OpenGL programs: types shared by its parts. A program is a window, a view and a list of
 * steps. Each step draws its choices from a sequence of its own, so that any step can be removed without changing
 * the others. All drawing is defined by the specification (no uninitialised texels, no feedback of a texture into
 * itself), though not always to the last bit. */
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>
#include <stdint.h>

/* Choose one of a list of constants; the first argument is a struct chance *. */
#define ONE_OF(chance, ...) \
	((const GLenum[]){  \
		__VA_ARGS__ }[chance_below(chance, sizeof((const GLenum[]){ __VA_ARGS__ }) / sizeof(GLenum))])

enum { MOST_UNITS = 3, MOST_TEXTURES = 6, MOST_LISTS = 4, MOST_VERTICES = 512, MOST_INDICES = 2048 };

/* A sequence of random numbers (splitmix64). */
struct chance {
	uint64_t state;
};

/* A program: the objects created so far, and the size of its targets. */
struct program {
	int width, height;               /* the window's, in pixels */
	int target_width, target_height; /* the window's, or a framebuffer object's */
	GLuint textures[MOST_TEXTURES];
	GLenum targets[MOST_TEXTURES]; /* their targets; 0: no texture */
	unsigned pushed_matrices, pushed_attributes;
	GLuint lists[MOST_LISTS]; /* lists that draw; 0: none */
};

struct vertex {
	float position[4], normal[3], color[4], secondary[3], fog, texture[4];
	GLboolean edge;
};

/* Vertices of primitives, and indices in GL's order. */
struct mesh {
	GLenum primitive;
	unsigned n_vertices, n_indices;
	struct vertex vertices[MOST_VERTICES];
	unsigned indices[MOST_INDICES];
};

/* Attributes passed for each vertex. */
enum {
	WITH_NORMAL = 1,
	WITH_COLOR = 2,
	WITH_TEXTURE = 4,
	WITH_SECONDARY = 8,
	WITH_FOG = 16,
	WITH_EDGE = 32,
	WITH_ALL = 63
};

/* chance.c */
uint64_t chance_next(struct chance *chance);
unsigned chance_below(struct chance *chance, unsigned n); /* 0 .. n-1 */
int chance_of(struct chance *chance, unsigned one_in);    /* true once in one_in times */
float chance_between(struct chance *chance, float lo, float hi);
void chance_color(struct chance *chance, float color[4]); /* components in [0,1], alpha often 1 */

/* mesh.c: a shape of about unit size around the origin. */
void mesh_make(struct chance *chance, struct mesh *mesh);
/* submit.c: pass it to GL in one of the possible ways. */
void mesh_submit(struct chance *chance, const struct mesh *mesh);

/* A step draws, or changes state that later steps use. */
typedef void step(struct chance *chance, struct program *program);

/* view.c */
step step_projection, step_matrix, step_viewport, step_scissor, step_clip_plane;
/* light.c */
step step_light, step_material, step_light_model, step_fog;
/* fragment.c */
step step_alpha_test, step_blend, step_depth, step_stencil, step_mask, step_clear, step_logic;
/* raster.c */
step step_polygon, step_line, step_point, step_shade_model;
/* texture.c */
step step_texture, step_texture_change, step_texture_environment, step_texture_generation, step_texture_matrix,
	step_texture_copy;
/* draw.c */
step step_draw, step_list, step_call_lists, step_evaluator, step_rectangle, step_attributes;
/* pixels.c */
step step_draw_pixels, step_bitmap, step_copy_pixels, step_accumulate;
/* target.c */
step step_framebuffer;

/* texture.c: create a new texture in a slot, replacing an old one, and bind it to its target. */
void renew_texture(struct program *program, unsigned slot, GLenum target);
/* texture.c: disable texturing on all units, and make unit 0 active. */
void disable_textures(void);

/* Multiply the modelview matrix so that an object of about unit size is in view; the caller pushes and pops it. */
void place_in_view(struct chance *chance, float size);
