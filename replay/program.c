/*
 * Later objects that a program of the fixed-function age may use beside it: shaders, several draw buffers, vertex array
 * objects. Draws with programs are rendered as fixed function and counted.
 */
#include "replay/exec.h"

GLS_HANDLER(glUseProgram, STATE) { st->program = arg_u(c, 0); }
GLS_HANDLER(glUseProgramObjectARB, STATE) { st->program = arg_u(c, 0); }

/* Several draw buffers belong to framebuffer objects and programs; of the window's there is one. */
GLS_HANDLER(glDrawBuffers, STATE)
{
	uint32_t buffer = GL_NONE;

	if (arg_uints(c, 1, &buffer, 1))
		st->a.color.draw_buffer = buffer;
	if (arg_i(c, 0) > 1)
		gls_unsupported(x, "more than one colour buffer at a time");
}

GLS_HANDLER(glBindVertexArray, CLIENT)
{
	if (arg_u(c, 0))
		gls_unsupported(x, "vertex array objects: their arrays are taken for the context's");
}
