#include "replay/glsl/parse/qualifiers.h"

#include <string.h>

#include "replay/glsl/parse/expression.h"
#include "replay/glsl/parse/parser.h"
#include "replay/glsl/text/keywords.h"

static uint32_t layout_number(struct parse *p)
{
	const struct parse_node *node;

	parse_expect(p, '=');
	node = parse_assignment(p);
	if (!parse_is_constant(node) || node->type->kind != GLSL_INT || !parse_type_is_scalar(node->type) ||
	    node->numbers[0] < 0 || node->numbers[0] > PARSE_MAX_NUMBERS)
		parse_error(p, "a layout has an unsupported number");
	return (uint32_t)node->numbers[0];
}

/* Parse the rest of a `layout`. */
static void read_layout(struct parse *p, struct parse_qualifiers *q)
{
	static const char *const harmless[] = { "std140",         "shared",        "packed",
		                                "row_major",      "column_major",  "early_fragment_tests",
		                                "depth_any",      "depth_greater", "depth_less",
		                                "depth_unchanged" };

	parse_expect(p, '(');
	do {
		const struct parse_token word = p->now;
		bool is_known = false;

		if (word.kind != PARSE_NAME)
			parse_unexpected(p);
		parse_advance(p);
		if (parse_is_word(&word, "origin_upper_left") || parse_is_word(&word, "pixel_center_integer"))
			parse_refuse(p, "a shader has an unsupported layout of gl_FragCoord");
		if (parse_is_word(&word, "location"))
			q->location = layout_number(p);
		else if (parse_is_word(&word, "binding"))
			q->binding = layout_number(p);
		else if (parse_is_word(&word, "index") || parse_is_word(&word, "offset") ||
		         parse_is_word(&word, "component"))
			layout_number(p);
		else {
			for (unsigned i = 0; i < sizeof(harmless) / sizeof(harmless[0]); i++)
				is_known |= parse_is_word(&word, harmless[i]);
			if (!is_known)
				parse_error(p, "there is no layout '%s'", word.name->text);
		}
	} while (parse_accept(p, ','));
	parse_expect(p, ')');
}

struct parse_qualifiers parse_qualifiers(struct parse *p)
{
	struct parse_qualifiers q = { .location = GLSL_NONE, .binding = GLSL_NONE };

	for (;; q.any = true) {
		bool *to = NULL, twice = false;

		switch (parse_keyword(p, &p->now)) {
		case PARSE_CONST: to = &q.is_const; break;
		case PARSE_ATTRIBUTE: to = &q.is_attribute; break;
		case PARSE_UNIFORM: to = &q.is_uniform; break;
		case PARSE_VARYING: to = &q.is_varying; break;
		case PARSE_IN: to = &q.is_in; break;
		case PARSE_OUT: to = &q.is_out; break;
		case PARSE_INVARIANT: to = &q.is_invariant; break;
		case PARSE_FLAT: to = &q.flat; break;
		case PARSE_NOPERSPECTIVE: to = &q.straight; break;
		case PARSE_SMOOTH: to = &q.smooth; break;
		case PARSE_CENTROID: to = &q.centroid; break;
		case PARSE_INOUT:
			twice = q.is_in || q.is_out;
			q.is_in = q.is_out = true;
			break;
		case PARSE_LOWP:
		case PARSE_PRECISE: break;
		case PARSE_LAYOUT:
			parse_advance(p);
			read_layout(p, &q);
			continue;
		default:
			q.any_storage = q.is_const || q.is_attribute || q.is_uniform || q.is_varying || q.is_in ||
			                q.is_out;
			return q;
		}
		if (twice || (to && *to))
			parse_error(p, "'%s' is repeated", p->now.name->text);
		if (to)
			*to = true;
		parse_advance(p);
	}
}

enum glsl_storage parse_global_storage(struct parse *p, const struct parse_qualifiers *q)
{
	const bool is_vertex = p->stage == GLSL_VERTEX_STAGE;
	const unsigned n = q->is_const + q->is_attribute + q->is_uniform + q->is_varying + q->is_in + q->is_out;

	if (n > 1)
		parse_error(p, "a variable has several storage qualifiers");
	if ((q->is_in || q->is_out) && !parse_has(p, 130, 0))
		parse_error(p, "'in' and 'out' outside of functions need GLSL 1.30");
	if (q->location != GLSL_NONE && !q->is_uniform && !(is_vertex ? q->is_in || q->is_attribute : q->is_out))
		parse_refuse(p, "a shader has locations of varyings, which are not supported");
	if (q->is_invariant && !(q->is_varying || (is_vertex ? q->is_out : q->is_in || q->is_out)))
		parse_error(p, "a variable that is not an output is invariant");
	if (q->is_attribute && !is_vertex)
		parse_error(p, "a fragment shader has attributes");
	if (q->is_const)
		return GLSL_CONSTANT_VALUE;
	if (q->is_uniform)
		return GLSL_UNIFORM;
	if (q->is_attribute || q->is_in || (q->is_varying && !is_vertex))
		return GLSL_INPUT;
	return q->is_out || q->is_varying ? GLSL_OUTPUT : GLSL_GLOBAL;
}

enum glsl_storage parse_parameter_storage(struct parse *p, const struct parse_qualifiers *q)
{
	if (q->is_attribute || q->is_uniform || q->is_varying || q->is_invariant || (q->is_const && q->is_out))
		parse_error(p, "a parameter has an invalid storage qualifier");
	return q->is_out ? q->is_in ? GLSL_INOUT : GLSL_OUT : GLSL_IN;
}

/* The kind of an array's numbers; GLSL_STRUCT if there are several. */
static enum glsl_kind kind_inside(const struct parse_type *type)
{
	while (type->kind == GLSL_ARRAY)
		type = type->element;
	return type->kind;
}

void parse_check_link(struct parse *p, const struct parse_qualifiers *q, enum glsl_storage storage,
                      const struct parse_type *type)
{
	const enum glsl_kind kind = kind_inside(type);

	if ((storage != GLSL_INPUT && storage != GLSL_OUTPUT) || p->is_prelude)
		return;
	if (type->holds_sampler || kind == GLSL_BOOL ||
	    (kind != GLSL_FLOAT && p->version < 130 && !(p->extensions & PARSE_GPU_SHADER4)))
		parse_error(p, "%s cannot be passed to or from a stage", parse_type_text(p, type));
	if (storage == GLSL_INPUT && p->stage == GLSL_VERTEX_STAGE &&
	    (kind == GLSL_STRUCT || (type->kind == GLSL_ARRAY && p->version < 130)))
		parse_error(p, "an attribute has type %s", parse_type_text(p, type));
	if (storage == GLSL_INPUT && p->stage == GLSL_FRAGMENT_STAGE && type->holds_whole && !q->flat)
		parse_error(p, "an integer input of a fragment shader is not flat");
}
