/* Translation of GLSL shaders. An input is a stage and the program's text. The result must stay within its
 * registers. */
#include <stdlib.h>
#include <string.h>

#include "replay/glsl/translate.h"
#include "tests/fuzz/code_check.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct program_code code[2] = { 0 };
	struct glsl_sources sources = { .n_attributes = 0 };
	struct glsl_uniforms uniforms = { 0 };
	const uint32_t stage = size ? data[0] & 1 : 0;
	char *text = malloc(size + 1);
	const char *const texts[1] = { text }, *why;
	char message[GLSL_MESSAGE];

	if (!text)
		return 0;
	if (size)
		memcpy(text, data + 1, size - 1);
	text[size ? size - 1 : 0] = 0;
	sources.texts[stage] = texts;
	sources.n_texts[stage] = 1;
	if (!glsl_translate(&sources, code, &uniforms, message, &why) && !why)
		code_check(&code[stage], stage == GLSL_VERTEX_STAGE ? SCENE_VERTEX_RESULTS : SCENE_PROGRAM_COLOR,
		           code[stage].n_samplers);
	for (unsigned i = 0; i < 2; i++)
		program_code_free(&code[i]);
	glsl_uniforms_free(&uniforms);
	free(text);
	return 0;
}
