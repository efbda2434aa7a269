/* Runs inside the traced program. */
#include "capture/gl/current.h"

#include <GL/gl.h>

#include "capture/gl/context.h"
#include "capture/gl/drawable.h"
#include "capture/gl/frame.h"
#include "capture/gl/marker.h"
#include "capture/gl/resolve.h"
#include "capture/write/fake.h"
#include "capture/write/writer.h"
#include "real.h"

static void record_rectangle(unsigned command, unsigned pname)
{
	int r[4] = { 0, 0, 0, 0 };

	real_glGetIntegerv(pname, r);
	fake_call(command, "iiii", r[0], r[1], r[2], r[3]);
}

/* GL sets viewport and scissor to the drawable when a context is first made current: that is how a reader learns its size. */
static void select_context(void *handle)
{
	if (!context_select(handle))
		return;
	record_rectangle(CMD_glViewport, GL_VIEWPORT);
	record_rectangle(CMD_glScissor, GL_SCISSOR_BOX);
	drawable_make_size_known();
	if (context_has(HAS_FIXED_FUNCTION))
		marker_write_bits();
}

void current_made_glx(int ok, void *display, unsigned long drawable, void *context)
{
	if (!ok || !writer_active())
		return;
	frame_drawable_glx(display, drawable);
	select_context(context);
}

void current_made_egl(unsigned ok, void *display, void *surface, void *context)
{
	if (!ok || !writer_active())
		return;
	frame_drawable_egl(display, surface);
	select_context(context);
}

void current_made_osmesa(unsigned ok, void *context, int width, int height)
{
	if (!ok)
		return;
	resolve_prefer_osmesa();
	if (!writer_active())
		return;
	frame_drawable_osmesa(context, width, height);
	select_context(context);
}
