/*
 * Attributes and uniforms of a program: variables that have locations. The numbers of uniforms are stored
 * consecutively, ordered by first use in the stages. In translated code they are the first constants, four numbers
 * each, so that both stages read the same ones.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "replay/glsl/tree/tree.h"

/* A generic attribute of the vertex stage, with the location that the program bound or queried. */
struct glsl_attribute {
	char *name; /* owned by the owner of the list */
	uint32_t location;
};

/* A uniform with a location of its own: a number, vector, matrix or sampler, or an array of these. */
struct glsl_uniform {
	char *name;       /* owned; for example "lights[2].color"; without the brackets of an array of numbers */
	uint32_t kind, rows, columns, texture; /* as in struct glsl_type */
	uint32_t length;  /* array length; otherwise 1 */
	uint32_t first;   /* index of its first number */
	uint32_t location; /* location of its first element, as given in the text; GLSL_NONE: not given */
};

/* A uniform as declared in the text. */
struct glsl_uniform_root {
	char *name; /* owned */
	uint32_t first, numbers;
};

struct glsl_uniforms {
	struct glsl_uniform *list;       /* owned */
	struct glsl_uniform_root *roots; /* owned */
	float *values;                   /* owned; units for samplers. Padded with zeros to a multiple of four */
	uint32_t n, room, n_roots, root_room, n_values, value_room;
};

/**
 * Add the uniforms of a stage, except built-in ones; those already present are shared.
 * @param why  receives NULL, or why the program cannot be run
 * @return 0 or ERR_SYSTEM (reported)
 */
int glsl_uniforms_add(struct glsl_uniforms *u, const struct glsl_tree *tree, const char **why);

/** Index of the first number of a declared uniform; GLSL_NONE: there is none of this name. */
uint32_t glsl_uniforms_find(const struct glsl_uniforms *u, const char *name);

/**
 * Find a uniform by the name that a program uses to ask for a location.
 * @param element  receives the index of the element that the name refers to
 * @return NULL: there is none of this name
 */
const struct glsl_uniform *glsl_uniforms_named(const struct glsl_uniforms *u, const char *name, uint32_t *element);

void glsl_uniforms_free(struct glsl_uniforms *u);
