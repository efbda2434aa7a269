/* Programs of GLSL, translated: shaders of both stages become instructions (scene/program.h), names get their
 * places. */
#pragma once

#include <stdint.h>

#include "replay/glsl/tree/tree.h"
#include "replay/glsl/uniforms.h"
#include "replay/programs/code.h"

/* What is linked. A stage without texts is fixed function's. */
struct glsl_sources {
	const char *const *texts[2]; /* by enum glsl_stage */
	uint32_t n_texts[2];
	const struct glsl_attribute *attributes;
	uint32_t n_attributes;
	uint32_t products_once; /* 1: as of glsl_parse */
};

/**
 * @param code      [2], by enum glsl_stage, all zero; to be freed with program_code_free whatever is returned
 * @param uniforms  all zero; to be freed likewise. Their first values are those of the text
 * @param message   [GLSL_MESSAGE] room for a reason
 * @param why       receives NULL, or what stands in the way: a static string, or `message`
 * @return 0, also where *why is set, or ERR_SYSTEM (reported)
 */
int glsl_translate(const struct glsl_sources *sources, struct program_code code[2], struct glsl_uniforms *uniforms,
                   char *message, const char **why);
