/* Parses ARB assembly programs statement by statement. */
#include "replay/programs/arb.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "replay/machine/state.h"
#include "replay/programs/arb_parser.h"
#include "replay/programs/fold.h"

#define MAX_TEXT 1048576u

/* TEMP a, b and ADDRESS a, b. */
static void take_registers(struct arb_parser *p, uint32_t kind)
{
	do {
		struct arb_symbol *s = arb_new_symbol(p);

		s->kind = kind;
		s->first = arb_new_registers(p);
	} while (!p->words.why && arb_takes(&p->words, ','));
}

/* PARAM a = b, or PARAM a[n] = { b, c }. */
static void take_parameter(struct arb_parser *p)
{
	struct arb_words *w = &p->words;
	struct arb_symbol *s = arb_new_symbol(p);
	uint32_t size = 0, is_array = arb_takes(w, '[');

	if (is_array && arb_peek(w) != ']')
		size = arb_index(w, ARB_MAX_ELEMENTS);
	if (is_array)
		arb_expect(w, ']');
	arb_expect(w, '=');
	s->kind = ARB_IS_PARAMETER;
	s->is_array = (int)is_array;
	s->first = p->n_elements;
	s->count = 0;
	if (is_array) {
		arb_expect(w, '{');
		do
			s->count += arb_take_binding(p, 1);
		while (!w->why && arb_takes(w, ','));
		arb_expect(w, '}');
	} else {
		s->count = arb_take_binding(p, 0);
	}
	if (!s->count || (size && size != s->count) || (!is_array && s->count != 1))
		arb_fail(w, arb_bad_grammar);
}

/* ATTRIB a = fragment.x or vertex.x, OUTPUT a = result.x, ALIAS a = b. kind: the statement's first letters */
static void take_name_for(struct arb_parser *p, char kind)
{
	struct arb_words *w = &p->words;
	struct arb_symbol *s = arb_new_symbol(p);
	const struct arb_symbol *other;
	const char *name;
	size_t n;

	arb_expect(w, '=');
	n = arb_name(w, &name);
	s->kind = ARB_IS_REGISTER;
	if (kind == 'T' && arb_is(name, n, p->is_vertex ? "vertex" : "fragment")) {
		s->first = arb_take_input(p);
	} else if (kind == 'O' && arb_is(name, n, "result")) {
		s->first = arb_take_output(p);
	} else if (kind == 'L' && (other = arb_find_symbol(p, name, n)) && other != s) {
		s->kind = other->kind;
		s->first = other->first;
		s->count = other->count;
		s->is_array = other->is_array;
	} else {
		arb_fail(w, arb_bad_grammar);
	}
}

static void take_option(struct arb_parser *p)
{
	static const char *const harmless[] = { "ARB_precision_hint_fastest", "ARB_precision_hint_nicest",
		                                "ARB_draw_buffers", "ATI_draw_buffers", "ARB_fragment_program_shadow" };
	const char *name;
	const size_t n = arb_name(&p->words, &name);

	if (p->is_vertex) {
		p->is_invariant = arb_is(name, n, "ARB_position_invariant");
		if (!p->is_invariant)
			arb_fail(&p->words, arb_bad_grammar);
		return;
	}
	for (size_t i = 0; i < sizeof(harmless) / sizeof(harmless[0]); i++)
		if (arb_is(name, n, harmless[i]))
			return;
	if (arb_is(name, n, "ARB_fog_linear"))
		p->fog = ARB_FOG_LINEAR;
	else if (arb_is(name, n, "ARB_fog_exp"))
		p->fog = ARB_FOG_EXP;
	else if (arb_is(name, n, "ARB_fog_exp2"))
		p->fog = ARB_FOG_EXP2;
	else
		arb_fail(&p->words, "an ARB program has an unsupported option");
}

static void take_statement(struct arb_parser *p, const char *name, size_t n)
{
	if (arb_is(name, n, "TEMP"))
		take_registers(p, ARB_IS_REGISTER);
	else if (p->is_vertex && arb_is(name, n, "ADDRESS"))
		take_registers(p, ARB_IS_ADDRESS);
	else if (arb_is(name, n, "PARAM"))
		take_parameter(p);
	else if (arb_is(name, n, "ATTRIB"))
		take_name_for(p, 'T');
	else if (arb_is(name, n, "OUTPUT"))
		take_name_for(p, 'O');
	else if (arb_is(name, n, "ALIAS"))
		take_name_for(p, 'L');
	else if (arb_is(name, n, "OPTION"))
		take_option(p);
	else
		arb_take_instruction(p, name, n);
	arb_expect(&p->words, ';');
}

/* The fog that an option selects (section 3.11.4.5.1), applied to the program's colour. */
static void add_fog(struct arb_parser *p)
{
	struct emitter *e = &p->emitter;
	const uint32_t numbers = arb_constant(p, &(struct program_constant){ .source = PROGRAM_FOG_NUMBERS });
	const uint32_t color = arb_constant(p, &(struct program_constant){ .source = PROGRAM_FOG_COLOR });
	const struct emit_source four = emit_four(numbers), density = emit_splat(&four, 0), end = emit_splat(&four, 2),
				 scale = emit_splat(&four, 3);
	const struct emit_source in = emit_four(4 * SCENE_INPUT_FOG), at = emit_splat(&in, 0),
				 aside = emit_four(e->scratch + 4);
	const struct emit_source log2_e = { { arb_literal(p, 1.44269504f, 0, 0, 0) }, 0 }, fog = emit_four(color),
				 own = emit_four(SCENE_PROGRAM_COLOR);
	const struct emit_target one = { e->scratch + 4, 1, 0 }, factor = { e->scratch + 4, 1, 1 },
				 rgb = { SCENE_PROGRAM_COLOR, 7, 0 };
	struct emit_source x = emit_splat(&aside, 0), back = at;

	p->emitter.code->inputs |= 1u << SCENE_INPUT_FOG;
	if (p->fog == ARB_FOG_LINEAR) {
		back.negated = 15;
		emit_vector(e, SCENE_OP_ADD, &one, &end, &back, NULL);
		emit_vector(e, SCENE_OP_MULTIPLY, &factor, &x, &scale, NULL);
	} else {
		emit_vector(e, SCENE_OP_MULTIPLY, &one, &density, &at, NULL);
		if (p->fog == ARB_FOG_EXP2)
			emit_vector(e, SCENE_OP_MULTIPLY, &one, &x, &x, NULL);
		emit_vector(e, SCENE_OP_MULTIPLY, &one, &x, &log2_e, NULL);
		x.negated = 15;
		emit_vector(e, SCENE_OP_EXP2, &factor, &x, NULL, NULL);
		x.negated = 0;
	}
	/* f own + (1 - f) fog, computed as fog + f (own - fog) */
	back = fog;
	back.negated = 15;
	emit_vector(e, SCENE_OP_MOVE, &(struct emit_target){ SCENE_PROGRAM_COLOR, 15, 1 }, &own, NULL, NULL);
	emit_vector(e, SCENE_OP_ADD, &rgb, &own, &back, NULL);
	emit_vector(e, SCENE_OP_MAD, &rgb, &own, &x, &fog);
}

/*
 * 1 if an attribute is used both by number and by name, with the aliases of Mesa (22.3.6), which differ from those of
 * ARB_vertex_program.
 */
static int is_named_twice(const struct arb_parser *p)
{
	const uint32_t first = (1u << SCENE_VERTEX_TEXCOORD) - 1;

	return p->numbered & ((p->named & first) | p->named >> SCENE_VERTEX_TEXCOORD << 6);
}

/* All statements up to END. */
static void take_program(struct arb_parser *p)
{
	const char *header = p->is_vertex ? "!!ARBvp1.0" : "!!ARBfp1.0";
	struct arb_words *w = &p->words;
	const char *name;
	size_t n;

	arb_peek(w); /* Mesa skips blanks and comments there, too */
	if ((size_t)(w->end - w->at) < strlen(header) || memcmp(w->at, header, strlen(header)) != 0) {
		arb_fail(w, arb_bad_grammar);
		return;
	}
	w->at += strlen(header);
	while (!w->why && !p->emitter.err) {
		n = arb_name(w, &name);
		if (!n || arb_is(name, n, "END"))
			break;
		take_statement(p, name, n);
	}
	if (!w->why && !p->emitter.err && !arb_is(name, n, "END"))
		arb_fail(w, arb_bad_grammar);
	if (is_named_twice(p))
		arb_fail(w, arb_bad_grammar);
	if (!w->why && p->fog)
		add_fog(p);
}

int program_translate_arb(const char *text, size_t n, int is_vertex, struct program_code *code, const char **why)
{
	struct arb_parser *p = calloc(1, sizeof(*p));
	int err;

	if (!p)
		return err_report(ERR_SYSTEM, NULL, "out of memory for a program");
	p->is_vertex = is_vertex;
	code->n_registers = is_vertex ? SCENE_VERTEX_FIRST : SCENE_PROGRAM_FIRST;
	p->words = (struct arb_words){ text, text + n, n > MAX_TEXT ? "an ARB program is longer than a megabyte" : NULL };
	p->emitter.code = code;
	p->emitter.scratch = arb_new_registers(p);
	arb_new_registers(p);
	if (!p->words.why)
		take_program(p);
	if (p->emitter.err == ERR_INPUT)
		arb_fail(&p->words, "an ARB program has too many instructions");
	*why = p->words.why;
	err = p->emitter.err == ERR_SYSTEM ? ERR_SYSTEM : 0;
	if (!err && !p->words.why)
		err = program_fold(code);
	free(p);
	return err;
}
