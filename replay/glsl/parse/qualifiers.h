/* What stands before a type (GLSL 1.50 sec. 4.3 to 4.7). */
#pragma once

#include "replay/glsl/meaning/nodes.h"

struct parse_qualifiers {
	bool any, any_storage; /* any_storage: of the next six */
	bool is_const, is_attribute, is_uniform, is_varying, is_in, is_out, is_invariant;
	bool flat, straight, smooth, centroid;
	uint32_t location, binding; /* GLSL_NONE: none is given */
};

struct parse_qualifiers parse_qualifiers(struct parse *p);

/** What a variable outside of functions is. */
enum glsl_storage parse_global_storage(struct parse *p, const struct parse_qualifiers *q);

/** What a parameter is. */
enum glsl_storage parse_parameter_storage(struct parse *p, const struct parse_qualifiers *q);

/** End where a type cannot be handed from stage to stage, or to the first one. */
void parse_check_link(struct parse *p, const struct parse_qualifiers *q, enum glsl_storage storage,
                      const struct parse_type *type);
