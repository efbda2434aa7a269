/* Qualifiers of types (GLSL 1.50 sec. 4.3 to 4.7). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

struct parse_qualifiers {
	bool any, any_storage; /* any_storage: any of the next six */
	bool is_const, is_attribute, is_uniform, is_varying, is_in, is_out, is_invariant;
	bool flat, straight, smooth, centroid;
	uint32_t location, binding; /* GLSL_NONE: not given */
};

struct parse_qualifiers parse_qualifiers(struct parse *p);

/** The storage of a global variable. */
enum glsl_storage parse_global_storage(struct parse *p, const struct parse_qualifiers *q);

/** The storage of a parameter. */
enum glsl_storage parse_parameter_storage(struct parse *p, const struct parse_qualifiers *q);

/** Report an error if a type is not allowed for an attribute or varying. */
void parse_check_link(struct parse *p, const struct parse_qualifiers *q, enum glsl_storage storage,
                      const struct parse_type *type);
