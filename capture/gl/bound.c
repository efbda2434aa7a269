/* Runs inside the traced program. */
#include "capture/gl/bound.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <errno.h>
#include <stdatomic.h>
#include <sys/mman.h>

#include "capture/gl/context.h"
#include "capture/gl/reading.h"
#include "capture/gl/restore.h"
#include "capture/write/fake.h"
#include "capture/write/pages.h"
#include "capture/write/report.h"
#include "capture/write/writer.h"
#include "real.h"

enum { GLX_TEXTURE_TARGET_ = 0x20D6, GLX_TEXTURE_RECTANGLE_ = 0x20DD }; /* after GL/glxext.h */

static void say_unknown(void)
{
	static atomic_int said;

	if (!said++)
		report_say("a pixmap's picture, bound to a texture, could not be read: the recording has none of it");
}

static void write_image(unsigned target, int width, int height)
{
	const int format = context_get_level(target, 0, GL_TEXTURE_INTERNAL_FORMAT);
	const long bytes = (long)width * height * 4;
	struct reading_state state = { 0 };
	void *pixels = pages_map((size_t)bytes);

	if (!pixels) {
		say_unknown();
		return;
	}
	restore_make_neutral(0);
	reading_begin(&state);
	real_glGetTexImage(target, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
	fake_call(CMD_glTexImage2D, "eiiiiieeb", target, 0, format, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels,
	          bytes);
	reading_end(&state);
	restore_make_neutral(1);
	munmap(pixels, (size_t)bytes);
}

static void bound_to(unsigned target)
{
	int saved = errno, width, height;

	if (!writer_active())
		return;
	if (!context_current() || !context_has(HAS_DESKTOP) ||
	    (context_has(HAS_FIXED_FUNCTION) && context_get(GL_LIST_INDEX))) {
		say_unknown();
		return;
	}
	context_errors_before();
	width = context_get_level(target, 0, GL_TEXTURE_WIDTH);
	height = context_get_level(target, 0, GL_TEXTURE_HEIGHT);
	if (width > 0 && height > 0)
		write_image(target, width, height);
	else
		say_unknown();
	context_errors_after();
	errno = saved;
}

void bound_glx(void *display, unsigned long drawable)
{
	unsigned target = 0;

	writer_nest();
	real_glXQueryDrawable(display, drawable, GLX_TEXTURE_TARGET_, &target);
	writer_unnest();
	bound_to(target == GLX_TEXTURE_RECTANGLE_ ? GL_TEXTURE_RECTANGLE : GL_TEXTURE_2D);
}

void bound_egl(unsigned result)
{
	if (result)
		bound_to(GL_TEXTURE_2D);
}
