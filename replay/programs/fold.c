#include "replay/programs/fold.h"

#include <math.h>
#include <stdint.h>

#include "base/err.h"
#include "kernels/gl/instructions.h"
#include "replay/programs/code.h"

/* Values of a program's registers known so far. */
struct known {
	const struct program_code *code;
	float value[SCENE_PROGRAM_REGISTERS];
	uint8_t is_known[SCENE_PROGRAM_REGISTERS];
};

/* The value of an instruction's operand for result i. @return 1 if it is known */
static int look_up(const struct known *known, uint32_t operand, uint32_t i, uint32_t flags, uint32_t step,
                   uint32_t negate, float *value)
{
	const uint32_t number = operand + (flags & step ? i : 0);

	if (number >= SCENE_PROGRAM_CONSTANT) {
		const struct program_constant *c = &known->code->constants[(number - SCENE_PROGRAM_CONSTANT) / 4];

		*value = c->value[number % 4];
		if (c->source != PROGRAM_LITERAL)
			return 0;
	} else {
		*value = known->value[number];
		if (!known->is_known[number])
			return 0;
	}
	*value = flags & negate ? -*value : *value;
	return 1;
}

static int folds(uint32_t operation)
{
	return operation == SCENE_OP_POWER || operation == SCENE_OP_EXP2 || operation == SCENE_OP_LOG2 ||
	       operation == SCENE_OP_SINE || operation == SCENE_OP_COSINE;
}

static float folded(uint32_t operation, float a, float b)
{
	switch (operation) {
	case SCENE_OP_POWER: return (float)pow((double)a, (double)b);
	case SCENE_OP_EXP2: return exp2f(a);
	case SCENE_OP_LOG2: return log2f(a);
	case SCENE_OP_SINE: return sinf(a);
	default: return cosf(a);
	}
}

/* Result i of an instruction. @return 1 if it is known */
static int result_of(const struct known *known, const struct scene_instruction *in, uint32_t i, float *value)
{
	const uint32_t n = program_operands(in->operation);
	float a = 0, b = 0, c = 0;

	if (!look_up(known, in->a, i, in->flags, SCENE_STEP_A, SCENE_NEGATE_A, &a) ||
	    (n > 1 && !look_up(known, in->b, i, in->flags, SCENE_STEP_B, SCENE_NEGATE_B, &b)) ||
	    (n > 2 && !look_up(known, in->c, i, in->flags, SCENE_STEP_C, SCENE_NEGATE_C, &c)))
		return 0;
	*value = folds(in->operation) ?
	                 folded(in->operation, a, b) :
	                 program_result(in->operation, program_splat(a), program_splat(b), program_splat(c), 1).x;
	if (in->flags & SCENE_SATURATE)
		*value = clamp01(*value);
	return 1;
}

/*
 * Number of registers from `to` on that receive new values from outside the instruction's operands; 0 if results can be
 * computed.
 */
static uint32_t brings_in(const struct scene_instruction *in)
{
	return in->operation == SCENE_OP_TEXTURE ? 4 : in->operation == SCENE_OP_FETCH ? in->n : 0;
}

/* Turn an instruction's results into constants, and the instruction into a move. */
static int fold(struct program_code *code, struct scene_instruction *in, const float value[4])
{
	struct program_constant c = { .source = PROGRAM_LITERAL };
	uint32_t number;

	for (uint32_t i = 0; i < in->n; i++)
		c.value[i] = value[i];
	number = program_constant(code, &c);
	if (number == UINT32_MAX)
		return ERR_SYSTEM;
	*in = (struct scene_instruction){ .operation = SCENE_OP_MOVE, .n = in->n, .flags = SCENE_STEP_A, .to = in->to,
		                          .a = SCENE_PROGRAM_CONSTANT + 4 * number };
	return 0;
}

int program_fold(struct program_code *code)
{
	struct known known = { .code = code };

	for (uint32_t k = 0; k < code->n_instructions; k++) {
		struct scene_instruction *in = &code->instructions[k];
		const uint32_t brought = brings_in(in);
		int all = 1, err;
		float value[4];

		for (uint32_t i = 0; i < brought; i++)
			known.is_known[in->to + i] = 0;
		if (brought || in->operation == SCENE_OP_KILL)
			continue;
		for (uint32_t i = 0; i < in->n; i++) {
			known.is_known[in->to + i] = (uint8_t)result_of(&known, in, i, &value[i]);
			all &= known.is_known[in->to + i];
			known.value[in->to + i] = value[i];
		}
		err = all && folds(in->operation) ? fold(code, in, value) : 0;
		if (err)
			return err;
	}
	return 0;
}
