/*
 * A translated program: instructions for kernels (scene/program.h), and the GL state that its constants come from. The
 * translators write it, and build/program.c fills in the values for each draw.
 */
#pragma once

#include <stdint.h>

#include "scene/program.h"

/* The source of a constant's four numbers (ARB_vertex_program and ARB_fragment_program, tables X.1 to X.5). */
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
	PROGRAM_POINT_NUMBERS, /* size, minimum, maximum, fade threshold */
	PROGRAM_POINT_ATTENUATION,
	PROGRAM_TEXGEN,        /* index: unit; part: 0 eye plane, 1 object plane; row: s t r q */
	PROGRAM_NORMAL_SCALE   /* the factor of RESCALE_NORMAL */
};
enum program_light_part {
	PROGRAM_LIGHT_AMBIENT, PROGRAM_LIGHT_DIFFUSE, PROGRAM_LIGHT_SPECULAR, PROGRAM_LIGHT_POSITION,
	PROGRAM_LIGHT_ATTENUATION,
	PROGRAM_LIGHT_DIRECTION, /* a spotlight's; fourth component: cosine of its cutoff */
	PROGRAM_LIGHT_HALF,      /* half-way vector of a light at infinity */
	PROGRAM_LIGHT_CUTOFF     /* a spotlight's, degrees */
};
enum program_matrix {
	PROGRAM_MODELVIEW, PROGRAM_PROJECTION, PROGRAM_MVP,
	PROGRAM_TEXTURE_MATRIX,                                          /* unit 0; the other units follow */
	PROGRAM_OWN_MATRIX = PROGRAM_TEXTURE_MATRIX + SCENE_MAX_UNITS    /* GL_MATRIX0_ARB; the others follow */
};
enum { PROGRAM_SHININESS = 16 };                         /* in addition to GLS_AMBIENT to GLS_EMISSION */
enum { PROGRAM_INVERTED = 1, PROGRAM_TRANSPOSED = 2 };   /* bits of a matrix constant */

struct program_constant {
	enum program_source source;
	uint32_t index, part, face, row;
	float value[4];
};

/* Registers that a light's constant is moved to (struct scene_program_light). */
struct program_light {
	uint32_t to, constant; /* constant: index in `constants` */
};

/* A GLSL sampler: a uniform gives its unit. */
struct program_sampler {
	uint32_t uniform; /* index in stage.local, in single floats */
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
	uint32_t targets[SCENE_MAX_UNITS];  /* by unit: 1 + enum gls_texture_target that it samples; 0: none */
	uint32_t enabled;                   /* bits: units that it samples as fixed function would */
	struct program_sampler samplers[PROGRAM_MAX_SAMPLERS]; /* if there are any, TEXTURE instructions refer to them
	                                                          instead of units */
	uint32_t n_samplers;
};

/*
 * A pipeline stage run by a program: its code, and the values of its parameters (PROGRAM_ENV, PROGRAM_LOCAL). Borrowed.
 */
struct program_stage {
	const struct program_code *code;
	const float (*env)[4], (*local)[4];
};

/** The texture unit of a sampler in a stage's code. */
static inline uint32_t program_unit_of(const struct program_stage *stage, uint32_t sampler)
{
	const uint32_t number = stage->code->samplers[sampler].uniform;
	const float unit = stage->local[number / 4][number % 4];

	return unit >= 0 && unit < 255 ? (uint32_t)unit : 255;
}

/** 1 + enum gls_texture_target that a stage samples from a unit; 0: none */
uint32_t program_target(const struct program_stage *stage, uint32_t unit);

/**
 * Append an instruction. @return 0, or ERR_SYSTEM: out of memory (reported), ERR_INPUT: there are
 * SCENE_PROGRAM_INSTRUCTIONS already
 */
int program_append(struct program_code *code, const struct scene_instruction *instruction);

/** Find a constant, or append it if there is none like it. @return its index; UINT32_MAX: out of memory (reported) */
uint32_t program_constant(struct program_code *code, const struct program_constant *constant);

/** Number of operands among an instruction's a, b and c. */
uint32_t program_operands(uint32_t operation);

/** As program_constant, but always append. */
uint32_t program_constant_append(struct program_code *code, const struct program_constant *constant);

/**
 * The operand for a constant's first number: the constant itself, or registers of the program if a light provides the
 * value.
 * @return the operand; UINT32_MAX: out of memory (reported)
 */
uint32_t program_constant_operand(struct program_code *code, const struct program_constant *constant);

/** Lights that the code reads: 1 << number. */
uint32_t program_lights(const struct program_code *code);

void program_code_free(struct program_code *code);
