#include "replay/programs/ati.h"

#include "base/err.h"
#include "gl_tokens.h"
#include "replay/machine/state.h"
#include "replay/programs/emit.h"

#define REGISTERS 6u
#define MAX_CALLS 64u /* two passes of six textures and sixteen half instructions, and the constants */

struct translator {
	struct emitter emitter;
	const struct ati_call *constants[ATI_CONSTANTS]; /* NULL: the context's constant */
	uint32_t registers[REGISTERS], aside[3], value;  /* the first of four registers each */
	const char *why;
};

static const char not_known[] = "an ATI fragment shader has an unknown operation or argument";

static struct emit_source literal(struct translator *t, const float value[4])
{
	const struct program_constant c = { .source = PROGRAM_LITERAL, .value = { value[0], value[1], value[2], value[3] } };
	const uint32_t number = program_constant(t->emitter.code, &c);

	if (number == UINT32_MAX)
		t->emitter.err = ERR_SYSTEM;
	return emit_four(number == UINT32_MAX ? SCENE_PROGRAM_CONSTANT : SCENE_PROGRAM_CONSTANT + 4 * number);
}

static struct emit_source number(struct translator *t, float value)
{
	return literal(t, (const float[4]){ value, value, value, value });
}

static struct emit_source input(struct translator *t, uint32_t which)
{
	t->emitter.code->inputs |= 1u << which;
	return emit_four(4 * which);
}

static struct emit_source constant(struct translator *t, uint32_t index)
{
	uint32_t number;

	if (t->constants[index])
		return literal(t, t->constants[index]->value);
	number = program_constant(t->emitter.code, &(struct program_constant){ .source = PROGRAM_ENV, .index = index });
	if (number == UINT32_MAX)
		t->emitter.err = ERR_SYSTEM;
	return emit_four(number == UINT32_MAX ? SCENE_PROGRAM_CONSTANT : SCENE_PROGRAM_CONSTANT + 4 * number);
}

static struct emit_source source_of(struct translator *t, uint32_t token)
{
	if (token >= GL_REG_0_ATI && token < GL_REG_0_ATI + REGISTERS)
		return emit_four(t->registers[token - GL_REG_0_ATI]);
	if (token >= GL_CON_0_ATI && token < GL_CON_0_ATI + ATI_CONSTANTS)
		return constant(t, token - GL_CON_0_ATI);
	switch (token) {
	case GL_ZERO: return number(t, 0);
	case GL_ONE: return number(t, 1);
	case GL_PRIMARY_COLOR_ARB: return input(t, SCENE_INPUT_COLOR);
	case GL_SECONDARY_INTERPOLATOR_ATI: return input(t, SCENE_INPUT_SECONDARY);
	}
	t->why = not_known;
	return number(t, 0);
}

static uint32_t register_of(struct translator *t, uint32_t token)
{
	if (token >= GL_REG_0_ATI && token < GL_REG_0_ATI + REGISTERS)
		return token - GL_REG_0_ATI;
	t->why = not_known;
	return 0;
}

/*
 * An argument with its modifiers applied in the extension's order: complement, bias, double, negate. aside: temporary
 * registers
 */
static struct emit_source argument(struct translator *t, const struct ati_argument *a, uint32_t aside)
{
	const struct emit_target to = { aside, 15, 0 };
	const struct emit_source changed = emit_four(aside);
	struct emit_source s = source_of(t, a->source);

	if (a->component >= GL_RED && a->component <= GL_ALPHA)
		s = emit_splat(&s, a->component - GL_RED);
	else if (a->component != GL_NONE)
		t->why = not_known;
	if (a->change & GL_COMP_BIT_ATI) {
		const struct emit_source one = number(t, 1);

		s.negated ^= 15;
		emit_vector(&t->emitter, SCENE_OP_ADD, &to, &one, &s, NULL);
		s = changed;
	}
	if (a->change & GL_BIAS_BIT_ATI) {
		const struct emit_source half = number(t, -0.5f);

		emit_vector(&t->emitter, SCENE_OP_ADD, &to, &s, &half, NULL);
		s = changed;
	}
	if (a->change & GL_2X_BIT_ATI) {
		emit_vector(&t->emitter, SCENE_OP_ADD, &to, &s, &s, NULL);
		s = changed;
	}
	if (a->change & GL_NEGATE_BIT_ATI)
		s.negated ^= 15;
	return s;
}

static uint32_t arguments_of(uint32_t operation)
{
	switch (operation) {
	case GL_MOV_ATI: return 1;
	case GL_ADD_ATI:
	case GL_MUL_ATI:
	case GL_SUB_ATI:
	case GL_DOT3_ATI:
	case GL_DOT4_ATI: return 2;
	case GL_MAD_ATI:
	case GL_LERP_ATI:
	case GL_CND_ATI:
	case GL_CND0_ATI:
	case GL_DOT2_ADD_ATI: return 3;
	default: return 0;
	}
}

/* Emit four numbers = f(arguments). */
static void compute(struct translator *t, uint32_t operation, const struct emit_target *to,
                    const struct emit_source s[3])
{
	struct emitter *e = &t->emitter;
	const struct emit_source value = emit_four(to->first), half = number(t, 0.5f);
	struct emit_source other = s[1], last = s[2];

	switch (operation) {
	case GL_MOV_ATI: emit_vector(e, SCENE_OP_MOVE, to, &s[0], NULL, NULL); break;
	case GL_ADD_ATI: emit_vector(e, SCENE_OP_ADD, to, &s[0], &s[1], NULL); break;
	case GL_MUL_ATI: emit_vector(e, SCENE_OP_MULTIPLY, to, &s[0], &s[1], NULL); break;
	case GL_SUB_ATI:
		other.negated ^= 15;
		emit_vector(e, SCENE_OP_ADD, to, &s[0], &other, NULL);
		break;
	case GL_DOT3_ATI: emit_dot(e, to, &s[0], &s[1], 3, 0); break;
	case GL_DOT4_ATI: emit_dot(e, to, &s[0], &s[1], 4, 0); break;
	case GL_MAD_ATI: emit_vector(e, SCENE_OP_MAD, to, &s[0], &s[1], &s[2]); break;
	case GL_LERP_ATI:
		last.negated ^= 15;
		emit_vector(e, SCENE_OP_ADD, to, &s[1], &last, NULL);
		emit_vector(e, SCENE_OP_MAD, to, &s[0], &value, &s[2]);
		break;
	case GL_CND_ATI: /* third > 0.5 ? first : second */
		last.negated ^= 15;
		emit_vector(e, SCENE_OP_ADD, to, &half, &last, NULL);
		emit_vector(e, SCENE_OP_SELECT, to, &value, &s[0], &s[1]);
		break;
	case GL_CND0_ATI: emit_vector(e, SCENE_OP_SELECT, to, &s[2], &s[1], &s[0]); break;
	case GL_DOT2_ADD_ATI:
		last = emit_splat(&s[1], 2); /* as in Mesa (22.3.6); the extension says the third argument's blue */
		emit_dot(e, to, &s[0], &s[1], 2, 0);
		emit_vector(e, SCENE_OP_ADD, to, &value, &last, NULL);
		break;
	}
}

static float scale_of(uint32_t change)
{
	static const struct { uint32_t bit; float scale; } scales[] = {
		{ GL_2X_BIT_ATI, 2 }, { GL_4X_BIT_ATI, 4 }, { GL_8X_BIT_ATI, 8 }, { GL_HALF_BIT_ATI, 0.5f },
		{ GL_QUARTER_BIT_ATI, 0.25f }, { GL_EIGHTH_BIT_ATI, 0.125f }
	};

	for (unsigned i = 0; i < sizeof(scales) / sizeof(scales[0]); i++)
		if (change & scales[i].bit)
			return scales[i].scale;
	return 1;
}

/* Translate half an instruction: the colour half or the alpha half. */
static void take_arithmetic(struct translator *t, const struct ati_call *c)
{
	const uint32_t rgb = c->mask & 7 ? c->mask & 7 : 7; /* GL_RED_BIT_ATI, GL_GREEN_BIT_ATI, GL_BLUE_BIT_ATI */
	const struct emit_target value = { t->value, 15, 0 };
	const struct emit_target to = { t->registers[register_of(t, c->to)], c->kind == ATI_ALPHA ? 8 : rgb,
		                        !!(c->change & GL_SATURATE_BIT_ATI) };
	const struct emit_source result = emit_four(t->value), scale = number(t, scale_of(c->change));
	struct emit_source s[3] = { result, result, result };
	const uint32_t n = arguments_of(c->operation);

	if (!n || n != c->n_arguments) {
		t->why = not_known;
		return;
	}
	for (uint32_t i = 0; i < n; i++)
		s[i] = argument(t, &c->arguments[i], t->aside[i]);
	compute(t, c->operation, &value, s);
	emit_vector(&t->emitter, SCENE_OP_MULTIPLY, &value, &result, &scale, NULL);
	emit_vector(&t->emitter, SCENE_OP_MOVE, &to, &result, NULL, NULL);
}

/* Translate texture coordinates, or a sample of the unit with the register's number. */
static void take_texture(struct translator *t, const struct ati_call *c)
{
	const uint32_t from = c->arguments[0].source, r = register_of(t, c->to);
	const uint32_t is_divided = c->operation == GL_SWIZZLE_STR_DR_ATI || c->operation == GL_SWIZZLE_STQ_DQ_ATI;
	const uint32_t third = c->operation == GL_SWIZZLE_STQ_ATI || c->operation == GL_SWIZZLE_STQ_DQ_ATI ? 3 : 2;
	const struct emit_target to = { t->registers[r], 15, 0 }, aside = { t->aside[0], 15, 0 },
				 first = { t->aside[1], 1, 0 };
	const struct emit_source changed = emit_four(t->aside[0]), inverse = emit_four(t->aside[1]);
	struct emit_source s = from >= GL_TEXTURE0 && from < GL_TEXTURE0 + GLS_MAX_UNITS ?
	                               input(t, SCENE_INPUT_TEXCOORD + from - GL_TEXTURE0) :
	                               emit_four(t->registers[register_of(t, from)]);

	if (c->operation < GL_SWIZZLE_STR_ATI || c->operation > GL_SWIZZLE_STQ_DQ_ATI)
		t->why = not_known;
	if (is_divided) {
		const struct emit_source divisor = emit_splat(&s, third);
		struct emit_source factor = emit_splat(&inverse, 0);

		emit_vector(&t->emitter, SCENE_OP_RECIPROCAL, &first, &divisor, NULL, NULL);
		emit_vector(&t->emitter, SCENE_OP_MULTIPLY, &aside, &s, &factor, NULL);
		s = changed;
		s.number[2] = s.number[3] = inverse.number[0];
	} else {
		const uint32_t whole[4] = { s.number[0], s.number[1], s.number[third], s.number[5 - third] };

		for (unsigned i = 0; i < 4; i++)
			s.number[i] = whole[i];
	}
	if (c->kind == ATI_PASS) {
		emit_vector(&t->emitter, SCENE_OP_MOVE, &to, &s, NULL, NULL);
		return;
	}
	t->emitter.code->enabled |= 1u << r;
	emit_texture(&t->emitter, &to, &s, r, 0);
}

int program_translate_ati(const struct ati_call *calls, size_t n, struct program_code *code, const char **why)
{
	struct translator t = { .emitter.code = code };
	const struct emit_target color = { SCENE_PROGRAM_COLOR, 15, 0 };
	uint32_t *const rooms[] = { &t.emitter.scratch, &t.aside[0], &t.aside[1], &t.aside[2], &t.value };
	struct emit_source result;

	n /= sizeof(*calls);
	code->n_registers = SCENE_PROGRAM_FIRST;
	for (unsigned i = 0; i < sizeof(rooms) / sizeof(rooms[0]); i++, code->n_registers += 4) {
		*rooms[i] = code->n_registers;
		code->n_registers += rooms[i] == &t.emitter.scratch ? 4 : 0; /* eight registers in all */
	}
	for (unsigned i = 0; i < REGISTERS; i++, code->n_registers += 4)
		t.registers[i] = code->n_registers;
	for (size_t i = 0; i < n; i++)
		if (calls[i].kind == ATI_CONSTANT)
			t.constants[(calls[i].to - GL_CON_0_ATI) % ATI_CONSTANTS] = &calls[i];
	if (n > MAX_CALLS)
		t.why = "an ATI fragment shader has too many instructions";
	for (size_t i = 0; i < n && !t.why && !t.emitter.err; i++) {
		if (calls[i].kind == ATI_COLOR || calls[i].kind == ATI_ALPHA)
			take_arithmetic(&t, &calls[i]);
		else if (calls[i].kind == ATI_PASS || calls[i].kind == ATI_SAMPLE)
			take_texture(&t, &calls[i]);
	}
	result = emit_four(t.registers[0]);
	emit_vector(&t.emitter, SCENE_OP_MOVE, &color, &result, NULL, NULL);
	*why = t.why;
	return t.emitter.err == ERR_SYSTEM ? ERR_SYSTEM : 0;
}
