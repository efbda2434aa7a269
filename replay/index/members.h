/*
 * The members of the structs that make up OpenGL's state (layout.txt), so that code can walk a state without a line for
 * each.
 */
#pragma once

#include <stddef.h>

struct member {
	const char *owner, *name;
	const char *type;           /* element type, as in C: "float", "struct gls_light"; "void *": a pointer */
	size_t offset, bytes, each; /* each: size of an element in bytes */
};

/** All members; those of a struct are adjacent. */
const struct member *members_all(size_t *n);
