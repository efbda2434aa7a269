/*
 * The code of a GLSL program object (replay/glsl has the objects). It is the first member of struct gls_shader, so that
 * this folder need not know the rest.
 */
#pragma once

#include <stdint.h>

#include "replay/programs/code.h"

enum gls_stage { GLS_VERTEX_STAGE, GLS_FRAGMENT_STAGE, N_GLS_STAGES };

/* Uniform values that a context keeps drawing with (held.h). */
struct gls_held {
	uint64_t context; /* handle of the context */
	enum gls_stage stage;
	float (*values)[4]; /* owned; laid out as `uniforms` */
};

struct gls_stages {
	uint32_t linked;          /* 1: it has been linked */
	uint32_t links;           /* number of times it was linked */
	const char *why;          /* why it cannot be run, until it is linked again; NULL: it can */
	uint32_t runs[N_GLS_STAGES]; /* 1: it has such shaders; 0: fixed function runs the stage */
	struct program_code code[N_GLS_STAGES];
	const float (*uniforms)[4]; /* borrowed; parameters of both stages, as struct program_stage.local */
	uint32_t n_uniforms;        /* in groups of four floats */
	struct gls_held *held;      /* owned */
	uint32_t n_held, held_room;
};
