#include "replay/programs/code.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"

int program_append(struct program_code *code, const struct scene_instruction *instruction)
{
	if (code->n_instructions == SCENE_PROGRAM_INSTRUCTIONS)
		return ERR_INPUT;
	if (MEMORY_GROW(code->instructions, code->instruction_room, code->n_instructions + 1))
		return ERR_SYSTEM;
	code->instructions[code->n_instructions++] = *instruction;
	return 0;
}

static int is_same(const struct program_constant *a, const struct program_constant *b)
{
	return a->source == b->source && a->index == b->index && a->part == b->part && a->face == b->face && a->row == b->row &&
	       memcmp(a->value, b->value, sizeof(a->value)) == 0;
}

uint32_t program_constant(struct program_code *code, const struct program_constant *constant)
{
	for (uint32_t i = 0; i < code->n_constants; i++)
		if (is_same(&code->constants[i], constant))
			return i;
	return program_constant_append(code, constant);
}

uint32_t program_constant_append(struct program_code *code, const struct program_constant *constant)
{
	if (MEMORY_GROW(code->constants, code->constant_room, code->n_constants + 1))
		return UINT32_MAX;
	code->constants[code->n_constants] = *constant;
	return code->n_constants++;
}

void program_code_free(struct program_code *code)
{
	free(code->instructions);
	free(code->constants);
	memset(code, 0, sizeof(*code));
}
