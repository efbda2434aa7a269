/*
 * A program translated: instructions for kernels (scene/program.h), and what state their constants are of. The
 * translators write it, and build.c fills in the numbers when something is drawn.
 */
#pragma once

#include <stdint.h>

#include "scene/program.h"

/* Where the four numbers of a constant come from (ARB_vertex_program and ARB_fragment_program, tables X.1 to X.5). */
enum program_source {
	PROGRAM_LITERAL,       /* value */
	PROGRAM_ENV,           /* index */
	PROGRAM_LOCAL,         /* index */
	PROGRAM_MATERIAL,      /* index: face; part: GLS_AMBIENT ..., PROGRAM_SHININESS */
	PROGRAM_LIGHT,         /* index: light; part: enum program_light_part */
	PROGRAM_LIGHT_MODEL,   /* ambient */
	PROGRAM_SCENE_COLOR,   /* index: face */
	PROGRAM_LIGHT_PRODUCT, /* index: light; face; part: GLS_AMBIENT ... */
	PROGRAM_ENV_COLOR,     /* index: unit */
	PROGRAM_FOG_COLOR,
	PROGRAM_FOG_NUMBERS,   /* density, start, end, 1 / (end - start) */
	PROGRAM_DEPTH_RANGE,   /* near, far, far - near, 1 */
	PROGRAM_MATRIX,        /* index: enum program_matrix; part: bits below; row */
	PROGRAM_CLIP_PLANE,    /* index */
	PROGRAM_POINT_NUMBERS, /* size, least, most, fade threshold */
	PROGRAM_POINT_ATTENUATION,
	PROGRAM_TEXGEN,        /* index: unit; part: 0 eye plane, 1 object plane; row: s t r q */
	PROGRAM_NORMAL_SCALE   /* the factor of RESCALE_NORMAL */
};
enum program_light_part {
	PROGRAM_LIGHT_AMBIENT, PROGRAM_LIGHT_DIFFUSE, PROGRAM_LIGHT_SPECULAR, PROGRAM_LIGHT_POSITION,
	PROGRAM_LIGHT_ATTENUATION,
	PROGRAM_LIGHT_DIRECTION, /* of a spot; the fourth: cosine of its cutoff */
	PROGRAM_LIGHT_HALF,      /* half-way vector of a light at infinity */
	PROGRAM_LIGHT_CUTOFF     /* of a spot, degrees */
};
enum program_matrix {
	PROGRAM_MODELVIEW, PROGRAM_PROJECTION, PROGRAM_MVP,
	PROGRAM_TEXTURE_MATRIX,                                          /* of unit 0; others follow */
	PROGRAM_OWN_MATRIX = PROGRAM_TEXTURE_MATRIX + SCENE_MAX_UNITS    /* GL_MATRIX0_ARB; others follow */
};
enum { PROGRAM_SHININESS = 16 };                         /* beside GLS_AMBIENT to GLS_EMISSION */
enum { PROGRAM_INVERTED = 1, PROGRAM_TRANSPOSED = 2 };   /* of matrices */

struct program_constant {
	enum program_source source;
	uint32_t index, part, face, row;
	float value[4];
};

/* Registers that a light's constant is moved to (struct scene_program_light). */
struct program_light {
	uint32_t to, constant; /* constant: its number */
};

/* What GLSL samples: a uniform says of which unit. */
struct program_sampler {
	uint32_t uniform; /* number in stage.local, counted by single ones */
	uint32_t target;  /* enum gls_texture_target */
};
#define PROGRAM_MAX_SAMPLERS 32u

struct program_code {
	struct scene_instruction *instructions; /* owned */
	struct program_constant *constants;     /* owned */
	struct program_light *lights;           /* owned */
	uint32_t n_instructions, n_constants, n_registers, n_lights;
	uint32_t instruction_room, constant_room, light_room;
	uint32_t inputs, kills, sets_depth, outputs, across, data, n_data; /* as in struct scene_program */
	uint32_t targets[SCENE_MAX_UNITS];  /* 1 + enum gls_texture_target of what it samples of each unit; 0: nothing */
	uint32_t enabled;                   /* bits: units of which it samples what fixed function would */
	struct program_sampler samplers[PROGRAM_MAX_SAMPLERS]; /* where there are some, TEXTURE names one of them in
	                                                          place of its unit */
	uint32_t n_samplers;
};

/* A stage of the pipeline that a program runs: what it is, and what its parameters hold (PROGRAM_ENV, PROGRAM_LOCAL).
 * Borrowed. */
struct program_stage {
	const struct program_code *code;
	const float (*env)[4], (*local)[4];
};

/** The unit of one of the samplers of a stage's code. */
static inline uint32_t program_unit_of(const struct program_stage *stage, uint32_t sampler)
{
	const uint32_t number = stage->code->samplers[sampler].uniform;
	const float unit = stage->local[number / 4][number % 4];

	return unit >= 0 && unit < 255 ? (uint32_t)unit : 255;
}

/** 1 + enum gls_texture_target of what a stage samples of a unit; 0: nothing */
uint32_t program_target(const struct program_stage *stage, uint32_t unit);

/**
 * Append an instruction. @return 0, or ERR_SYSTEM: out of memory (reported), ERR_INPUT: there are
 * SCENE_PROGRAM_INSTRUCTIONS already
 */
int program_append(struct program_code *code, const struct scene_instruction *instruction);

/** The number of a constant, which is added where there is none like it; UINT32_MAX: out of memory (reported). */
uint32_t program_constant(struct program_code *code, const struct program_constant *constant);

/** How many of an instruction's a, b and c are operands. */
uint32_t program_operands(uint32_t operation);

/** The same, added in any case: behind the last. */
uint32_t program_constant_append(struct program_code *code, const struct program_constant *constant);

/**
 * The operand that stands for a constant's first number: the constant, or registers of the program's own where it is
 * what a light sends.
 * @return it; UINT32_MAX: out of memory (reported)
 */
uint32_t program_constant_operand(struct program_code *code, const struct program_constant *constant);

/** Lights that it reads: 1 << number. */
uint32_t program_lights(const struct program_code *code);

void program_code_free(struct program_code *code);
