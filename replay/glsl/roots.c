#include "replay/glsl/roots.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"

#define MAX_SEARCHED 16384 /* instructions: the search takes the square of them, 0.2 s then */

static int is_jump(const struct scene_instruction *in)
{
	return in->operation == SCENE_OP_JUMP || in->operation == SCENE_OP_JUMP_NONE;
}

static int writes(const struct scene_instruction *in, uint32_t r)
{
	const uint32_t n = in->operation == SCENE_OP_TEXTURE ? 4 : in->n;

	return in->operation != SCENE_OP_KILL && in->to <= r && r - in->to < n;
}

/* targets: [SCENE_PROGRAM_INSTRUCTIONS + 1], 1: something jumps there */
static void note_targets(const struct program_code *code, uint8_t *targets)
{
	memset(targets, 0, code->n_instructions + 1);
	for (uint32_t i = 0; i < code->n_instructions; i++)
		if (is_jump(&code->instructions[i]) && code->instructions[i].to <= code->n_instructions)
			targets[code->instructions[i].to] = 1;
}

/* Jumps to `at` itself then lead to the new instruction. @return 0, ERR_SYSTEM, or ERR_INPUT: there is no room */
static int insert(struct program_code *code, uint32_t at, struct scene_instruction instruction)
{
	const int err = program_append(code, &instruction);

	if (err)
		return err;
	memmove(code->instructions + at + 1, code->instructions + at, (code->n_instructions - 1 - at) * sizeof(instruction));
	code->instructions[at] = instruction;
	for (uint32_t i = 0; i < code->n_instructions; i++)
		if (is_jump(&code->instructions[i]) && code->instructions[i].to > at)
			code->instructions[i].to++;
	return 0;
}

/* The instruction that makes a register's number before another one, copies left out. @return its number, or `at`: not known */
static uint32_t find_maker(const struct program_code *code, const uint8_t *targets, uint32_t at, uint32_t r)
{
	for (uint32_t i = at; i > 0 && !targets[i];) {
		const struct scene_instruction *in = &code->instructions[--i];

		if (is_jump(in) || in->operation == SCENE_OP_MASK || in->operation == SCENE_OP_STORE)
			return at;
		if (!writes(in, r))
			continue;
		if (in->operation != SCENE_OP_MOVE || in->flags & (SCENE_NEGATE_A | SCENE_SATURATE))
			return i;
		r = in->a + (in->flags & SCENE_STEP_A ? r - in->to : 0);
	}
	return at;
}

static int is_literal(const struct program_code *code, uint32_t operand)
{
	return operand >= SCENE_PROGRAM_CONSTANT && code->constants[(operand - SCENE_PROGRAM_CONSTANT) / 4].source == PROGRAM_LITERAL;
}

/* Whether register r, which instruction `at` has made, is multiplied by a number of the shader's text next: Mesa then has (a c) b of (a b) c. */
static int is_scaled(const struct program_code *code, uint32_t at, uint32_t r)
{
	for (uint32_t i = at + 1; i < code->n_instructions && !is_jump(&code->instructions[i]); i++) {
		const struct scene_instruction *in = &code->instructions[i];
		const uint32_t operands[3] = { in->a, in->b, in->c };

		for (unsigned k = 0; k < program_operands(in->operation); k++)
			if (operands[k] <= r && r - operands[k] < (in->flags >> k & 1 ? in->n : 1))
				return in->operation == SCENE_OP_MULTIPLY && is_literal(code, operands[1 - k]);
		if (writes(in, r))
			return 0;
	}
	return 0;
}

/* The square root of which an instruction's number i is the square. @return the root's number, or `at`: it is something else */
static uint32_t find_root(const struct program_code *code, const uint8_t *targets, uint32_t at, uint32_t i)
{
	const struct scene_instruction *in = &code->instructions[at], *root;
	uint32_t made;

	if (in->operation != SCENE_OP_MULTIPLY || !(in->flags & SCENE_NEGATE_A) != !(in->flags & SCENE_NEGATE_B))
		return at;
	made = find_maker(code, targets, at, in->a + (in->flags & SCENE_STEP_A ? i : 0));
	root = &code->instructions[made];
	return root->operation == SCENE_OP_SQUARE_ROOT && root->n == 1 && !(root->flags & SCENE_SATURATE) &&
	       find_maker(code, targets, at, in->b + (in->flags & SCENE_STEP_B ? i : 0)) == made && !is_scaled(code, at, in->to + i) ? made : at;
}

/* Make an instruction of several numbers one for the first and one for the others. */
static int split(struct program_code *code, uint32_t at)
{
	struct scene_instruction first = code->instructions[at], *others = &code->instructions[at];

	first.n = 1;
	others->n--;
	others->to++;
	others->a += others->flags & SCENE_STEP_A ? 1 : 0;
	others->b += others->flags & SCENE_STEP_B ? 1 : 0;
	return insert(code, at, first);
}

/* Keep a root's argument, which may be overwritten, in a register of its own: an instruction before it. */
static int keep_argument(struct program_code *code, uint32_t root)
{
	struct scene_instruction keep = code->instructions[root];
	int err;

	if (code->n_registers == SCENE_PROGRAM_REGISTERS)
		return ERR_INPUT;
	keep.operation = SCENE_OP_ABSOLUTE;
	keep.to = code->n_registers;
	err = insert(code, root, keep);
	code->n_registers += !err;
	return err;
}

/* An instruction's first number, of which the root is known. */
static int square(struct program_code *code, uint32_t at, uint32_t root)
{
	int err = code->instructions[at].n > 1 ? split(code, at) : 0;
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

	if (code->n_instructions > MAX_SEARCHED)
		return 0;
	targets = malloc(SCENE_PROGRAM_INSTRUCTIONS + 1);
	err = targets ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		note_targets(code, targets);
	for (uint32_t i = 0; !err && i < code->n_instructions; i++) {
		uint32_t k = 0, root = i;

		while (k < code->instructions[i].n && root == i)
			root = find_root(code, targets, i, k++);
		if (root == i)
			continue;
		err = k > 1 ? split(code, i) : square(code, i++, root);
		note_targets(code, targets);
	}
	free(targets);
	return err == ERR_INPUT ? 0 : err; /* without room for more, the rest stays as it is */
}
