/*
 * Programs of a draw's vertices and fragments (ARB_vertex_program, ARB_fragment_program, GLSL), as replay/programs/
 * translates them and kernels run them (kernels/gl/instructions.h): instructions on registers of one number each.
 * scene.programs holds each as words: a struct scene_program, its instructions, its constants. A material refers to its
 * two by scene_material.vertex_program and .fragment_program.
 *
 * Registers: a stage's inputs, four for each, then its outputs, then temporaries. All but inputs start at 0.
 */
#pragma once

#ifndef __OPENCL_VERSION__
#include <stddef.h>
#endif

#include "scene/scene.h"

#define SCENE_PROGRAM_REGISTERS 512u     /* most registers of a program */
#define SCENE_PROGRAM_INSTRUCTIONS 65536u /* most instructions of a program; fewer than SCENE_PROGRAM_STEPS */
#define SCENE_PROGRAM_CONSTANT 0x10000u  /* added to a constant's number to make it an operand */
/* most instructions that a fragment or vertex runs in loops; its program then ends */
#define SCENE_PROGRAM_STEPS 0x40000u

/* --- Fragments: outputs are SCENE_PROGRAM_COLOR and SCENE_PROGRAM_DEPTH, four registers each --------------------- */

enum scene_program_input {
	SCENE_INPUT_COLOR, SCENE_INPUT_SECONDARY,
	SCENE_INPUT_FOG,      /* fog coordinate, 0, 0, 1 */
	SCENE_INPUT_POSITION, /* in the window; w is 1 / clip w */
	SCENE_INPUT_FACE,     /* 1 if the front of its triangle shows, 0, 0, 0 */
	SCENE_INPUT_TEXCOORD, /* unit 0; the other units follow */
	N_SCENE_INPUTS = SCENE_INPUT_TEXCOORD + SCENE_MAX_UNITS
};
#define SCENE_PROGRAM_COLOR (4u * N_SCENE_INPUTS)
#define SCENE_PROGRAM_DEPTH (SCENE_PROGRAM_COLOR + 4u)
#define SCENE_PROGRAM_FIRST (SCENE_PROGRAM_DEPTH + 4u) /* the first temporary */

/* --- Vertices: attributes in object space, as the program's calls gave them -------------------------------------- */

enum scene_vertex_input {
	SCENE_VERTEX_POSITION, SCENE_VERTEX_NORMAL, SCENE_VERTEX_COLOR, SCENE_VERTEX_SECONDARY,
	SCENE_VERTEX_FOG,      /* fog coordinate, 0, 0, 1 */
	SCENE_VERTEX_TEXCOORD, /* unit 0; the other units follow */
	SCENE_VERTEX_GENERIC = SCENE_VERTEX_TEXCOORD + SCENE_MAX_UNITS, /* attribute 1; others follow. Attribute 0 is
	                                                                   the position */
	N_SCENE_VERTEX_INPUTS = SCENE_VERTEX_GENERIC + SCENE_MAX_GENERICS
};

/* Outputs, as read by the fragment stage, fixed function or program. TEXCOORD arrives there as SCENE_INPUT_TEXCOORD. */
enum scene_vertex_output {
	SCENE_RESULT_POSITION, /* clip coordinates */
	SCENE_RESULT_COLOR, SCENE_RESULT_SECONDARY, SCENE_RESULT_BACK_COLOR, SCENE_RESULT_BACK_SECONDARY,
	SCENE_RESULT_FOG, SCENE_RESULT_POINT_SIZE, /* the first of four numbers */
	SCENE_RESULT_CLIP_VERTEX, /* in eye space: tested against clip planes */
	SCENE_RESULT_TEXCOORD, /* unit 0; the other units follow */
	N_SCENE_VERTEX_OUTPUTS = SCENE_RESULT_TEXCOORD + SCENE_MAX_UNITS
};
#define SCENE_VERTEX_RESULTS (4u * N_SCENE_VERTEX_INPUTS) /* the first output */
#define SCENE_VERTEX_FIRST (SCENE_VERTEX_RESULTS + 4u * N_SCENE_VERTEX_OUTPUTS) /* the first temporary */

/* --- Both -------------------------------------------------------------------------------------------------------- */

struct scene_program {
	uint32_t n_instructions;
	uint32_t n_constants; /* numbers */
	uint32_t n_registers;
	uint32_t inputs;      /* bits 1 << scene_program_input or scene_vertex_input: the inputs that it reads */
	uint32_t kills;       /* 1: it may discard fragments */
	uint32_t sets_depth;  /* 1: register SCENE_PROGRAM_DEPTH is the fragment's depth */
	uint32_t outputs;     /* bits 1 << scene_vertex_output: those it writes. Without a position, fixed function gives it */
	uint32_t across;      /* 1: it takes differences between pixels, so the four of a quad run together; else each
	                         runs alone */
	uint32_t n_lights;    /* struct scene_program_light, between instructions and constants */
	uint32_t ended; /* 0; kernels set it to 1 if the program reached SCENE_PROGRAM_STEPS, when its results are not
	                   as intended */
	uint32_t data, n_data; /* gl_FragData: its first register and its number of colours; 0: all buffers get
	                          SCENE_PROGRAM_COLOR */
};

#ifndef __OPENCL_VERSION__
/** A program of scene.programs. @param number  as in a material. @return NULL: none */
static inline const struct scene_program *scene_program_of(const struct scene *scene, uint32_t number)
{
	return number ? (const struct scene_program *)(scene->programs + (number - 1)) : NULL;
}
#endif

/* Four registers that receive a light's colour before the first instruction, so that a blocked light can be skipped. */
struct scene_program_light {
	uint32_t to, from; /* its first register; its first number among the constants. The fourth number is unchanged */
	uint32_t slot;         /* index in the material's list of lights */
};

/*
 * X(enumerator): to = f(a, b, c). Operations before ADD take a alone, those before MAD a and b. True results are 1,
 * false ones 0; any number but 0 counts as true.
 *
 * The four pixels of a quad run in step. Results are kept only for the pixels in the current mask: all of them until
 * MASK changes it.
 */
#define SCENE_OPERATIONS(X) \
	X(MOVE) X(ABSOLUTE) X(FLOOR) X(FRACTION) X(RECIPROCAL) X(INVERSE_ROOT) X(EXP2) X(LOG2) X(SINE) X(COSINE) \
	X(SQUARE_ROOT) X(TRUNCATE) \
	X(ROUND) /* halfway cases to the even number */ \
	X(DX) X(DY) /* difference to the next pixel to the right, or above */ \
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
