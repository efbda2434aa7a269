/* Types. Equal types are the same object, so that pointers can be compared. */
#pragma once

#include "replay/glsl/text/context.h"

struct parse_member {
	struct parse_name *name;
	const struct parse_type *type;
};

/* One object for each combination of a name and members, whichever unit and scope it is in. */
struct parse_structure {
	struct parse_structure *next;
	struct parse_name *name;
	uint32_t n;
	struct parse_member *members;
};

struct parse_type {
	struct parse_type *next;
	enum glsl_kind kind;
	uint32_t rows, columns;  /* as in struct glsl_type */
	uint32_t texture;        /* with the bits of type_names.h */
	uint32_t length;         /* array length; 0: not known yet */
	uint32_t depth, numbers; /* depth: nesting depth of arrays and structures */
	uint32_t *number;        /* 1 + index in the tree; 0: not in the tree yet */
	const struct parse_type *element;
	struct parse_structure *structure;
	bool holds_sampler, holds_array, holds_whole; /* holds_whole: int or uint */
};

const struct parse_type *parse_type(struct parse *p, enum glsl_kind kind, uint32_t rows, uint32_t columns);
const struct parse_type *parse_type_sampler(struct parse *p, uint32_t texture);
const struct parse_type *parse_type_array(struct parse *p, const struct parse_type *element, uint32_t length);
const struct parse_type *parse_type_structure(struct parse *p, struct parse_name *name,
                                              const struct parse_member *members, uint32_t n);

static inline bool parse_type_is_number(const struct parse_type *t)
{
	return t->kind == GLSL_FLOAT || t->kind == GLSL_INT || t->kind == GLSL_UINT;
}
static inline bool parse_type_is_scalar(const struct parse_type *t)
{
	return t->kind >= GLSL_FLOAT && t->kind <= GLSL_BOOL && t->rows == 1 && !t->columns;
}
static inline bool parse_type_is_vector(const struct parse_type *t)
{
	return t->kind >= GLSL_FLOAT && t->kind <= GLSL_BOOL && t->rows > 1 && !t->columns;
}

/** The name of a type in messages; lives as long as the stage. */
const char *parse_type_text(struct parse *p, const struct parse_type *t);
