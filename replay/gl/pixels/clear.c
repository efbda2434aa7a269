/* Clear (GL 2.1 sec. 4.2.3). */
#include "gl_tokens.h"
#include "replay/gl/pixels/accum.h"
#include "replay/gl/surface/draw.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"

GLS_HANDLER(glClear, STATE)
{
	uint32_t mask = arg_u(c, 0);

	if (mask & ~(uint32_t)(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_ACCUM_BUFFER_BIT)) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	if (mask & GL_ACCUM_BUFFER_BIT)
		gls_accum_clear(x, st);
	if (mask & GL_DEPTH_BUFFER_BIT)
		st->depth_used = 1;
	gls_draw_clear(x, st, (mask & GL_COLOR_BUFFER_BIT ? 1u : 0) | (mask & GL_DEPTH_BUFFER_BIT ? 2u : 0) |
	                           (mask & GL_STENCIL_BUFFER_BIT ? 4u : 0));
}
