/* Pixels and texels that the program reads (GL 2.1 sec. 4.3.2, 6.1.4). In its own memory they are its own affair. */
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/state.h"

/* In a buffer object they are data of later calls, which find there what was there before. */
static void into_buffer(struct gls_exec *x, const struct gls_state *st)
{
	if (st->client.pack.buffer)
		gls_unsupported(x, "pixels read into a buffer object");
}

GLS_HANDLER(glReadPixels, NOW) { into_buffer(x, st); }
GLS_HANDLER(glGetTexImage, NOW) { into_buffer(x, st); }
GLS_HANDLER(glGetCompressedTexImage, NOW) { into_buffer(x, st); }
