/* Runs inside the traced program. */
#include "capture/gl/current.h"

#include <GL/gl.h>
#include <stddef.h>

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

/* GL sets viewport and scissor to the drawable when a context is first made current. From these a reader learns its
 * size. */
static void made_current(int ok, const struct drawable_target *target, void *context)
{
	if (!ok || !writer_active())
		return;
	frame_draw_to(target);
	if (!context_select(context))
		return;
	record_rectangle(CMD_glViewport, GL_VIEWPORT);
	record_rectangle(CMD_glScissor, GL_SCISSOR_BOX);
	drawable_make_size_known();
	if (context_has(HAS_CONVENTIONAL) || context_has(HAS_DESKTOP))
		marker_write_bits();
	writer_note_context(context_has(HAS_DESKTOP) && !context_has(HAS_FIXED_FUNCTION));
}

void current_made_glx(int ok, void *display, unsigned long drawable, unsigned long read, void *context)
{
	made_current(
		ok,
		&(struct drawable_target){
			.system = DRAWABLE_GLX, .display = display, .id = drawable, .reads_other = read != drawable },
		context);
}

void current_made_egl(unsigned ok, void *display, void *surface, void *read, void *context)
{
	made_current(ok != 0,
	             &(struct drawable_target){ .system = DRAWABLE_EGL,
	                                        .display = display,
	                                        .id = (uintptr_t)surface,
	                                        .reads_other = read != surface },
	             context);
}

void current_made_osmesa(unsigned ok, void *context, int width, int height)
{
	struct drawable_target target = { DRAWABLE_OSMESA, NULL, (uintptr_t)context, 0, width, height };

	if (ok)
		resolve_prefer_osmesa();
	made_current(ok != 0, &target, context);
}
