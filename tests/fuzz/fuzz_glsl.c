/* Shaders of GLSL: their translation. An input is a stage and its text, as the program gave it. What comes out must stay within its registers. */
#include <stdlib.h>
#include <string.h>

#include "replay/glsl/translate.h"
#include "tests/fuzz/target.h"

/* n numbers from an operand on are there. */
static int is_there(const struct program_code *code, uint32_t operand, uint32_t n)
{
	return operand >= SCENE_PROGRAM_CONSTANT ? operand - SCENE_PROGRAM_CONSTANT + n <= 4 * code->n_constants : operand + n <= code->n_registers;
}

static void check(const struct program_code *code, uint32_t first)
{
	for (uint32_t i = 0; i < code->n_instructions; i++) {
		const struct scene_instruction *in = &code->instructions[i];
		const uint32_t operands[3] = { in->a, in->b, in->c }, span = (in->c >> 16) * (in->c & 0xffff);
		const int jumps = in->operation == SCENE_OP_JUMP || in->operation == SCENE_OP_JUMP_NONE;
		const uint32_t results = in->operation == SCENE_OP_TEXTURE ? 4 : in->operation == SCENE_OP_STORE ? span : in->n;

		if (in->operation >= N_SCENE_OPERATIONS || (jumps && in->to > code->n_instructions) || (in->operation == SCENE_OP_TEXTURE && in->b >= code->n_samplers))
			abort();
		if (!jumps && in->operation != SCENE_OP_KILL && in->operation != SCENE_OP_MASK && (in->to < first || in->to + results > code->n_registers))
			abort();
		for (unsigned k = 0; k < program_operands(in->operation); k++)
			if (!is_there(code, operands[k], k == 0 && in->operation == SCENE_OP_TEXTURE ? 4 : k == 0 && in->operation == SCENE_OP_FETCH ? span + in->n - 1 :
			                                 in->flags >> k & 1 ? in->n : 1))
				abort();
	}
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct program_code code[2] = { 0 };
	struct glsl_sources sources = { .n_attributes = 0 };
	struct glsl_uniforms uniforms = { 0 };
	const uint32_t stage = size ? data[0] & 1 : 0;
	char *text = malloc(size + 1);
	const char *const texts[1] = { text }, *why;

	if (!text)
		return 0;
	if (size)
		memcpy(text, data + 1, size - 1);
	text[size ? size - 1 : 0] = 0;
	sources.texts[stage] = texts;
	sources.n_texts[stage] = 1;
	if (!glsl_translate(&sources, code, &uniforms, &why) && !why)
		check(&code[stage], stage == GLSL_VERTEX_STAGE ? SCENE_VERTEX_RESULTS : SCENE_PROGRAM_COLOR);
	for (unsigned i = 0; i < 2; i++)
		program_code_free(&code[i]);
	glsl_uniforms_free(&uniforms);
	free(text);
	return 0;
}
