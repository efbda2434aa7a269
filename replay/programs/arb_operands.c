/* Parses the operands of ARB assembly programs: registers, constants and arrays. */
#include "replay/programs/arb_parser.h"

#include <string.h>

#include "base/err.h"
#include "replay/machine/state.h"
#include "replay/programs/arb_state.h"

#define ARB_MAX_OFFSET 4096u /* largest offset to an address, as in Mesa */


/* --- Registers and constants ------------------------------------------------------------------------------------ */

uint32_t arb_new_registers(struct arb_parser *p)
{
	struct program_code *code = p->emitter.code;

	if (code->n_registers + 4 > SCENE_PROGRAM_REGISTERS) {
		arb_fail(&p->words, "an ARB program uses too many registers");
		return code->n_registers - 4;
	}
	code->n_registers += 4;
	return code->n_registers - 4;
}

uint32_t arb_constant(struct arb_parser *p, const struct program_constant *c)
{
	const uint32_t operand = program_constant_operand(p->emitter.code, c);

	if (operand == UINT32_MAX)
		p->emitter.err = ERR_SYSTEM;
	return operand == UINT32_MAX ? SCENE_PROGRAM_CONSTANT : operand;
}

uint32_t arb_literal(struct arb_parser *p, float x, float y, float z, float w)
{
	return arb_constant(p, &(struct program_constant){ .source = PROGRAM_LITERAL, .value = { x, y, z, w } });
}

const struct arb_symbol *arb_find_symbol(const struct arb_parser *p, const char *name, size_t n)
{
	for (uint32_t i = 0; i < p->n_symbols; i++)
		if (p->symbols[i].n == n && memcmp(p->symbols[i].name, name, n) == 0)
			return &p->symbols[i];
	return NULL;
}

struct arb_symbol *arb_new_symbol(struct arb_parser *p)
{
	static struct arb_symbol nowhere;
	struct arb_symbol s = { 0 };

	s.n = arb_name(&p->words, &s.name);
	if (!s.n || arb_find_symbol(p, s.name, s.n) || p->n_symbols == ARB_MAX_SYMBOLS) {
		arb_fail(&p->words, p->n_symbols == ARB_MAX_SYMBOLS ? "an ARB program declares too many names" :
		                                                      arb_bad_grammar);
		return &nowhere;
	}
	p->symbols[p->n_symbols] = s;
	return &p->symbols[p->n_symbols++];
}

/* --- Operands ---------------------------------------------------------------------------------------------------- */

/* After `color`: 1 if the secondary colour is meant. A swizzle may follow. */
static uint32_t takes_secondary(struct arb_words *w)
{
	const struct arb_words before = *w;

	if (arb_takes(w, '.')) {
		if (arb_takes_name(w, "secondary"))
			return 1;
		if (!arb_takes_name(w, "primary"))
			*w = before;
	}
	return 0;
}

/* Parse the unit of `texcoord`. */
static uint32_t take_unit(struct arb_words *w)
{
	return arb_peek(w) == '[' ? arb_subscript(w, SCENE_MAX_UNITS) : 0;
}

static uint32_t take_named_attribute(struct arb_words *w)
{
	if (arb_takes_name(w, "position"))
		return SCENE_VERTEX_POSITION;
	if (arb_takes_name(w, "normal"))
		return SCENE_VERTEX_NORMAL;
	if (arb_takes_name(w, "color"))
		return takes_secondary(w) ? SCENE_VERTEX_SECONDARY : SCENE_VERTEX_COLOR;
	if (arb_takes_name(w, "fogcoord"))
		return SCENE_VERTEX_FOG;
	if (arb_takes_name(w, "texcoord"))
		return SCENE_VERTEX_TEXCOORD + take_unit(w);
	arb_fail(w, arb_bad_grammar); /* weights and matrix indices belong to extensions that Mesa does not have */
	return 0;
}

static uint32_t take_attribute(struct arb_parser *p)
{
	struct arb_words *w = &p->words;
	uint32_t number;

	if (!arb_takes_name(w, "attrib")) {
		number = take_named_attribute(w);
		p->named |= 1u << number;
		return number;
	}
	number = arb_subscript(w, 1 + SCENE_MAX_GENERICS);
	p->numbered |= 1u << number;
	return number ? SCENE_VERTEX_GENERIC + number - 1 : SCENE_VERTEX_POSITION;
}

static uint32_t take_fragment_input(struct arb_words *w)
{
	uint32_t input = SCENE_INPUT_COLOR;

	if (arb_takes_name(w, "color")) {
		input = takes_secondary(w) ? SCENE_INPUT_SECONDARY : SCENE_INPUT_COLOR;
	} else if (arb_takes_name(w, "texcoord")) {
		input = SCENE_INPUT_TEXCOORD + take_unit(w);
	} else if (arb_takes_name(w, "fogcoord")) {
		input = SCENE_INPUT_FOG;
	} else if (arb_takes_name(w, "position")) {
		input = SCENE_INPUT_POSITION;
	} else {
		arb_fail(w, arb_bad_grammar);
	}
	return input;
}

uint32_t arb_take_input(struct arb_parser *p)
{
	uint32_t input;

	arb_expect(&p->words, '.');
	input = p->is_vertex ? take_attribute(p) : take_fragment_input(&p->words);
	p->emitter.code->inputs |= 1u << input;
	return 4 * input;
}

/* After `result.color`: parse which of the four colours is meant. */
static uint32_t take_color_result(struct arb_words *w)
{
	const struct arb_words before = *w;
	uint32_t is_back = 0;

	if (arb_takes(w, '.')) {
		if (arb_takes_name(w, "back"))
			is_back = 1;
		else if (!arb_takes_name(w, "front"))
			*w = before;
	}
	if (takes_secondary(w))
		return is_back ? SCENE_RESULT_BACK_SECONDARY : SCENE_RESULT_SECONDARY;
	return is_back ? SCENE_RESULT_BACK_COLOR : SCENE_RESULT_COLOR;
}

static uint32_t take_result(struct arb_parser *p)
{
	struct arb_words *w = &p->words;

	if (arb_takes_name(w, "color"))
		return take_color_result(w);
	if (arb_takes_name(w, "fogcoord"))
		return SCENE_RESULT_FOG;
	if (arb_takes_name(w, "pointsize"))
		return SCENE_RESULT_POINT_SIZE;
	if (arb_takes_name(w, "texcoord"))
		return SCENE_RESULT_TEXCOORD + take_unit(w);
	if (!arb_takes_name(w, "position") || p->is_invariant)
		arb_fail(w, arb_bad_grammar);
	return SCENE_RESULT_POSITION;
}

uint32_t arb_take_output(struct arb_parser *p)
{
	struct arb_words *w = &p->words;
	uint32_t result;

	arb_expect(w, '.');
	if (p->is_vertex) {
		result = take_result(p);
		p->emitter.code->outputs |= 1u << result;
		return SCENE_VERTEX_RESULTS + 4 * result;
	}
	if (arb_takes_name(w, "depth")) {
		p->emitter.code->sets_depth = 1;
		return SCENE_PROGRAM_DEPTH - 2; /* only the third component counts */
	}
	if (!arb_takes_name(w, "color"))
		arb_fail(w, arb_bad_grammar);
	if (arb_peek(w) == '[' && arb_subscript(w, 1))
		arb_fail(w, arb_bad_grammar);
	return SCENE_PROGRAM_COLOR;
}

int arb_component_of(const struct arb_parser *p, char c)
{
	const char *letters = p->is_vertex ? "xyzw" : "xyzwrgba", *at = c ? strchr(letters, c) : NULL;

	return at ? (int)(at - letters) % 4 : -1;
}

/* A literal constant: {x, y, z, w}, or one number for all four. */
static void take_literal(struct arb_words *w, struct program_constant *to)
{
	uint32_t i = 0;

	*to = (struct program_constant){ .source = PROGRAM_LITERAL, .value = { 0, 0, 0, 1 } };
	if (!arb_takes(w, '{')) {
		to->value[0] = to->value[1] = to->value[2] = to->value[3] = arb_number(w);
		return;
	}
	do
		to->value[i++] = arb_number(w);
	while (i < 4 && arb_takes(w, ','));
	arb_expect(w, '}');
}

/* As arb_constant, for an array. */
static uint32_t element(struct arb_parser *p, const struct program_constant *c)
{
	const uint32_t number = program_constant_append(p->emitter.code, c);

	if (number == UINT32_MAX)
		p->emitter.err = ERR_SYSTEM;
	return number == UINT32_MAX ? SCENE_PROGRAM_CONSTANT : SCENE_PROGRAM_CONSTANT + 4 * number;
}

uint32_t arb_take_binding(struct arb_parser *p, int in_array)
{
	struct program_constant *bound = p->bound;
	struct arb_words *w = &p->words;
	uint32_t n = 1;

	if (arb_takes_name(w, "state")) {
		arb_expect(w, '.');
		n = arb_state(w, p->is_vertex, bound, ARB_MAX_ELEMENTS);
	} else if (arb_takes_name(w, "program")) {
		arb_expect(w, '.');
		n = arb_parameters(w, bound, ARB_MAX_ELEMENTS);
	} else {
		take_literal(w, &bound[0]);
	}
	if (p->n_elements + n > ARB_MAX_ELEMENTS)
		arb_fail(w, "an ARB program has too many parameters");
	for (uint32_t i = 0; i < n && !w->why; i++)
		p->elements[p->n_elements++] = in_array ? element(p, &bound[i]) : arb_constant(p, &bound[i]);
	return w->why ? 0 : n;
}

/* After an array's `[`, if a name follows: an element at an address plus an offset. @return its first register */
static uint32_t take_fetched(struct arb_parser *p, const struct arb_symbol *array)
{
	struct arb_words *w = &p->words;
	const char *name;
	const size_t n = arb_name(w, &name);
	const struct arb_symbol *address = arb_find_symbol(p, name, n);
	uint32_t *to = &p->fetched[p->n_fetched % 3];
	float offset = 0;

	if (!address || address->kind != ARB_IS_ADDRESS || !array->is_array)
		arb_fail(w, arb_bad_grammar);
	arb_expect(w, '.');
	if (arb_name(w, &name) != 1 || *name != 'x')
		arb_fail(w, arb_bad_grammar);
	if (arb_takes(w, '+'))
		offset = (float)arb_index(w, ARB_MAX_OFFSET);
	else if (arb_takes(w, '-'))
		offset = -(float)arb_index(w, ARB_MAX_OFFSET + 1);
	arb_expect(w, ']');
	*to = *to ? *to : arb_new_registers(p);
	p->n_fetched++;
	if (address && !w->why)
		emit_fetch(&p->emitter, *to, p->elements[array->first], array->count, address->first,
		           arb_literal(p, offset, 0, 0, 0));
	return *to;
}

/* An element of an array, or a parameter. */
static uint32_t take_element(struct arb_parser *p, const struct arb_symbol *s)
{
	struct arb_words *w = &p->words;
	uint32_t element = 0;

	if (arb_takes(w, '[')) {
		const char next = arb_peek(w);

		if (next < '0' || next > '9')
			return take_fetched(p, s);
		element = arb_index(w, s->count);
		arb_expect(w, ']');
	} else if (s->is_array) {
		arb_fail(w, arb_bad_grammar);
	}
	return w->why ? 0 : p->elements[s->first + element];
}

uint32_t arb_take_vector(struct arb_parser *p)
{
	struct arb_words *w = &p->words;
	struct arb_words before = *w;
	const char *name;
	const size_t n = arb_name(w, &name);
	const struct arb_symbol *s = n ? arb_find_symbol(p, name, n) : NULL;
	uint32_t is_bound = !s && (!n || arb_is(name, n, "state") || arb_is(name, n, "program"));

	if (n && arb_is(name, n, p->is_vertex ? "vertex" : "fragment"))
		return arb_take_input(p);
	if (is_bound) {
		*w = before;
		if (arb_take_binding(p, 0) != 1) {
			arb_fail(w, arb_bad_grammar);
			return 0;
		}
		return p->elements[--p->n_elements];
	}
	if (!s || s->kind == ARB_IS_ADDRESS) {
		arb_fail(w, arb_bad_grammar);
		return 0;
	}
	return s->kind == ARB_IS_REGISTER ? s->first : take_element(p, s);
}

struct emit_source arb_take_source(struct arb_parser *p)
{
	struct arb_words *w = &p->words;
	const uint32_t negated = arb_takes(w, '-');
	struct emit_source s, from;
	const char *name;
	size_t n;

	if (!negated)
		arb_takes(w, '+');
	from = emit_four(arb_take_vector(p));
	from.negated = negated ? 15 : 0;
	if (!arb_takes(w, '.'))
		return from;
	n = arb_name(w, &name);
	if (n != 1 && n != 4)
		arb_fail(w, arb_bad_grammar);
	s = from;
	for (uint32_t i = 0; i < 4 && !w->why; i++) {
		const int c = arb_component_of(p, name[n == 1 ? 0 : i]);

		if (c < 0)
			arb_fail(w, arb_bad_grammar);
		else
			s.number[i] = from.number[c];
	}
	return s;
}

struct emit_target arb_take_target(struct arb_parser *p, int saturates)
{
	struct arb_words *w = &p->words;
	struct emit_target to = { 0, 15, saturates };
	const char *name;
	size_t n = arb_name(w, &name);
	const struct arb_symbol *s = arb_find_symbol(p, name, n);

	if (arb_is(name, n, "result"))
		to.first = arb_take_output(p);
	else if (s && s->kind == ARB_IS_REGISTER &&
	         s->first >= (p->is_vertex ? SCENE_VERTEX_RESULTS : SCENE_PROGRAM_COLOR - 2))
		to.first = s->first;
	else
		arb_fail(w, arb_bad_grammar);
	if (arb_takes(w, '.')) {
		n = arb_name(w, &name);
		to.mask = 0;
		for (size_t i = 0; i < n && !w->why; i++) {
			const int c = arb_component_of(p, name[i]);

			if (c < 0 || to.mask >> c)
				arb_fail(w, arb_bad_grammar);
			else
				to.mask |= 1u << c;
		}
	}
	if (!p->is_vertex && to.first == SCENE_PROGRAM_DEPTH - 2)
		to.mask &= 4;
	return to;
}

uint32_t arb_take_address(struct arb_parser *p)
{
	struct arb_words *w = &p->words;
	const char *name;
	size_t n = arb_name(w, &name);
	const struct arb_symbol *s = arb_find_symbol(p, name, n);

	arb_expect(w, '.');
	if (!s || s->kind != ARB_IS_ADDRESS || arb_name(w, &name) != 1 || *name != 'x')
		arb_fail(w, arb_bad_grammar);
	return s && !w->why ? s->first : 0;
}

