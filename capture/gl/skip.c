/* Runs inside the traced program. */
#include "capture/gl/skip.h"

#include <GL/gl.h>
#include <stddef.h>

#include "capture/gl/context.h"
#include "capture/write/tables.h"
#include "capture/write/writer.h"

static _Atomic int skipping;
static __thread int compiling __attribute__((tls_model("initial-exec")));

int skip_draws(void)
{
	return skipping && !compiling;
}

int skip_is_compiling(void)
{
	return compiling;
}

static int is_left_out(unsigned command)
{
	return commands[command].draws && !compiling;
}

void skip_list_state(void)
{
	compiling = context_has(HAS_FIXED_FUNCTION) && context_get(GL_LIST_INDEX) != 0;
}

int skip_active(void)
{
	return skipping;
}

void skip_begin(void)
{
	skipping = 1;
	writer_skip(is_left_out);
}

void skip_end(void)
{
	skipping = 0;
	writer_skip(NULL);
}
