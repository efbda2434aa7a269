#include "replay/glsl/makers.h"

#include <string.h>

bool glsl_is_jump(const struct scene_instruction *in)
{
	return in->operation == SCENE_OP_JUMP || in->operation == SCENE_OP_JUMP_NONE;
}

bool glsl_writes(const struct scene_instruction *in, uint32_t r)
{
	const uint32_t n = in->operation == SCENE_OP_TEXTURE ? 4 : in->n;

	return in->operation != SCENE_OP_KILL && in->to <= r && r - in->to < n;
}

uint32_t glsl_operand(const struct scene_instruction *in, unsigned operand, uint32_t i)
{
	const uint32_t first = operand == 0 ? in->a : operand == 1 ? in->b : in->c;

	return first + (in->flags & SCENE_STEP_A << operand ? i : 0);
}

void glsl_note_targets(const struct program_code *code, uint8_t *targets)
{
	memset(targets, 0, code->n_instructions + 1);
	for (uint32_t i = 0; i < code->n_instructions; i++)
		if (glsl_is_jump(&code->instructions[i]) && code->instructions[i].to <= code->n_instructions)
			targets[code->instructions[i].to] = 1;
}

struct glsl_maker glsl_find_maker(const struct program_code *code, const uint8_t *targets, uint32_t at, uint32_t r)
{
	for (; r < SCENE_PROGRAM_CONSTANT && at > 0 && !targets[at]; at--) {
		const struct scene_instruction *in = &code->instructions[at - 1];

		if (glsl_is_jump(in) || in->operation == SCENE_OP_MASK || in->operation == SCENE_OP_STORE)
			break;
		if (!glsl_writes(in, r))
			continue;
		if (in->operation != SCENE_OP_MOVE || in->flags & (SCENE_NEGATE_A | SCENE_SATURATE))
			return (struct glsl_maker){ at - 1, r, true };
		r = glsl_operand(in, 0, r - in->to);
	}
	return (struct glsl_maker){ r < SCENE_PROGRAM_CONSTANT ? at : 0, r, false };
}

int glsl_insert(struct program_code *code, uint32_t at, struct scene_instruction instruction)
{
	const int err = program_append(code, &instruction);

	if (err)
		return err;
	memmove(code->instructions + at + 1, code->instructions + at,
	        (code->n_instructions - 1 - at) * sizeof(instruction));
	code->instructions[at] = instruction;
	for (uint32_t i = 0; i < code->n_instructions; i++)
		if (glsl_is_jump(&code->instructions[i]) && code->instructions[i].to > at)
			code->instructions[i].to++;
	return 0;
}

int glsl_split(struct program_code *code, uint32_t at, uint32_t n)
{
	struct scene_instruction first = code->instructions[at], *others = &code->instructions[at];

	first.n = n;
	others->n -= n;
	others->to += n;
	others->a = glsl_operand(others, 0, n);
	others->b = glsl_operand(others, 1, n);
	others->c = glsl_operand(others, 2, n);
	return glsl_insert(code, at, first);
}
