#include "replay/glsl/roots.h"

#include <stdlib.h>

#include "base/err.h"
#include "replay/glsl/makers.h"

static int is_literal(const struct program_code *code, uint32_t operand)
{
	return operand >= SCENE_PROGRAM_CONSTANT &&
	       code->constants[(operand - SCENE_PROGRAM_CONSTANT) / 4].source == PROGRAM_LITERAL;
}

/*
 * True if register r, written by instruction `at`, is next multiplied by a literal: Mesa then turns (a b) c into (a c)
 * b.
 */
static int is_scaled(const struct program_code *code, uint32_t at, uint32_t r)
{
	for (uint32_t i = at + 1; i < code->n_instructions && !glsl_is_jump(&code->instructions[i]); i++) {
		const struct scene_instruction *in = &code->instructions[i];
		const uint32_t operands[3] = { in->a, in->b, in->c };

		for (unsigned k = 0; k < program_operands(in->operation); k++)
			if (operands[k] <= r && r - operands[k] < (in->flags >> k & 1 ? in->n : 1))
				return in->operation == SCENE_OP_MULTIPLY && is_literal(code, operands[1 - k]);
		if (glsl_writes(in, r))
			return 0;
	}
	return 0;
}

/*
 * The instruction that computes the square root whose square is result i of instruction `at`; `at` itself if there is
 * none
 */
static uint32_t find_root(const struct program_code *code, const uint8_t *targets, uint32_t at, uint32_t i)
{
	const struct scene_instruction *in = &code->instructions[at], *root;
	struct glsl_maker made, other;

	if (in->operation != SCENE_OP_MULTIPLY || !(in->flags & SCENE_NEGATE_A) != !(in->flags & SCENE_NEGATE_B))
		return at;
	made = glsl_find_maker(code, targets, at, glsl_operand(in, 0, i));
	root = &code->instructions[made.at];
	if (!made.is_made || root->operation != SCENE_OP_SQUARE_ROOT || root->n != 1 || root->flags & SCENE_SATURATE)
		return at;
	other = glsl_find_maker(code, targets, at, glsl_operand(in, 1, i));
	return other.is_made && other.at == made.at && !is_scaled(code, at, in->to + i) ? made.at : at;
}

/* Insert an instruction before a root that keeps its argument, which may be overwritten, in a register of its own. */
static int keep_argument(struct program_code *code, uint32_t root)
{
	struct scene_instruction keep = code->instructions[root];
	int err;

	if (code->n_registers == SCENE_PROGRAM_REGISTERS)
		return ERR_INPUT;
	keep.operation = SCENE_OP_ABSOLUTE;
	keep.to = code->n_registers;
	err = glsl_insert(code, root, keep);
	code->n_registers += !err;
	return err;
}

/* Replace an instruction's first result, whose root is known. */
static int square(struct program_code *code, uint32_t at, uint32_t root)
{
	int err = code->instructions[at].n > 1 ? glsl_split(code, at, 1) : 0;
	struct scene_instruction *in;

	if (!err)
		err = keep_argument(code, root);
	if (err)
		return err;
	in = &code->instructions[at + 1];
	in->operation = SCENE_OP_MOVE;
	in->flags &= SCENE_SATURATE | SCENE_UNMASKED;
	in->a = code->n_registers - 1;
	in->b = 0;
	return 0;
}

int glsl_square_roots(struct program_code *code)
{
	uint8_t *targets;
	int err;

	if (code->n_instructions > GLSL_MAX_SEARCHED)
		return 0;
	targets = malloc(SCENE_PROGRAM_INSTRUCTIONS + 1);
	err = targets ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		glsl_note_targets(code, targets);
	for (uint32_t i = 0; !err && i < code->n_instructions; i++) {
		uint32_t k = 0, root = i;

		while (k < code->instructions[i].n && root == i)
			root = find_root(code, targets, i, k++);
		if (root == i)
			continue;
		err = k > 1 ? glsl_split(code, i, 1) : square(code, i++, root);
		glsl_note_targets(code, targets);
	}
	free(targets);
	return err == ERR_INPUT ? 0 : err; /* if there is no room for more instructions, the rest is left unchanged */
}
