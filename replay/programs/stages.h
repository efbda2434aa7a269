/* What a program object of GLSL runs (replay/glsl has the objects): the first member of struct gls_shader, so that this room need not know more. */
#pragma once

#include <stdint.h>

#include "replay/programs/code.h"

enum gls_stage { GLS_VERTEX_STAGE, GLS_FRAGMENT_STAGE, N_GLS_STAGES };

struct gls_stages {
	uint32_t linked;          /* 1: it was */
	const char *why;          /* what stands in the way of running it; a static string, NULL: nothing */
	uint32_t runs[N_GLS_STAGES]; /* 1: it has such shaders; else fixed function runs the stage */
	struct program_code code[N_GLS_STAGES];
	const float (*uniforms)[4]; /* borrowed; parameters of both, as of struct program_stage.local */
};
