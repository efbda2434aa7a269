/* Checks translated instructions of programs: they must stay within their registers, constants and samplers, or the
 * target aborts. */
#pragma once

#include <stdlib.h>

#include "replay/programs/code.h"

/* Whether n numbers exist from an operand on. */
static inline int code_is_there(const struct program_code *code, uint32_t operand, uint32_t n)
{
	return operand >= SCENE_PROGRAM_CONSTANT ? operand - SCENE_PROGRAM_CONSTANT + n <= 4 * code->n_constants :
	                                           operand + n <= code->n_registers;
}

/* first: where its results start. n_textures: limit of texture numbers */
static inline void code_check(const struct program_code *code, uint32_t first, uint32_t n_textures)
{
	for (uint32_t i = 0; i < code->n_instructions; i++) {
		const struct scene_instruction *in = &code->instructions[i];
		const uint32_t operands[3] = { in->a, in->b, in->c }, span = (in->c >> 16) * (in->c & 0xffff);
		const int jumps = in->operation == SCENE_OP_JUMP || in->operation == SCENE_OP_JUMP_NONE;
		const uint32_t results = in->operation == SCENE_OP_TEXTURE ? 4 : in->operation == SCENE_OP_STORE ? span : in->n;

		if (in->operation >= N_SCENE_OPERATIONS || (jumps && in->to > code->n_instructions) ||
		    (in->operation == SCENE_OP_TEXTURE && in->b >= n_textures))
			abort();
		if (!jumps && in->operation != SCENE_OP_KILL && in->operation != SCENE_OP_MASK &&
		    (in->to < first || in->to + results > code->n_registers))
			abort();
		for (unsigned k = 0; k < program_operands(in->operation); k++)
			if (!code_is_there(code, operands[k],
			                   k == 0 && in->operation == SCENE_OP_TEXTURE ? 4 :
			                   k == 0 && in->operation == SCENE_OP_FETCH   ? span + in->n - 1 :
			                   in->flags >> k & 1                          ? in->n :
			                                                                 1))
				abort();
	}
}
