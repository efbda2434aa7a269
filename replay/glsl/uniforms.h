/*
 * What of a program has locations: attributes, and uniforms, numbers in a row, in the order in which its stages were
 * met. A translation has them as its first constants, four numbers each, so that both stages read the same ones.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "replay/glsl/tree/tree.h"

/* A generic attribute of the vertex stage, as the program has bound it or was told. */
struct glsl_attribute {
	char *name; /* owned by whoever has the list */
	uint32_t location;
};

/* One that has a location: a number, vector, matrix or sampler, or an array of such. */
struct glsl_uniform {
	char *name;       /* owned; "lights[2].color"; without the brackets of an array of numbers */
	uint32_t kind, rows, columns, texture; /* as of struct glsl_type */
	uint32_t length;  /* of an array; else 1 */
	uint32_t first;   /* number */
	uint32_t location; /* of its first element, as the text gives it; GLSL_NONE: it does not */
};

/* One as the text declares it. */
struct glsl_uniform_root {
	char *name; /* owned */
	uint32_t first, numbers;
};

struct glsl_uniforms {
	struct glsl_uniform *list;       /* owned */
	struct glsl_uniform_root *roots; /* owned */
	float *values;                   /* owned; samplers: units. There are some zeros behind, to a whole number of fours */
	uint32_t n, room, n_roots, root_room, n_values, value_room;
};

/**
 * Add the uniforms that a stage names, built-in ones aside; those of this name are there once.
 * @param why  receives NULL, or what stands in the way
 * @return 0 or ERR_SYSTEM (reported)
 */
int glsl_uniforms_add(struct glsl_uniforms *u, const struct glsl_tree *tree, const char **why);

/** The first number of what the text calls so; GLSL_NONE: there is none. */
uint32_t glsl_uniforms_find(const struct glsl_uniforms *u, const char *name);

/**
 * What a location of this name sets.
 * @param element  receives the element of its array that is the first one set
 * @return NULL: there is none of this name
 */
const struct glsl_uniform *glsl_uniforms_named(const struct glsl_uniforms *u, const char *name, uint32_t *element);

void glsl_uniforms_free(struct glsl_uniforms *u);
