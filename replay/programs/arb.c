#include "replay/programs/arb.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "replay/machine/state.h"
#include "replay/programs/arb_state.h"
#include "replay/programs/arb_words.h"
#include "replay/programs/code.h"
#include "replay/programs/emit.h"

#define MAX_SYMBOLS 512u
#define MAX_ELEMENTS 2048u /* of parameters, arrays' included */
#define MAX_TEXT 1048576u

static const char bad_grammar[] = "an ARB program breaks the grammar";

struct symbol {
	const char *name;
	size_t n;
	enum { IS_REGISTER, IS_PARAMETER } kind;
	uint32_t first, count; /* the first of four registers; elements of arb_parser.elements */
};

struct parser {
	struct arb_words words;
	struct emitter emitter;
	struct symbol symbols[MAX_SYMBOLS];
	uint32_t elements[MAX_ELEMENTS]; /* numbers of constants */
	uint32_t n_symbols, n_elements;
	enum { NO_FOG, FOG_LINEAR, FOG_EXP, FOG_EXP2 } fog;
};

/* --- Registers and constants ----------------------------------------------------------------------------------------- */

/* Four registers of the program's own. */
static uint32_t new_registers(struct parser *p)
{
	struct program_code *code = p->emitter.code;

	if (code->n_registers + 4 > SCENE_PROGRAM_REGISTERS) {
		arb_fail(&p->words, "an ARB program keeps more numbers at once than are done");
		return SCENE_PROGRAM_FIRST;
	}
	code->n_registers += 4;
	return code->n_registers - 4;
}

/* The operand that stands for a constant's first number. */
static uint32_t constant(struct parser *p, const struct program_constant *c)
{
	const uint32_t number = program_constant(p->emitter.code, c);

	if (number == UINT32_MAX)
		p->emitter.err = ERR_SYSTEM;
	return number == UINT32_MAX ? SCENE_PROGRAM_CONSTANT : SCENE_PROGRAM_CONSTANT + 4 * number;
}

static uint32_t literal(struct parser *p, float x, float y, float z, float w)
{
	return constant(p, &(struct program_constant){ .source = PROGRAM_LITERAL, .value = { x, y, z, w } });
}

static const struct symbol *find_symbol(const struct parser *p, const char *name, size_t n)
{
	for (uint32_t i = 0; i < p->n_symbols; i++)
		if (p->symbols[i].n == n && memcmp(p->symbols[i].name, name, n) == 0)
			return &p->symbols[i];
	return NULL;
}

static struct symbol *new_symbol(struct parser *p)
{
	static struct symbol nowhere;
	struct symbol s = { 0 };

	s.n = arb_name(&p->words, &s.name);
	if (!s.n || find_symbol(p, s.name, s.n) || p->n_symbols == MAX_SYMBOLS) {
		arb_fail(&p->words, p->n_symbols == MAX_SYMBOLS ? "an ARB program has more names than are done" : bad_grammar);
		return &nowhere;
	}
	p->symbols[p->n_symbols] = s;
	return &p->symbols[p->n_symbols++];
}

/* --- Operands ---------------------------------------------------------------------------------------------------------- */

/* After `fragment`: the first register of an input. */
static uint32_t take_input(struct parser *p)
{
	struct arb_words *w = &p->words;
	enum scene_program_input input = SCENE_INPUT_COLOR;
	struct arb_words before;

	arb_expect(w, '.');
	if (arb_takes_name(w, "color")) {
		before = *w;
		if (!arb_takes(w, '.'))
			input = SCENE_INPUT_COLOR;
		else if (arb_takes_name(w, "secondary"))
			input = SCENE_INPUT_SECONDARY;
		else if (!arb_takes_name(w, "primary"))
			*w = before; /* a swizzle */
	} else if (arb_takes_name(w, "texcoord")) {
		input = SCENE_INPUT_TEXCOORD + (arb_peek(w) == '[' ? arb_subscript(w, SCENE_MAX_UNITS) : 0);
	} else if (arb_takes_name(w, "fogcoord")) {
		input = SCENE_INPUT_FOG;
	} else if (arb_takes_name(w, "position")) {
		input = SCENE_INPUT_POSITION;
	} else {
		arb_fail(w, bad_grammar);
	}
	p->emitter.code->inputs |= 1u << input;
	return 4 * input;
}

/* After `result`: the first register of an output. */
static uint32_t take_output(struct parser *p)
{
	struct arb_words *w = &p->words;

	arb_expect(w, '.');
	if (arb_takes_name(w, "depth")) {
		p->emitter.code->sets_depth = 1;
		return SCENE_PROGRAM_DEPTH - 2; /* the third component is what counts */
	}
	if (!arb_takes_name(w, "color"))
		arb_fail(w, bad_grammar);
	if (arb_peek(w) == '[' && arb_subscript(w, 1))
		arb_fail(w, bad_grammar);
	return SCENE_PROGRAM_COLOR;
}

/* Bit i of the swizzle's component i; -1 where it is no letter of one. */
static int component_of(char c)
{
	const char *letters = "xyzwrgba", *at = c ? strchr(letters, c) : NULL;

	return at ? (int)(at - letters) % 4 : -1;
}

/* A constant in the text: {x, y, z, w}, or a number for all four. */
static uint32_t take_literal(struct parser *p)
{
	struct arb_words *w = &p->words;
	float v[4] = { 0, 0, 0, 1 };
	uint32_t i = 0;

	if (!arb_takes(w, '{')) {
		v[0] = arb_number(w);
		return literal(p, v[0], v[0], v[0], v[0]);
	}
	do
		v[i++] = arb_number(w);
	while (i < 4 && arb_takes(w, ','));
	arb_expect(w, '}');
	return literal(p, v[0], v[1], v[2], v[3]);
}

/* Constants that a binding names, into elements. @return how many */
static uint32_t take_binding(struct parser *p)
{
	struct program_constant bound[32];
	struct arb_words *w = &p->words;
	uint32_t n = 1;

	if (p->n_elements + 32 > MAX_ELEMENTS)
		arb_fail(w, "an ARB program has more parameters than are done");
	if (arb_takes_name(w, "state")) {
		arb_expect(w, '.');
		n = arb_state(w, bound, 32);
	} else if (arb_takes_name(w, "program")) {
		arb_expect(w, '.');
		n = arb_parameters(w, bound, 32);
	} else {
		const uint32_t operand = take_literal(p);

		if (!w->why)
			p->elements[p->n_elements++] = operand;
		return w->why ? 0 : 1;
	}
	for (uint32_t i = 0; i < n && !w->why; i++)
		p->elements[p->n_elements++] = constant(p, &bound[i]);
	return w->why ? 0 : n;
}

/* The first of an operand's four numbers, before any swizzle. */
static uint32_t take_vector(struct parser *p)
{
	struct arb_words *w = &p->words;
	struct arb_words before = *w;
	const char *name;
	const size_t n = arb_name(w, &name);
	const struct symbol *s = n ? find_symbol(p, name, n) : NULL;
	uint32_t element, is_bound = !s && (!n || arb_is(name, n, "state") || arb_is(name, n, "program"));

	if (n && arb_is(name, n, "fragment"))
		return take_input(p);
	if (is_bound) {
		*w = before;
		if (take_binding(p) != 1) {
			arb_fail(w, bad_grammar);
			return 0;
		}
		return p->elements[--p->n_elements];
	}
	if (!s) {
		arb_fail(w, bad_grammar);
		return 0;
	}
	if (s->kind == IS_REGISTER)
		return s->first;
	element = arb_peek(w) == '[' ? arb_subscript(w, s->count) : 0;
	return p->elements[s->first + element];
}

static struct emit_source take_source(struct parser *p)
{
	struct arb_words *w = &p->words;
	const uint32_t negated = arb_takes(w, '-');
	struct emit_source s, from;
	const char *name;
	size_t n;

	if (!negated)
		arb_takes(w, '+');
	from = emit_four(take_vector(p));
	from.negated = negated ? 15 : 0;
	if (!arb_takes(w, '.'))
		return from;
	n = arb_name(w, &name);
	if (n != 1 && n != 4)
		arb_fail(w, bad_grammar);
	s = from;
	for (uint32_t i = 0; i < 4 && !w->why; i++) {
		const int c = component_of(name[n == 1 ? 0 : i]);

		if (c < 0)
			arb_fail(w, bad_grammar);
		else
			s.number[i] = from.number[c];
	}
	return s;
}

static struct emit_target take_target(struct parser *p, int saturates)
{
	struct arb_words *w = &p->words;
	struct emit_target to = { 0, 15, saturates };
	const char *name;
	size_t n = arb_name(w, &name);
	const struct symbol *s = find_symbol(p, name, n);

	if (arb_is(name, n, "result"))
		to.first = take_output(p);
	else if (s && s->kind == IS_REGISTER && s->first >= SCENE_PROGRAM_COLOR - 2)
		to.first = s->first;
	else
		arb_fail(w, bad_grammar);
	if (arb_takes(w, '.')) {
		n = arb_name(w, &name);
		to.mask = 0;
		for (size_t i = 0; i < n && !w->why; i++) {
			const int c = component_of(name[i]);

			if (c < 0 || to.mask >> c)
				arb_fail(w, bad_grammar);
			else
				to.mask |= 1u << c;
		}
	}
	if (to.first == SCENE_PROGRAM_DEPTH - 2)
		to.mask &= 4;
	return to;
}

/* --- Instructions ------------------------------------------------------------------------------------------------------ */

typedef void instruction(struct parser *p, const struct emit_target *to, const struct emit_source s[3]);

static struct emit_target part_of(const struct emit_target *to, uint32_t mask)
{
	return (struct emit_target){ to->first, to->mask & mask, to->saturates };
}

/* Move what was computed aside to where it belongs. */
static void move_from(struct parser *p, const struct emit_target *to, uint32_t first)
{
	const struct emit_source from = emit_four(first);

	emit_vector(&p->emitter, SCENE_OP_MOVE, to, &from, NULL, NULL);
}

static void do_sub(struct parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	struct emit_source b = s[1];

	b.negated ^= 15;
	emit_vector(&p->emitter, SCENE_OP_ADD, to, &s[0], &b, NULL);
}

static void do_dp3(struct parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	emit_dot(&p->emitter, to, &s[0], &s[1], 3, 0);
}

static void do_dp4(struct parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	emit_dot(&p->emitter, to, &s[0], &s[1], 4, 0);
}

static void do_dph(struct parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	emit_dot(&p->emitter, to, &s[0], &s[1], 3, 1);
}

/* 1, a.y b.y, a.z, b.w */
static void do_dst(struct parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	const uint32_t one = literal(p, 1, 1, 1, 1);
	const struct emit_source a = { { one, s[0].number[1], s[0].number[2], one }, s[0].negated & 6 };
	const struct emit_source b = { { one, s[1].number[1], one, s[1].number[3] }, s[1].negated & 10 };

	emit_vector(&p->emitter, SCENE_OP_MULTIPLY, to, &a, &b, NULL);
}

static void do_lrp(struct parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	const uint32_t aside = p->emitter.scratch + 4;
	const struct emit_target difference = { aside, 15, 0 };
	const struct emit_source d = emit_four(aside);
	struct emit_source c = s[2];

	c.negated ^= 15;
	emit_vector(&p->emitter, SCENE_OP_ADD, &difference, &s[1], &c, NULL);
	emit_vector(&p->emitter, SCENE_OP_MAD, to, &s[0], &d, &s[2]);
}

static void do_xpd(struct parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	static const uint32_t next[4] = { 1, 2, 0, 3 }, last[4] = { 2, 0, 1, 3 };
	const uint32_t aside = p->emitter.scratch + 4;
	const struct emit_target product = { aside, 7, 0 }, result = part_of(to, 7);
	const struct emit_source d = emit_four(aside);
	struct emit_source a[2], b[2];

	for (uint32_t i = 0; i < 4; i++) {
		a[0].number[i] = s[0].number[next[i]];
		a[1].number[i] = s[0].number[last[i]];
		b[0].number[i] = s[1].number[last[i]];
		b[1].number[i] = s[1].number[next[i]];
	}
	a[0].negated = a[1].negated = s[0].negated;
	b[0].negated = b[1].negated = s[1].negated;
	a[1].negated ^= 15;
	emit_vector(&p->emitter, SCENE_OP_MULTIPLY, &product, &a[1], &b[1], NULL);
	emit_vector(&p->emitter, SCENE_OP_MAD, &result, &a[0], &b[0], &d);
}

static void do_scs(struct parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	const struct emit_source angle = emit_splat(&s[0], 0);
	const uint32_t aside = p->emitter.scratch + 4;
	const struct emit_target x = { aside, 1, 0 }, y = { aside, 2, 0 }, result = part_of(to, 3);

	emit_vector(&p->emitter, SCENE_OP_COSINE, &x, &angle, NULL, NULL);
	emit_vector(&p->emitter, SCENE_OP_SINE, &y, &angle, NULL, NULL);
	move_from(p, &result, aside);
}

/* 1, max(x, 0), x > 0 ? max(y, 0) to the power of w within 128 : 0, 1 */
static void do_lit(struct parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	struct emitter *e = &p->emitter;
	const uint32_t limits = literal(p, 0, 1, 128, -128), aside = e->scratch + 4;
	const struct emit_source four = emit_four(limits), zero = emit_splat(&four, 0), most = emit_splat(&four, 2), least = emit_splat(&four, 3);
	const struct emit_source in = { { limits + 1, s[0].number[0], s[0].number[1], s[0].number[3] },
		                        (s[0].negated & 1) << 1 | (s[0].negated & 2) << 1 | (s[0].negated & 8) };
	const struct emit_source d = emit_four(aside), power = emit_splat(&d, 2), shine = emit_splat(&d, 3);
	const struct emit_target all = { aside, 15, 0 }, middle = { aside, 6, 0 }, z = { aside, 4, 0 }, w = { aside, 8, 0 };
	struct emit_source below = emit_splat(&d, 1);

	emit_vector(e, SCENE_OP_MOVE, &all, &in, NULL, NULL);
	emit_vector(e, SCENE_OP_MAXIMUM, &middle, &d, &zero, NULL);
	emit_vector(e, SCENE_OP_MAXIMUM, &w, &shine, &least, NULL);
	emit_vector(e, SCENE_OP_MINIMUM, &w, &shine, &most, NULL);
	emit_vector(e, SCENE_OP_POWER, &z, &power, &shine, NULL);
	below.negated = 15;
	emit_vector(e, SCENE_OP_SELECT, &z, &below, &power, &zero);
	emit_vector(e, SCENE_OP_MOVE, &w, &(struct emit_source){ { limits + 1, limits + 1, limits + 1, limits + 1 }, 0 }, NULL, NULL);
	move_from(p, to, aside);
}

static const struct {
	const char *name;
	uint32_t n_sources;
	enum { BY_COMPONENT, BY_NUMBER, OTHERWISE } how;
	enum scene_operation operation;
	instruction *otherwise;
} instructions[] = {
	{ "ABS", 1, BY_COMPONENT, SCENE_OP_ABSOLUTE, NULL }, { "ADD", 2, BY_COMPONENT, SCENE_OP_ADD, NULL },
	{ "CMP", 3, BY_COMPONENT, SCENE_OP_SELECT, NULL }, { "COS", 1, BY_NUMBER, SCENE_OP_COSINE, NULL },
	{ "DP3", 2, OTHERWISE, 0, do_dp3 }, { "DP4", 2, OTHERWISE, 0, do_dp4 }, { "DPH", 2, OTHERWISE, 0, do_dph },
	{ "DST", 2, OTHERWISE, 0, do_dst }, { "EX2", 1, BY_NUMBER, SCENE_OP_EXP2, NULL },
	{ "FLR", 1, BY_COMPONENT, SCENE_OP_FLOOR, NULL }, { "FRC", 1, BY_COMPONENT, SCENE_OP_FRACTION, NULL },
	{ "LG2", 1, BY_NUMBER, SCENE_OP_LOG2, NULL }, { "LIT", 1, OTHERWISE, 0, do_lit }, { "LRP", 3, OTHERWISE, 0, do_lrp },
	{ "MAD", 3, BY_COMPONENT, SCENE_OP_MAD, NULL }, { "MAX", 2, BY_COMPONENT, SCENE_OP_MAXIMUM, NULL },
	{ "MIN", 2, BY_COMPONENT, SCENE_OP_MINIMUM, NULL }, { "MOV", 1, BY_COMPONENT, SCENE_OP_MOVE, NULL },
	{ "MUL", 2, BY_COMPONENT, SCENE_OP_MULTIPLY, NULL }, { "POW", 2, BY_NUMBER, SCENE_OP_POWER, NULL },
	{ "RCP", 1, BY_NUMBER, SCENE_OP_RECIPROCAL, NULL }, { "RSQ", 1, BY_NUMBER, SCENE_OP_INVERSE_ROOT, NULL },
	{ "SCS", 1, OTHERWISE, 0, do_scs }, { "SGE", 2, BY_COMPONENT, SCENE_OP_GREATER_EQUAL, NULL },
	{ "SIN", 1, BY_NUMBER, SCENE_OP_SINE, NULL }, { "SLT", 2, BY_COMPONENT, SCENE_OP_LESS, NULL },
	{ "SUB", 2, OTHERWISE, 0, do_sub }, { "XPD", 2, OTHERWISE, 0, do_xpd },
};

/* SWZ: each component by itself, or a constant 0 or 1. */
static void take_extended_swizzle(struct parser *p, const struct emit_target *to)
{
	struct arb_words *w = &p->words;
	const struct emit_source from = emit_four(take_vector(p));
	const uint32_t numbers = literal(p, 0, 1, 128, -128);
	struct emit_source s = { { 0 }, 0 };

	for (uint32_t i = 0; i < 4 && !w->why; i++) {
		const char *name;
		int c;

		arb_expect(w, ',');
		if (arb_takes(w, '-'))
			s.negated |= 1u << i;
		else
			arb_takes(w, '+');
		if (arb_peek(w) == '0' || arb_peek(w) == '1') {
			s.number[i] = numbers + arb_index(w, 2);
			continue;
		}
		c = arb_name(w, &name) == 1 ? component_of(*name) : -1;
		if (c < 0)
			arb_fail(w, bad_grammar);
		else
			s.number[i] = from.number[c];
	}
	if (!w->why)
		emit_vector(&p->emitter, SCENE_OP_MOVE, to, &s, NULL, NULL);
}

static void take_texture(struct parser *p, const struct emit_target *to, uint32_t flags)
{
	static const struct {
		const char *name;
		enum gls_texture_target target;
	} targets[] = { { "1D", GLS_TEXTURE_1D }, { "2D", GLS_TEXTURE_2D }, { "3D", GLS_TEXTURE_3D }, { "CUBE", GLS_TEXTURE_CUBE },
		        { "RECT", GLS_TEXTURE_RECTANGLE } };
	struct arb_words *w = &p->words;
	const struct emit_source at = take_source(p);
	uint32_t unit, *target;

	arb_expect(w, ',');
	if (!arb_takes_name(w, "texture"))
		arb_fail(w, bad_grammar);
	unit = arb_peek(w) == '[' ? arb_subscript(w, SCENE_MAX_UNITS) : 0;
	arb_expect(w, ',');
	arb_peek(w);
	target = &p->emitter.code->targets[unit];
	for (uint32_t i = 0; i < 5; i++) {
		const size_t n = strlen(targets[i].name);

		if ((size_t)(w->end - w->at) <= n || memcmp(w->at, targets[i].name, n) != 0)
			continue;
		w->at += n;
		if (*target && *target != 1 + (uint32_t)targets[i].target)
			arb_fail(w, bad_grammar);
		*target = 1 + (uint32_t)targets[i].target;
		emit_texture(&p->emitter, to, &at, unit, flags);
		return;
	}
	arb_fail(w, "an ARB program samples a kind of texture that is not done yet");
}

/* 1 where the name, with or without _SAT, is this one. */
static bool is_instruction(const char *name, size_t n, const char *word, int *saturates)
{
	*saturates = n > 4 && memcmp(name + n - 4, "_SAT", 4) == 0;
	return arb_is(name, *saturates ? n - 4 : n, word);
}

static void take_plain_instruction(struct parser *p, size_t i, int saturates)
{
	const struct emit_target to = take_target(p, saturates);
	struct emit_source s[3] = { { { 0 }, 0 } };

	for (uint32_t k = 0; k < instructions[i].n_sources; k++) {
		arb_expect(&p->words, ',');
		s[k] = take_source(p);
	}
	if (p->words.why)
		return;
	if (instructions[i].how == OTHERWISE)
		instructions[i].otherwise(p, &to, s);
	else if (instructions[i].how == BY_NUMBER)
		emit_scalar(&p->emitter, instructions[i].operation, &to, &s[0], instructions[i].n_sources > 1 ? &s[1] : NULL);
	else
		emit_vector(&p->emitter, instructions[i].operation, &to, &s[0], instructions[i].n_sources > 1 ? &s[1] : NULL,
		            instructions[i].n_sources > 2 ? &s[2] : NULL);
}

static void take_instruction(struct parser *p, const char *name, size_t n)
{
	static const struct {
		const char *name;
		uint32_t flags;
	} samples[] = { { "TEX", 0 }, { "TXP", SCENE_TEXTURE_DIVIDED }, { "TXB", SCENE_TEXTURE_BIASED } };
	struct emit_source killed;
	struct emit_target to;
	int saturates;

	for (size_t i = 0; i < sizeof(instructions) / sizeof(instructions[0]); i++)
		if (is_instruction(name, n, instructions[i].name, &saturates)) {
			take_plain_instruction(p, i, saturates);
			return;
		}
	if (arb_is(name, n, "KIL")) {
		killed = take_source(p);
		if (!p->words.why)
			emit_kill(&p->emitter, &killed);
		return;
	}
	for (size_t i = 0; i < 3; i++)
		if (is_instruction(name, n, samples[i].name, &saturates)) {
			to = take_target(p, saturates);
			arb_expect(&p->words, ',');
			take_texture(p, &to, samples[i].flags);
			return;
		}
	if (is_instruction(name, n, "SWZ", &saturates)) {
		to = take_target(p, saturates);
		arb_expect(&p->words, ',');
		take_extended_swizzle(p, &to);
		return;
	}
	arb_fail(&p->words, "an ARB program has an instruction that is not done yet");
}

/* --- Statements -------------------------------------------------------------------------------------------------------- */

static void take_temporaries(struct parser *p)
{
	do {
		struct symbol *s = new_symbol(p);

		s->kind = IS_REGISTER;
		s->first = new_registers(p);
	} while (!p->words.why && arb_takes(&p->words, ','));
}

/* PARAM a = b, or PARAM a[n] = { b, c }. */
static void take_parameter(struct parser *p)
{
	struct arb_words *w = &p->words;
	struct symbol *s = new_symbol(p);
	uint32_t size = 0, is_array = arb_takes(w, '[');

	if (is_array && arb_peek(w) != ']')
		size = arb_index(w, MAX_ELEMENTS);
	if (is_array)
		arb_expect(w, ']');
	arb_expect(w, '=');
	s->kind = IS_PARAMETER;
	s->first = p->n_elements;
	s->count = 0;
	if (is_array) {
		arb_expect(w, '{');
		do
			s->count += take_binding(p);
		while (!w->why && arb_takes(w, ','));
		arb_expect(w, '}');
	} else {
		s->count = take_binding(p);
	}
	if (!s->count || (size && size != s->count) || (!is_array && s->count != 1))
		arb_fail(w, bad_grammar);
}

/* ATTRIB a = fragment.x, OUTPUT a = result.x, ALIAS a = b. kind: the statement's first letters */
static void take_name_for(struct parser *p, char kind)
{
	struct arb_words *w = &p->words;
	struct symbol *s = new_symbol(p);
	const struct symbol *other;
	const char *name;
	size_t n;

	arb_expect(w, '=');
	n = arb_name(w, &name);
	s->kind = IS_REGISTER;
	if (kind == 'T' && arb_is(name, n, "fragment")) {
		s->first = take_input(p);
	} else if (kind == 'O' && arb_is(name, n, "result")) {
		s->first = take_output(p);
	} else if (kind == 'L' && (other = find_symbol(p, name, n)) && other != s) {
		s->kind = other->kind;
		s->first = other->first;
		s->count = other->count;
	} else {
		arb_fail(w, bad_grammar);
	}
}

static void take_option(struct parser *p)
{
	static const char *const harmless[] = { "ARB_precision_hint_fastest", "ARB_precision_hint_nicest", "ARB_draw_buffers", "ATI_draw_buffers" };
	const char *name;
	const size_t n = arb_name(&p->words, &name);

	for (size_t i = 0; i < sizeof(harmless) / sizeof(harmless[0]); i++)
		if (arb_is(name, n, harmless[i]))
			return;
	if (arb_is(name, n, "ARB_fog_linear"))
		p->fog = FOG_LINEAR;
	else if (arb_is(name, n, "ARB_fog_exp"))
		p->fog = FOG_EXP;
	else if (arb_is(name, n, "ARB_fog_exp2"))
		p->fog = FOG_EXP2;
	else
		arb_fail(&p->words, "an ARB program has an option that is not done yet");
}

static void take_statement(struct parser *p, const char *name, size_t n)
{
	if (arb_is(name, n, "TEMP"))
		take_temporaries(p);
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
		take_instruction(p, name, n);
	arb_expect(&p->words, ';');
}

/* The fog that an option asks for (section 3.11.4.5.1), over the colour that the program has left. */
static void add_fog(struct parser *p)
{
	struct emitter *e = &p->emitter;
	const uint32_t numbers = constant(p, &(struct program_constant){ .source = PROGRAM_FOG_NUMBERS });
	const uint32_t color = constant(p, &(struct program_constant){ .source = PROGRAM_FOG_COLOR });
	const struct emit_source four = emit_four(numbers), density = emit_splat(&four, 0), end = emit_splat(&four, 2), scale = emit_splat(&four, 3);
	const struct emit_source in = emit_four(4 * SCENE_INPUT_FOG), at = emit_splat(&in, 0), aside = emit_four(e->scratch + 4);
	const struct emit_source log2_e = { { literal(p, 1.44269504f, 0, 0, 0) }, 0 }, fog = emit_four(color), own = emit_four(SCENE_PROGRAM_COLOR);
	const struct emit_target one = { e->scratch + 4, 1, 0 }, factor = { e->scratch + 4, 1, 1 }, rgb = { SCENE_PROGRAM_COLOR, 7, 0 };
	struct emit_source x = emit_splat(&aside, 0), back = at;

	p->emitter.code->inputs |= 1u << SCENE_INPUT_FOG;
	if (p->fog == FOG_LINEAR) {
		back.negated = 15;
		emit_vector(e, SCENE_OP_ADD, &one, &end, &back, NULL);
		emit_vector(e, SCENE_OP_MULTIPLY, &factor, &x, &scale, NULL);
	} else {
		emit_vector(e, SCENE_OP_MULTIPLY, &one, &density, &at, NULL);
		if (p->fog == FOG_EXP2)
			emit_vector(e, SCENE_OP_MULTIPLY, &one, &x, &x, NULL);
		emit_vector(e, SCENE_OP_MULTIPLY, &one, &x, &log2_e, NULL);
		x.negated = 15;
		emit_vector(e, SCENE_OP_EXP2, &factor, &x, NULL, NULL);
		x.negated = 0;
	}
	/* f own + (1 - f) fog, from what the own colour is more than the fog's */
	back = fog;
	back.negated = 15;
	emit_vector(e, SCENE_OP_MOVE, &(struct emit_target){ SCENE_PROGRAM_COLOR, 15, 1 }, &own, NULL, NULL);
	emit_vector(e, SCENE_OP_ADD, &rgb, &own, &back, NULL);
	emit_vector(e, SCENE_OP_MAD, &rgb, &own, &x, &fog);
}

/* All statements up to END. */
static void take_program(struct parser *p)
{
	static const char header[] = "!!ARBfp1.0";
	struct arb_words *w = &p->words;
	const char *name;
	size_t n;

	if ((size_t)(w->end - w->at) < sizeof(header) - 1 || memcmp(w->at, header, sizeof(header) - 1) != 0) {
		arb_fail(w, "a fragment program does not begin with !!ARBfp1.0");
		return;
	}
	w->at += sizeof(header) - 1;
	while (!w->why && !p->emitter.err) {
		n = arb_name(w, &name);
		if (!n || arb_is(name, n, "END"))
			break;
		take_statement(p, name, n);
	}
	if (!w->why && !p->emitter.err && !arb_is(name, n, "END"))
		arb_fail(w, bad_grammar);
	if (!w->why && p->fog)
		add_fog(p);
}

int program_translate_arb(const char *text, size_t n, struct program_code *code, const char **why)
{
	struct parser *p = calloc(1, sizeof(*p));
	int err;

	if (!p)
		return err_report(ERR_SYSTEM, NULL, "out of memory for a program");
	code->n_registers = SCENE_PROGRAM_FIRST;
	p->words = (struct arb_words){ text, text + n, n > MAX_TEXT ? "an ARB program is longer than a megabyte" : NULL };
	p->emitter.code = code;
	p->emitter.scratch = new_registers(p);
	new_registers(p);
	if (!p->words.why)
		take_program(p);
	if (p->emitter.err == ERR_INPUT)
		arb_fail(&p->words, "an ARB program has more than 4096 instructions");
	*why = p->words.why;
	err = p->emitter.err == ERR_SYSTEM ? ERR_SYSTEM : 0;
	free(p);
	return err;
}
