/*
 * Translation of GLSL programs: shaders of both stages become instructions (scene/program.h), and names get their
 * places.
 */
#pragma once

#include <stdint.h>

#include "replay/glsl/tree/tree.h"
#include "replay/glsl/uniforms.h"
#include "replay/programs/code.h"

/* The texts of a program. A stage without texts is left to fixed function. */
struct glsl_sources {
	const char *const *texts[2]; /* by enum glsl_stage */
	uint32_t n_texts[2];
	const struct glsl_attribute *attributes;
	uint32_t n_attributes;
	uint32_t products_once; /* 1: parameter of glsl_parse */
};

/**
 * Translate a program.
 * @param code      [2], by enum glsl_stage, all zero; to be freed with program_code_free whatever is returned
 * @param uniforms  all zero; to be freed whatever is returned. Set to their initial values
 * @param message   [GLSL_MESSAGE] storage for a reason
 * @param why       receives NULL, or why the program cannot be run: a static string, or `message`
 * @return 0, also if *why is set, or ERR_SYSTEM (reported)
 */
int glsl_translate(const struct glsl_sources *sources, struct program_code code[2], struct glsl_uniforms *uniforms,
                   char *message, const char **why);
