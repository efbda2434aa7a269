/*
 * What makes the numbers that an instruction uses: rules of Mesa's about the last bit look at it (roots.h, factors.h).
 * Nothing is known beyond what jumps or masks, or where something jumps to.
 */
#pragma once

#include <stdbool.h>

#include "replay/programs/code.h"

/* instructions of code that is searched: the searches take the square of them, 1 s then */
#define GLSL_MAX_SEARCHED 16384

/* A number before an instruction, copies left out. Two are the same number where all but is_made are equal. */
struct glsl_maker {
	uint32_t at;  /* the instruction that makes it; not made: where the search ended */
	uint32_t r;   /* the register that it makes it in */
	bool is_made;
};

/** Note where something jumps to. targets: [SCENE_PROGRAM_INSTRUCTIONS + 1] 1: there */
void glsl_note_targets(const struct program_code *code, uint8_t *targets);

/** Find what makes operand r, one number, before instruction `at`. */
struct glsl_maker glsl_find_maker(const struct program_code *code, const uint8_t *targets, uint32_t at, uint32_t r);

/** The operand of an instruction's number i. operand: 0 for a, 1, 2 */
uint32_t glsl_operand(const struct scene_instruction *in, unsigned operand, uint32_t i);

/** Whether an instruction writes a register. */
bool glsl_writes(const struct scene_instruction *in, uint32_t r);
bool glsl_is_jump(const struct scene_instruction *in);

/**
 * Insert an instruction before another one; jumps to that one lead to the new one then.
 * @return 0, ERR_SYSTEM (reported), or ERR_INPUT: there is no room
 */
int glsl_insert(struct program_code *code, uint32_t at, struct scene_instruction instruction);

/** Make an instruction of several numbers one for the first n, and one for the others. @return as of glsl_insert */
int glsl_split(struct program_code *code, uint32_t at, uint32_t n);
