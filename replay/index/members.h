/* The members of the structs that make up OpenGL's state (layout.txt), so that states can be looked through without a
 * line for each. */
#pragma once

#include <stddef.h>

struct member {
	const char *owner, *name;
	const char *type;           /* of its elements, as in C: "float", "struct gls_light"; "void *": a pointer */
	size_t offset, bytes, each; /* each: bytes of an element */
};

/** All of them, those of a struct one after the other. */
const struct member *members_all(size_t *n);
