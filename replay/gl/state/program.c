/* Later features that fixed-function programs may use: several draw buffers. */
#include "gl_tokens.h"
#include "replay/gl/surface/attachment.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"

/*
 * Fixed function writes the same colour to every buffer (GL 2.1 sec. 3.11.2, 4.2.1); a shader's outputs follow the
 * order of the list.
 */
GLS_HANDLER(glDrawBuffers, STATE)
{
	uint32_t list[16] = { GL_NONE }, buffer = GL_NONE, also = 0;
	unsigned n = arg_uints(c, 1, list, 16);

	for (unsigned i = 1; i < n; i++)
		if (list[i] != GL_NONE && (list[i - 1] == GL_NONE || list[i] <= list[i - 1]))
			also |= GLS_OUT_OF_ORDER;
	for (unsigned i = 0; i < n; i++) {
		int is_pair = (buffer == GL_BACK_LEFT && list[i] == GL_FRONT_LEFT) ||
		              (buffer == GL_FRONT_LEFT && list[i] == GL_BACK_LEFT);

		if (is_pair && !st->draw_framebuffer)
			buffer = GL_FRONT_AND_BACK;
		else if (buffer == GL_NONE)
			buffer = list[i];
		else if (list[i] >= GL_COLOR_ATTACHMENT0 && list[i] - GL_COLOR_ATTACHMENT0 < GLS_ATTACHMENT_DEPTH)
			also |= 1u << (list[i] - GL_COLOR_ATTACHMENT0);
		else if (list[i] != GL_NONE)
			gls_unsupported(x, "more than one colour buffer of a window at a time");
	}
	st->a.color.draw_buffer = buffer;
	st->a.color.also_drawn = st->draw_framebuffer ? also : 0;
}
