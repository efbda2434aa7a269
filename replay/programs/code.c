#include "replay/programs/code.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "replay/machine/state.h"

int program_append(struct program_code *code, const struct scene_instruction *instruction)
{
	if (code->n_instructions == SCENE_PROGRAM_INSTRUCTIONS)
		return ERR_INPUT;
	if (MEMORY_GROW(code->instructions, code->instruction_room, code->n_instructions + 1))
		return ERR_SYSTEM;
	code->across |= instruction->operation == SCENE_OP_TEXTURE || instruction->operation == SCENE_OP_DX ||
	                instruction->operation == SCENE_OP_DY;
	code->instructions[code->n_instructions++] = *instruction;
	return 0;
}

static int is_same(const struct program_constant *a, const struct program_constant *b)
{
	return a->source == b->source && a->index == b->index && a->part == b->part && a->face == b->face &&
	       a->row == b->row && memcmp(a->value, b->value, sizeof(a->value)) == 0;
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

uint32_t program_target(const struct program_stage *stage, uint32_t unit)
{
	for (uint32_t i = 0; i < stage->code->n_samplers; i++)
		if (program_unit_of(stage, i) == unit)
			return stage->code->samplers[i].target + 1;
	return stage->code->targets[unit];
}

uint32_t program_operands(uint32_t operation)
{
	switch (operation) {
	case SCENE_OP_FETCH:
	case SCENE_OP_STORE: return 2;
	case SCENE_OP_JUMP: return 0;
	case SCENE_OP_KILL:
	case SCENE_OP_MASK:
	case SCENE_OP_JUMP_NONE:
	case SCENE_OP_TEXTURE: return 1;
	default: return operation < SCENE_OP_ADD ? 1 : operation < SCENE_OP_MAD ? 2 : 3;
	}
}

/* 1 if a constant is a colour that a light emits. */
static int is_sent(const struct program_constant *c)
{
	return (c->source == PROGRAM_LIGHT && (c->part == PROGRAM_LIGHT_DIFFUSE || c->part == PROGRAM_LIGHT_SPECULAR)) ||
	       (c->source == PROGRAM_LIGHT_PRODUCT && (c->part == GLS_DIFFUSE || c->part == GLS_SPECULAR));
}

uint32_t program_constant_operand(struct program_code *code, const struct program_constant *constant)
{
	const uint32_t number = program_constant(code, constant);

	if (number == UINT32_MAX)
		return number;
	for (uint32_t i = 0; i < code->n_lights; i++)
		if (code->lights[i].constant == number)
			return code->lights[i].to;
	if (!is_sent(constant) || code->n_registers + 4 > SCENE_PROGRAM_REGISTERS)
		return SCENE_PROGRAM_CONSTANT + 4 * number;
	if (MEMORY_GROW(code->lights, code->light_room, code->n_lights + 1))
		return UINT32_MAX;
	code->lights[code->n_lights++] = (struct program_light){ code->n_registers, number };
	code->n_registers += 4;
	return code->n_registers - 4;
}

uint32_t program_lights(const struct program_code *code)
{
	uint32_t lights = 0;

	for (uint32_t i = 0; i < code->n_lights; i++)
		lights |= 1u << code->constants[code->lights[i].constant].index;
	return lights;
}

void program_code_free(struct program_code *code)
{
	free(code->lights);
	free(code->instructions);
	free(code->constants);
	memset(code, 0, sizeof(*code));
}
