/*
 * Programs of a draw's vertices and fragments (ARB_vertex_program, ARB_fragment_program), as replay/programs/
 * translates them and kernels run them (kernels/gl/instructions.h): instructions on registers of one number each.
 * scene.programs holds them as words: a struct scene_program, its instructions, its constants. A material names its
 * two, scene_material.vertex_program and .fragment_program.
 *
 * Registers: a stage's inputs, four for each, then its outputs, then the program's own. All but inputs begin as 0.
 */
#pragma once

#ifndef __OPENCL_VERSION__
#include <stddef.h>
#endif

#include "scene/scene.h"

#define SCENE_PROGRAM_REGISTERS 512u     /* at most */
#define SCENE_PROGRAM_INSTRUCTIONS 65536u /* at most; fewer than SCENE_PROGRAM_STEPS */
#define SCENE_PROGRAM_CONSTANT 0x10000u  /* added to a constant's number where an operand is one */
/* instructions in loops that a fragment or vertex runs at most; then its program ends */
#define SCENE_PROGRAM_STEPS 0x40000u

/* --- Fragments: outputs are SCENE_PROGRAM_COLOR and SCENE_PROGRAM_DEPTH, four registers each --------------------- */

enum scene_program_input {
	SCENE_INPUT_COLOR, SCENE_INPUT_SECONDARY,
	SCENE_INPUT_FOG,      /* its coordinate, 0, 0, 1 */
	SCENE_INPUT_POSITION, /* in the window; w is 1 / clip w */
	SCENE_INPUT_FACE,     /* 1 where the front of its triangle shows, 0, 0, 0 */
	SCENE_INPUT_TEXCOORD, /* of unit 0; others follow */
	N_SCENE_INPUTS = SCENE_INPUT_TEXCOORD + SCENE_MAX_UNITS
};
#define SCENE_PROGRAM_COLOR (4u * N_SCENE_INPUTS)
#define SCENE_PROGRAM_DEPTH (SCENE_PROGRAM_COLOR + 4u)
#define SCENE_PROGRAM_FIRST (SCENE_PROGRAM_DEPTH + 4u) /* of the program's own */

/* --- Vertices: attributes in object space, as the program's calls gave them -------------------------------------- */

enum scene_vertex_input {
	SCENE_VERTEX_POSITION, SCENE_VERTEX_NORMAL, SCENE_VERTEX_COLOR, SCENE_VERTEX_SECONDARY,
	SCENE_VERTEX_FOG,      /* its coordinate, 0, 0, 1 */
	SCENE_VERTEX_TEXCOORD, /* of unit 0; others follow */
	SCENE_VERTEX_GENERIC = SCENE_VERTEX_TEXCOORD + SCENE_MAX_UNITS, /* attribute 1; others follow. 0 is the position */
	N_SCENE_VERTEX_INPUTS = SCENE_VERTEX_GENERIC + SCENE_MAX_GENERICS
};

/* What the fragment stage reads, fixed function or a program: TEXCOORD is SCENE_INPUT_TEXCOORD there, whatever it
 * means. */
enum scene_vertex_output {
	SCENE_RESULT_POSITION, /* clip coordinates */
	SCENE_RESULT_COLOR, SCENE_RESULT_SECONDARY, SCENE_RESULT_BACK_COLOR, SCENE_RESULT_BACK_SECONDARY,
	SCENE_RESULT_FOG, SCENE_RESULT_POINT_SIZE, /* the first of four */
	SCENE_RESULT_CLIP_VERTEX, /* in eye space: clip planes clip by it */
	SCENE_RESULT_TEXCOORD, /* of unit 0; others follow */
	N_SCENE_VERTEX_OUTPUTS = SCENE_RESULT_TEXCOORD + SCENE_MAX_UNITS
};
#define SCENE_VERTEX_RESULTS (4u * N_SCENE_VERTEX_INPUTS) /* the first output */
#define SCENE_VERTEX_FIRST (SCENE_VERTEX_RESULTS + 4u * N_SCENE_VERTEX_OUTPUTS) /* of the program's own */

/* --- Both -------------------------------------------------------------------------------------------------------- */

struct scene_program {
	uint32_t n_instructions;
	uint32_t n_constants; /* numbers */
	uint32_t n_registers;
	uint32_t inputs;      /* bits 1 << scene_program_input or scene_vertex_input: those that it reads */
	uint32_t kills;       /* 1: it may discard fragments */
	uint32_t sets_depth;  /* 1: register SCENE_PROGRAM_DEPTH is the fragment's depth */
	uint32_t outputs;     /* bits 1 << scene_vertex_output: those that count. Without a position it is fixed function's */
	uint32_t across;      /* 1: it asks how numbers change from pixel to pixel: all four count. Else each by itself */
	uint32_t n_lights;    /* struct scene_program_light, between instructions and constants */
	uint32_t ended; /* 0; kernels set it to 1 where the program reached SCENE_PROGRAM_STEPS: what it made is not
	                   what it means */
	uint32_t data, n_data; /* gl_FragData: its first register, how many colours it is; 0: all buffers have
	                          SCENE_PROGRAM_COLOR */
};

#ifndef __OPENCL_VERSION__
/** A program of scene.programs. @param number  as materials name it. @return NULL: none */
static inline const struct scene_program *scene_program_of(const struct scene *scene, uint32_t number)
{
	return number ? (const struct scene_program *)(scene->programs + (number - 1)) : NULL;
}
#endif

/* Four registers that hold what a light sends, before the first instruction: so a light that does not arrive can be
 * left out. */
struct scene_program_light {
	uint32_t to, from; /* the first register; the first number among the constants. The fourth number is left as it is */
	uint32_t slot;         /* in the material's list of lights */
};

/*
 * X(enumerator): to = f(a, b, c). Those before ADD take a alone, those before MAD a and b. What is true is 1, what is
 * not is 0; all but 0 counts as true.
 *
 * The four run in step, and those of a mask take part: what they compute is kept, what others would is not. All do
 * until MASK says else.
 */
#define SCENE_OPERATIONS(X) \
	X(MOVE) X(ABSOLUTE) X(FLOOR) X(FRACTION) X(RECIPROCAL) X(INVERSE_ROOT) X(EXP2) X(LOG2) X(SINE) X(COSINE) \
	X(SQUARE_ROOT) X(TRUNCATE) \
	X(ROUND) /* to the even one where two are as near */ \
	X(DX) X(DY) /* by how much it is more one pixel to the right, or up */ \
	X(ADD) X(MULTIPLY) X(MINIMUM) X(MAXIMUM) X(LESS) X(GREATER_EQUAL) X(POWER) X(DIVIDE) X(EQUAL) X(NOT_EQUAL) \
	X(AND) X(AND_NOT) /* a and not b */ \
	X(MAD)    /* a b + c */ \
	X(SELECT) /* a < 0 ? b : c */ \
	X(CHOOSE) /* a ? b : c */ \
	X(KILL)   /* the fragment is discarded where a < 0 */ \
	X(FETCH)  /* n numbers of an array's element b, a whole number: a is the array's first number, register or \
	             constant; c is SCENE_ARRAY(elements, numbers of each). Zeros where it has no such element */ \
	X(STORE)  /* a becomes the first number of element b of an array of registers, which begins at `to`; c as above */ \
	X(MASK)   /* those take part from here on of whom a is true */ \
	X(JUMP) X(JUMP_NONE) /* to instruction number `to`; where a is true of none of the four */ \
	/* four registers from `to` on; the coordinates are four registers from a on, b the unit, c SCENE_TEXTURE_* */ \
	X(TEXTURE)
enum scene_operation {
#define SCENE_OPERATION(name) SCENE_OP_##name,
	SCENE_OPERATIONS(SCENE_OPERATION)
	N_SCENE_OPERATIONS
};

#define SCENE_ARRAY(elements, numbers) ((elements) << 16 | (numbers))

#define SCENE_TEXTURE_DIVIDED 1u /* coordinates are divided by the fourth */
#define SCENE_TEXTURE_BIASED 2u  /* the fourth is added to the level */
#define SCENE_TEXTURE_LEVEL 4u   /* the fourth is the level */

#define SCENE_STEP_A 1u      /* each of an instruction's numbers has the next a */
#define SCENE_STEP_B 2u
#define SCENE_STEP_C 4u
#define SCENE_NEGATE_A 8u
#define SCENE_NEGATE_B 16u
#define SCENE_NEGATE_C 32u
#define SCENE_SATURATE 64u   /* results are clamped to [0,1] */
#define SCENE_UNMASKED 128u  /* all of the four take part */

/* n results, in registers from `to` on. */
struct scene_instruction {
	uint32_t operation, n, flags; /* flags: SCENE_STEP_A ... */
	uint32_t to, a, b, c;
};
