/* What a program object of GLSL runs (replay/glsl has the objects): the first member of struct gls_shader, so that this
 * room need not know more. */
#pragma once

#include <stdint.h>

#include "replay/programs/code.h"

enum gls_stage { GLS_VERTEX_STAGE, GLS_FRAGMENT_STAGE, N_GLS_STAGES };

/* Uniforms that a context goes on drawing with (held.h). */
struct gls_held {
	uint64_t context; /* its handle */
	enum gls_stage stage;
	float (*values)[4]; /* owned; as uniforms */
};

struct gls_stages {
	uint32_t linked;          /* 1: it was */
	uint32_t links;           /* how often */
	const char *why;          /* what stands in the way of running it, until it is linked again; NULL: nothing */
	uint32_t runs[N_GLS_STAGES]; /* 1: it has such shaders; else fixed function runs the stage */
	struct program_code code[N_GLS_STAGES];
	const float (*uniforms)[4]; /* borrowed; parameters of both, as of struct program_stage.local */
	uint32_t n_uniforms;        /* fours */
	struct gls_held *held;      /* owned */
	uint32_t n_held, held_room;
};
