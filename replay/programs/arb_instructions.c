/* Instructions of ARB programs (ARB_vertex_program, section 2.14.5; ARB_fragment_program, section 3.11.5). */
#include <string.h>

#include "replay/machine/state.h"
#include "replay/programs/arb_parser.h"

typedef void instruction(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3]);

static struct emit_target part_of(const struct emit_target *to, uint32_t mask)
{
	return (struct emit_target){ to->first, to->mask & mask, to->saturates };
}

/* Move a result from temporary registers to its target. */
static void move_from(struct arb_parser *p, const struct emit_target *to, uint32_t first)
{
	const struct emit_source from = emit_four(first);

	emit_vector(&p->emitter, SCENE_OP_MOVE, to, &from, NULL, NULL);
}

static void do_sub(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	struct emit_source b = s[1];

	b.negated ^= 15;
	emit_vector(&p->emitter, SCENE_OP_ADD, to, &s[0], &b, NULL);
}

static void do_dp3(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	emit_dot(&p->emitter, to, &s[0], &s[1], 3, 0);
}

static void do_dp4(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	emit_dot(&p->emitter, to, &s[0], &s[1], 4, 0);
}

static void do_dph(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	emit_dot(&p->emitter, to, &s[0], &s[1], 3, 1);
}

/* 1, a.y b.y, a.z, b.w */
static void do_dst(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	const uint32_t one = arb_literal(p, 1, 1, 1, 1);
	const struct emit_source a = { { one, s[0].number[1], s[0].number[2], one }, s[0].negated & 6 };
	const struct emit_source b = { { one, s[1].number[1], one, s[1].number[3] }, s[1].negated & 10 };

	emit_vector(&p->emitter, SCENE_OP_MULTIPLY, to, &a, &b, NULL);
}

static void do_lrp(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	const uint32_t aside = p->emitter.scratch + 4;
	const struct emit_target difference = { aside, 15, 0 };
	const struct emit_source d = emit_four(aside);
	struct emit_source c = s[2];

	c.negated ^= 15;
	emit_vector(&p->emitter, SCENE_OP_ADD, &difference, &s[1], &c, NULL);
	emit_vector(&p->emitter, SCENE_OP_MAD, to, &s[0], &d, &s[2]);
}

static void do_xpd(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	static const uint32_t next[4] = { 1, 2, 0, 3 }, last[4] = { 2, 0, 1, 3 };
	const uint32_t aside = p->emitter.scratch + 4;
	const struct emit_target product = { aside, 7, 0 }, result = part_of(to, 7), last_one = part_of(to, 8);
	const struct emit_source one = emit_four(arb_literal(p, 1, 1, 1, 1));
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
	/* undefined in the specification; Mesa writes 1 */
	emit_vector(&p->emitter, SCENE_OP_MOVE, &last_one, &one, NULL, NULL);
}

static void do_scs(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	const struct emit_source angle = emit_splat(&s[0], 0);
	const uint32_t aside = p->emitter.scratch + 4;
	const struct emit_target x = { aside, 1, 0 }, y = { aside, 2, 0 }, result = part_of(to, 3);

	emit_vector(&p->emitter, SCENE_OP_COSINE, &x, &angle, NULL, NULL);
	emit_vector(&p->emitter, SCENE_OP_SINE, &y, &angle, NULL, NULL);
	move_from(p, &result, aside);
}

/* 1, max(x, 0), x > 0 ? max(y, 0) to the power of w clamped to +-128 : 0, 1 */
static void do_lit(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	struct emitter *e = &p->emitter;
	const uint32_t limits = arb_literal(p, 0, 1, 128, -128), aside = e->scratch + 4;
	const struct emit_source four = emit_four(limits), zero = emit_splat(&four, 0), most = emit_splat(&four, 2),
				 least = emit_splat(&four, 3);
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
	emit_vector(e, SCENE_OP_MOVE, &w,
	            &(struct emit_source){ { limits + 1, limits + 1, limits + 1, limits + 1 }, 0 }, NULL, NULL);
	move_from(p, to, aside);
}

/* 2 to the power of floor(x), the fraction of x, 2 to the power of x, 1 */
static void do_exp(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	struct emitter *e = &p->emitter;
	const struct emit_source x = emit_splat(&s[0], 0), one = emit_four(arb_literal(p, 1, 1, 1, 1)),
				 d = emit_four(e->scratch + 4);
	const struct emit_source whole = emit_splat(&d, 0);
	const struct emit_target first = { e->scratch + 4, 1, 0 }, second = { e->scratch + 4, 2, 0 },
	third = { e->scratch + 4, 4, 0 },
	                         fourth = { e->scratch + 4, 8, 0 };

	emit_vector(e, SCENE_OP_FLOOR, &first, &x, NULL, NULL);
	emit_vector(e, SCENE_OP_EXP2, &first, &whole, NULL, NULL);
	emit_vector(e, SCENE_OP_FRACTION, &second, &x, NULL, NULL);
	emit_vector(e, SCENE_OP_EXP2, &third, &x, NULL, NULL);
	emit_vector(e, SCENE_OP_MOVE, &fourth, &one, NULL, NULL);
	move_from(p, to, e->scratch + 4);
}

/* floor(log2(|x|)), the mantissa of |x| in [1,2), log2(|x|), 1 */
static void do_log(struct arb_parser *p, const struct emit_target *to, const struct emit_source s[3])
{
	struct emitter *e = &p->emitter;
	const struct emit_source x = emit_splat(&s[0], 0), one = emit_four(arb_literal(p, 1, 1, 1, 1)),
				 d = emit_four(e->scratch + 4);
	const struct emit_source y = emit_splat(&d, 1), z = emit_splat(&d, 2), w = emit_splat(&d, 3);
	const struct emit_target first = { e->scratch + 4, 1, 0 }, second = { e->scratch + 4, 2, 0 },
	third = { e->scratch + 4, 4, 0 },
	                         fourth = { e->scratch + 4, 8, 0 };
	struct emit_source less = emit_splat(&d, 0);

	emit_vector(e, SCENE_OP_ABSOLUTE, &fourth, &x, NULL, NULL);
	emit_vector(e, SCENE_OP_LOG2, &third, &w, NULL, NULL);
	emit_vector(e, SCENE_OP_FLOOR, &first, &z, NULL, NULL);
	less.negated = 15;
	emit_vector(e, SCENE_OP_EXP2, &second, &less, NULL, NULL);
	emit_vector(e, SCENE_OP_MULTIPLY, &second, &w, &y, NULL);
	emit_vector(e, SCENE_OP_MOVE, &fourth, &one, NULL, NULL);
	move_from(p, to, e->scratch + 4);
}

enum { IN_VERTICES = 1, IN_FRAGMENTS = 2, IN_BOTH = 3 };

static const struct {
	const char *name;
	uint32_t n_sources, stages;
	enum { BY_COMPONENT, BY_NUMBER, OTHERWISE } how;
	enum scene_operation operation;
	instruction *otherwise;
} instructions[] = {
	{ "ABS", 1, IN_BOTH, BY_COMPONENT, SCENE_OP_ABSOLUTE, NULL }, { "ADD", 2, IN_BOTH, BY_COMPONENT, SCENE_OP_ADD, NULL },
	{ "CMP", 3, IN_FRAGMENTS, BY_COMPONENT, SCENE_OP_SELECT, NULL },
	{ "COS", 1, IN_FRAGMENTS, BY_NUMBER, SCENE_OP_COSINE, NULL }, { "DP3", 2, IN_BOTH, OTHERWISE, 0, do_dp3 },
	{ "DP4", 2, IN_BOTH, OTHERWISE, 0, do_dp4 }, { "DPH", 2, IN_BOTH, OTHERWISE, 0, do_dph },
	{ "DST", 2, IN_BOTH, OTHERWISE, 0, do_dst }, { "EX2", 1, IN_BOTH, BY_NUMBER, SCENE_OP_EXP2, NULL },
	{ "EXP", 1, IN_VERTICES, OTHERWISE, 0, do_exp }, { "LOG", 1, IN_VERTICES, OTHERWISE, 0, do_log },
	{ "FLR", 1, IN_BOTH, BY_COMPONENT, SCENE_OP_FLOOR, NULL },
	{ "FRC", 1, IN_BOTH, BY_COMPONENT, SCENE_OP_FRACTION, NULL }, { "LG2", 1, IN_BOTH, BY_NUMBER, SCENE_OP_LOG2, NULL },
	{ "LIT", 1, IN_BOTH, OTHERWISE, 0, do_lit }, { "LRP", 3, IN_FRAGMENTS, OTHERWISE, 0, do_lrp },
	{ "MAD", 3, IN_BOTH, BY_COMPONENT, SCENE_OP_MAD, NULL }, { "MAX", 2, IN_BOTH, BY_COMPONENT, SCENE_OP_MAXIMUM, NULL },
	{ "MIN", 2, IN_BOTH, BY_COMPONENT, SCENE_OP_MINIMUM, NULL },
	{ "MOV", 1, IN_BOTH, BY_COMPONENT, SCENE_OP_MOVE, NULL },
	{ "MUL", 2, IN_BOTH, BY_COMPONENT, SCENE_OP_MULTIPLY, NULL }, { "POW", 2, IN_BOTH, BY_NUMBER, SCENE_OP_POWER, NULL },
	{ "RCP", 1, IN_BOTH, BY_NUMBER, SCENE_OP_RECIPROCAL, NULL },
	{ "RSQ", 1, IN_BOTH, BY_NUMBER, SCENE_OP_INVERSE_ROOT, NULL }, { "SCS", 1, IN_FRAGMENTS, OTHERWISE, 0, do_scs },
	{ "SGE", 2, IN_BOTH, BY_COMPONENT, SCENE_OP_GREATER_EQUAL, NULL },
	{ "SIN", 1, IN_FRAGMENTS, BY_NUMBER, SCENE_OP_SINE, NULL }, { "SLT", 2, IN_BOTH, BY_COMPONENT, SCENE_OP_LESS, NULL },
	{ "SUB", 2, IN_BOTH, OTHERWISE, 0, do_sub }, { "XPD", 2, IN_BOTH, OTHERWISE, 0, do_xpd },
};

/* SWZ: each component selected separately, or a constant 0 or 1. */
static void take_extended_swizzle(struct arb_parser *p, const struct emit_target *to)
{
	struct arb_words *w = &p->words;
	const struct emit_source from = emit_four(arb_take_vector(p));
	const uint32_t numbers = arb_literal(p, 0, 1, 128, -128);
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
		c = arb_name(w, &name) == 1 ? arb_component_of(p, *name) : -1;
		if (c < 0)
			arb_fail(w, arb_bad_grammar);
		else
			s.number[i] = from.number[c];
	}
	if (!w->why)
		emit_vector(&p->emitter, SCENE_OP_MOVE, to, &s, NULL, NULL);
}

static void take_texture(struct arb_parser *p, const struct emit_target *to, uint32_t flags)
{
	static const struct {
		const char *name;
		enum gls_texture_target target;
	} targets[] = { { "1D", GLS_TEXTURE_1D },          { "2D", GLS_TEXTURE_2D },
		        { "3D", GLS_TEXTURE_3D },          { "CUBE", GLS_TEXTURE_CUBE },
		        { "RECT", GLS_TEXTURE_RECTANGLE }, { "SHADOW1D", GLS_TEXTURE_1D },
		        { "SHADOW2D", GLS_TEXTURE_2D },    { "SHADOWRECT", GLS_TEXTURE_RECTANGLE } }; /* the texture
		                                                                                         itself says
		                                                                                         whether depths
		                                                                                         are compared */
	struct arb_words *w = &p->words;
	const struct emit_source at = arb_take_source(p);
	uint32_t unit, *target;

	arb_expect(w, ',');
	if (!arb_takes_name(w, "texture"))
		arb_fail(w, arb_bad_grammar);
	unit = arb_peek(w) == '[' ? arb_subscript(w, SCENE_MAX_UNITS) : 0;
	arb_expect(w, ',');
	arb_peek(w);
	target = &p->emitter.code->targets[unit];
	for (uint32_t i = 0; i < sizeof(targets) / sizeof(targets[0]); i++) {
		const size_t n = strlen(targets[i].name);

		if ((size_t)(w->end - w->at) <= n || memcmp(w->at, targets[i].name, n) != 0)
			continue;
		w->at += n;
		if (*target && *target != 1 + (uint32_t)targets[i].target)
			arb_fail(w, arb_bad_grammar);
		*target = 1 + (uint32_t)targets[i].target;
		emit_texture(&p->emitter, to, &at, unit, flags);
		return;
	}
	arb_fail(w, "an ARB program samples an unsupported kind of texture");
}

/* 1 if the name is this word, in fragment programs with or without _SAT. */
static bool is_instruction(const struct arb_parser *p, const char *name, size_t n, const char *word, int *saturates)
{
	*saturates = !p->is_vertex && n > 4 && memcmp(name + n - 4, "_SAT", 4) == 0;
	return arb_is(name, *saturates ? n - 4 : n, word);
}

static void take_plain_instruction(struct arb_parser *p, size_t i, int saturates)
{
	const struct emit_target to = arb_take_target(p, saturates);
	struct emit_source s[3] = { { { 0 }, 0 } };

	for (uint32_t k = 0; k < instructions[i].n_sources; k++) {
		arb_expect(&p->words, ',');
		s[k] = arb_take_source(p);
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

/* ARL: the floor of a number, as an address. */
static void take_address_load(struct arb_parser *p)
{
	const uint32_t first = arb_take_address(p);
	const struct emit_target to = { first, 1, 0 };
	struct emit_source s;

	arb_expect(&p->words, ',');
	s = arb_take_source(p);
	if (!p->words.why)
		emit_vector(&p->emitter, SCENE_OP_FLOOR, &to, &s, NULL, NULL);
}

void arb_take_instruction(struct arb_parser *p, const char *name, size_t n)
{
	static const struct {
		const char *name;
		uint32_t flags;
	} samples[] = { { "TEX", 0 }, { "TXP", SCENE_TEXTURE_DIVIDED }, { "TXB", SCENE_TEXTURE_BIASED } };
	struct emit_source killed;
	struct emit_target to;
	int saturates;

	p->n_fetched = 0;
	for (size_t i = 0; i < sizeof(instructions) / sizeof(instructions[0]); i++)
		if (instructions[i].stages & (p->is_vertex ? IN_VERTICES : IN_FRAGMENTS) &&
		    is_instruction(p, name, n, instructions[i].name, &saturates)) {
			take_plain_instruction(p, i, saturates);
			return;
		}
	if (p->is_vertex && arb_is(name, n, "ARL")) {
		take_address_load(p);
		return;
	}
	if (!p->is_vertex && arb_is(name, n, "KIL")) {
		killed = arb_take_source(p);
		if (!p->words.why)
			emit_kill(&p->emitter, &killed);
		return;
	}
	for (size_t i = 0; i < 3 && !p->is_vertex; i++)
		if (is_instruction(p, name, n, samples[i].name, &saturates)) {
			to = arb_take_target(p, saturates);
			arb_expect(&p->words, ',');
			take_texture(p, &to, samples[i].flags);
			return;
		}
	if (is_instruction(p, name, n, "SWZ", &saturates)) {
		to = arb_take_target(p, saturates);
		arb_expect(&p->words, ',');
		take_extended_swizzle(p, &to);
		return;
	}
	arb_fail(&p->words, "an ARB program has an unknown instruction");
}

