/* Runs inside the traced program. */
#include "capture/gl/frame.h"

#include <GL/gl.h>
#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "capture/gl/context.h"
#include "capture/gl/drawable.h"
#include "capture/gl/marker.h"
#include "capture/gl/reference.h"
#include "capture/gl/restore.h"
#include "capture/gl/skip.h"
#include "capture/write/clock.h"
#include "capture/write/fake.h"
#include "capture/write/report.h"
#include "capture/write/writer.h"
#include "tables/commands.h"

enum system { SYSTEM_NONE, SYSTEM_GLX, SYSTEM_EGL, SYSTEM_OSMESA };

static _Atomic uint64_t program_frames; /* recorded or not */
static _Atomic int marked_width, marked_height; /* of the last size marker */
static struct {
	uint64_t max_frames, quit_after, max_bytes; /* 0: no such wish */
	uint64_t first, last;                       /* of the program's frames, from 0 */
	int paused;                                 /* to begin with */
	enum frame_trigger trigger;
} wish;

static __thread struct {
	enum system system;
	void *display;
	uintptr_t drawable;
	int width, height;     /* OSMesa's, which has no drawables */
	int in_primitive;      /* between Begin and End: no call of ours may come there */
	int unswapped;         /* the frame that ends does so without a swap */
	int drawn, primitives; /* since the last frame: anything at all, anything but clears */
} self __attribute__((tls_model("initial-exec")));

/* Frames */

static void frame_end(uintptr_t drawable, int width, int height)
{
	char text[64];

	if (skip_active())
		return;
	if ((width != marked_width || height != marked_height || writer_frames() == 0) && width > 0 && height > 0) {
		snprintf(text, sizeof(text), "relume:drawable %d %d", width, height);
		marker_write(text);
		marked_width = width;
		marked_height = height;
	}
	snprintf(text, sizeof(text), "relume:time %llu", (unsigned long long)clock_ns());
	marker_write(text);
	if (drawable == self.drawable && context_current() && reference_wanted(writer_frames()))
		reference_read(writer_frames(), width, height, self.unswapped);
	writer_frame_ends();
}

void frame_end_glx(void *display, unsigned long drawable)
{
	struct drawable *d = drawable && writer_active() ? drawable_find(drawable) : NULL;
	int saved = errno;

	if (!d)
		return;
	drawable_ask_glx(d, display, reference_wanted(writer_frames()));
	frame_end(drawable, d->width, d->height);
	errno = saved;
}

void frame_end_egl(void *display, void *surface)
{
	struct drawable *d = surface && writer_active() ? drawable_find((uintptr_t)surface) : NULL;
	int saved = errno;

	if (!d)
		return;
	drawable_ask_egl(d, display, reference_wanted(writer_frames()));
	frame_end(d->id, d->width, d->height);
	errno = saved;
}

/* What is current */

static void set_current(enum system system, void *display, uintptr_t drawable)
{
	self.system = system;
	self.display = display;
	self.drawable = drawable;
	self.width = self.height = 0;
	self.in_primitive = 0;
}

void frame_drawable_glx(void *display, unsigned long drawable)
{
	set_current(SYSTEM_GLX, display, drawable);
}

void frame_drawable_egl(void *display, void *surface)
{
	set_current(SYSTEM_EGL, display, (uintptr_t)surface);
}

void frame_drawable_osmesa(void *context, int width, int height)
{
	set_current(SYSTEM_OSMESA, NULL, (uintptr_t)context);
	self.width = width;
	self.height = height;
}

/* A frame ends, and only a made-up call tells. */
static void frame_end_current(void)
{
	self.unswapped = 1;
	if (self.system == SYSTEM_GLX && self.drawable)
		frame_end_glx(self.display, self.drawable);
	else if (self.system == SYSTEM_EGL && self.drawable)
		frame_end_egl(self.display, (void *)self.drawable);
	else
		frame_end(self.drawable, self.width, self.height); /* OSMesa's, or none: framebuffer objects are drawn to */
	self.unswapped = 0;
	fake_call(CMD_glFrameTerminatorGREMEDY, "");
	frame_ended();
}

void frame_primitive_begins(void)
{
	self.in_primitive = self.drawn = self.primitives = 1;
}

void frame_primitive_ended(void)
{
	self.in_primitive = 0;
}

void frame_drawn(void)
{
	self.drawn = self.primitives = 1;
}

void frame_cleared(unsigned buffers)
{
	frame_may_end(FRAME_CLEAR, buffers & GL_COLOR_BUFFER_BIT);
	self.drawn = 1;
}

void frame_may_end(enum frame_trigger trigger, int truth)
{
	int saved = errno, wanted = trigger == wish.trigger;

	if (trigger == FRAME_FLUSH || trigger == FRAME_FINISH) {
		/* OSMesa has no call that ends a frame but these. */
		wanted |= wish.trigger == FRAME_SWAP && self.system == SYSTEM_OSMESA;
		writer_flush_sometimes();
	}
	if (wanted && truth && (trigger == FRAME_CLEAR ? self.primitives : self.drawn) && !self.in_primitive &&
	    context_current() && writer_active())
		frame_end_current();
	errno = saved;
}

/* Wishes */

static uint64_t number_from(const char *name)
{
	const char *text = getenv(name);

	return text ? strtoull(text, NULL, 10) : 0;
}

static int is_wanted(uint64_t frame)
{
	return frame >= wish.first && (wish.paused ^ (report_toggles() & 1)) == 0;
}

__attribute__((constructor)) static void read_wishes(void)
{
	static const char *const names[] = FRAME_TRIGGER_NAMES;
	const char *trigger = getenv("RELUME_FRAME_END");

	wish.max_frames = number_from("RELUME_MAX_FRAMES");
	wish.quit_after = number_from("RELUME_QUIT_AFTER");
	wish.max_bytes = number_from("RELUME_MAX_SIZE");
	wish.first = number_from("RELUME_FIRST_FRAME");
	wish.last = getenv("RELUME_LAST_FRAME") ? number_from("RELUME_LAST_FRAME") : UINT64_MAX;
	wish.paused = getenv("RELUME_PAUSED") != NULL;
	for (unsigned i = 0; trigger && i < N_FRAME_TRIGGERS; i++)
		if (strcmp(trigger, names[i]) == 0)
			wish.trigger = (enum frame_trigger)i;
	if (!is_wanted(0))
		skip_begin();
}

/* What follows from a frame that is in the trace. */
static void frame_recorded(uint64_t frames)
{
	if ((wish.max_frames && frames >= wish.max_frames) || (wish.quit_after && frames >= wish.quit_after))
		writer_end();
	if (wish.max_bytes && writer_bytes() >= wish.max_bytes) {
		writer_end();
		report_say("the trace has reached its largest size after %llu frames; recording ends, the program goes on",
		           (unsigned long long)frames);
	}
	if (wish.quit_after && frames >= wish.quit_after) {
		writer_note_quit();
		kill(getpid(), SIGTERM);
	}
}

/* The size of what is current, asked when it was last swapped, or none. */
static void current_size(int *width, int *height)
{
	struct drawable *d = self.system != SYSTEM_OSMESA && self.drawable ? drawable_find(self.drawable) : NULL;

	*width = d ? d->width : self.system == SYSTEM_OSMESA ? self.width : 0;
	*height = d ? d->height : self.system == SYSTEM_OSMESA ? self.height : 0;
}

void frame_ended(void)
{
	uint64_t frames, next;
	int width, height;

	self.drawn = self.primitives = self.in_primitive = 0;
	if (!writer_active())
		return;
	next = ++program_frames;
	frames = skip_active() ? 0 : writer_frame_ended();
	if (frames)
		frame_recorded(frames);
	if (next > wish.last)
		writer_end();
	if (is_wanted(next) == !skip_active() || !writer_active())
		return;
	if (skip_active()) {
		current_size(&width, &height);
		skip_end();
		restore_drawn(width, height);
	} else {
		skip_begin();
	}
}
