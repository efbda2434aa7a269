/* Translation of ARB assembly programs. An input is a stage and the text. The result must stay within its registers. */
#include "replay/programs/arb.h"
#include "tests/fuzz/code_check.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct program_code code = { 0 };
	const int is_vertex = size ? data[0] & 1 : 0;
	const char *why;

	if (!size)
		return 0;
	if (!program_translate_arb((const char *)data + 1, size - 1, is_vertex, &code, &why) && !why)
		code_check(&code, is_vertex ? SCENE_VERTEX_RESULTS : SCENE_PROGRAM_COLOR, SCENE_MAX_UNITS);
	program_code_free(&code);
	return 0;
}
