/*
 * Finds the instruction that computes a number. Used to reproduce Mesa's optimizations that change the last bit
 * (roots.h, factors.h). The search does not go past jumps, masks or jump targets.
 */
#pragma once

#include <stdbool.h>

#include "replay/programs/code.h"

/* The most instructions of code that is searched: searching takes quadratic time, 1 s for this many. */
#define GLSL_MAX_SEARCHED 16384

/*
 * The origin of a number that an instruction reads, found through copies. Two numbers are the same if all members
 * except is_made are equal.
 */
struct glsl_maker {
	uint32_t at;  /* the instruction that computes it; if none was found: where the search ended */
	uint32_t r;   /* the register that it is computed in */
	bool is_made;
};

/** Mark jump targets. targets: [SCENE_PROGRAM_INSTRUCTIONS + 1] 1: a jump leads there */
void glsl_note_targets(const struct program_code *code, uint8_t *targets);

/** Find the origin of operand r, a single number, before instruction `at`. */
struct glsl_maker glsl_find_maker(const struct program_code *code, const uint8_t *targets, uint32_t at, uint32_t r);

/** The operand for result i of an instruction. operand: 0 for a, 1 for b, 2 for c */
uint32_t glsl_operand(const struct scene_instruction *in, unsigned operand, uint32_t i);

/** True if an instruction writes a register. */
bool glsl_writes(const struct scene_instruction *in, uint32_t r);
bool glsl_is_jump(const struct scene_instruction *in);

/**
 * Insert an instruction before another one; jumps to the old instruction then lead to the inserted one.
 * @return 0, ERR_SYSTEM (reported), or ERR_INPUT: there is no room
 */
int glsl_insert(struct program_code *code, uint32_t at, struct scene_instruction instruction);

/** Split an instruction into one for the first n results and one for the rest. @return as glsl_insert */
int glsl_split(struct program_code *code, uint32_t at, uint32_t n);
