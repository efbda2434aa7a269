/*
 * Later objects that a program of the fixed-function age may use beside it: shaders, framebuffer objects, vertex array
 * objects. Draws with programs are rendered as fixed function and counted; what is drawn into framebuffer objects is
 * counted and left out.
 */
#include "replay/exec.h"

GLS_HANDLER(glUseProgram, STATE) { st->program = arg_u(c, 0); }
GLS_HANDLER(glUseProgramObjectARB, STATE) { st->program = arg_u(c, 0); }

GLS_HANDLER(glBindFramebuffer, STATE)
{
	uint32_t target = arg_u(c, 0);

	if (target != GL_READ_FRAMEBUFFER)
		st->draw_framebuffer = arg_u(c, 1);
	if (target != GL_DRAW_FRAMEBUFFER)
		st->read_framebuffer = arg_u(c, 1);
}
GLS_HANDLER(glBindFramebufferEXT, STATE) { gls_glBindFramebuffer(x, st, c); }

GLS_HANDLER(glDeleteFramebuffers, STATE)
{
	uint64_t n;
	const struct trace_value *names = arg_items(c, 1, &n);

	for (uint64_t i = 0; i < n; i++) {
		if (st->draw_framebuffer == (uint32_t)gls_value_int(&names[i]))
			st->draw_framebuffer = 0;
		if (st->read_framebuffer == (uint32_t)gls_value_int(&names[i]))
			st->read_framebuffer = 0;
	}
}

/* Several draw buffers belong to framebuffer objects and programs; of the window's there is one. */
GLS_HANDLER(glDrawBuffers, STATE)
{
	uint32_t buffer = GL_NONE;

	if (arg_uints(c, 1, &buffer, 1))
		st->a.color.draw_buffer = buffer;
	if (arg_i(c, 0) > 1 && !st->draw_framebuffer)
		gls_unsupported(x, "more than one colour buffer of the window");
}

GLS_HANDLER(glBindVertexArray, CLIENT)
{
	if (arg_u(c, 0))
		gls_unsupported(x, "vertex array objects: their arrays are taken for the context's");
}
