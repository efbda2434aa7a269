/* Conditional rendering (NV_conditional_render, GL 3.0 sec. 2.14). */
#include "gl_tokens.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/state.h"

/* 1 for modes that draw if nothing was counted (ARB_conditional_render_inverted). */
static int is_inverted(uint32_t mode)
{
	return mode >= GL_QUERY_WAIT_INVERTED && mode <= GL_QUERY_BY_REGION_NO_WAIT_INVERTED;
}

GLS_HANDLER(glBeginConditionalRender, OBJECT)
{
	const uint32_t mode = arg_u(c, 1);

	if (gls_refuses(x, st, !is_inverted(mode) && (mode < GL_QUERY_WAIT || mode > GL_QUERY_BY_REGION_NO_WAIT),
	                GL_INVALID_ENUM))
		return;
	if (gls_refuses(x, st, st->conditional, GL_INVALID_OPERATION))
		return;
	if (!st->answered)
		gls_unsupported(x, "the query's result is not in the recording: drawn in any case");
	st->conditional = 1;
	st->left_out = st->answered && (st->answer != 0) == is_inverted(mode);
	st->answered = 0;
}

GLS_HANDLER(glEndConditionalRender, OBJECT)
{
	if (gls_refuses(x, st, !st->conditional, GL_INVALID_OPERATION))
		return;
	st->conditional = st->left_out = 0;
}
