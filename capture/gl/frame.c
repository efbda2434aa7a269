/* Runs inside the traced program. */
#include "capture/gl/frame.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "capture/gl/context.h"
#include "capture/gl/marker.h"
#include "capture/gl/press.h"
#include "capture/gl/reading.h"
#include "capture/gl/reference.h"
#include "capture/gl/restore.h"
#include "capture/gl/skip.h"
#include "capture/write/clock.h"
#include "capture/write/report.h"
#include "capture/write/writer.h"
#include "real.h"
#include "tables/commands.h"

static _Atomic uint64_t program_frames; /* recorded or not */
static _Atomic int threads;             /* those that draw */
static struct {
	uint64_t max_frames, quit_after, max_bytes; /* 0: no limit */
	uint64_t first, last;                       /* the program's frames to record, from 0 */
	int paused;                                 /* at the start */
	enum frame_trigger trigger;
} wish;

static __thread struct {
	struct drawable_target target;
	int draws;             /* 1: counted among the threads that draw */
	int in_primitive;      /* 1: between Begin and End, where we must not write calls of our own */
	int unswapped;         /* 1: the frame ends without a swap */
	int drawn, primitives; /* since the last frame: anything at all, anything but clears */
	int viewport[2];       /* size of the last one that reached beyond the window */
} self __attribute__((tls_model("initial-exec")));

/* Frames */

/* 1 if the frame that ends may be one to read back: with several threads its number is unknown until it has ended. */
static int may_be_read(void)
{
	return reference_wanted(writer_frames()) || (threads > 1 && reference_wanted(0));
}

static void mark_size(struct drawable *d, int width, int height)
{
	char text[64];

	if (width <= 0 || height <= 0 ||
	    (width == d->marked_width && height == d->marked_height && d->marked_epoch == writer_epoch()))
		return;
	snprintf(text, sizeof(text), "relume:drawable %d %d", width, height);
	marker_write(text);
	d->marked_width = width;
	d->marked_height = height;
	d->marked_epoch = writer_epoch();
	self.viewport[0] = 0; /* a viewport that exceeded it may fit now */
}

/*
 * Mesa's software rasterizer resizes a window's buffers at the first draw after a swap (22.3.6), so a frame that began
 * earlier keeps the old size. Query the driver if the window's size differs from that of the buffers.
 */
static void held_size(struct drawable *d, int *width, int *height)
{
	struct reading_state state = { 0 };

	if (*width <= 0 || *height <= 0 || (*width == d->held_width && *height == d->held_height) || d->id != self.target.id ||
	    self.target.reads_other || !context_current() || (context_has(HAS_FIXED_FUNCTION) && context_get(GL_LIST_INDEX)))
		return;
	context_errors_before();
	reading_begin(&state);
	reading_held(width, height);
	reading_end(&state);
	context_errors_after();
	d->held_width = *width;
	d->held_height = *height;
}

static void frame_end(struct drawable *d, int width, int height)
{
	char text[64];

	if (skip_active())
		return;
	held_size(d, &width, &height);
	mark_size(d, width, height);
	snprintf(text, sizeof(text), "relume:time %llu", (unsigned long long)clock_ns());
	marker_write(text);
	if (d->id == self.target.id && context_current() && may_be_read())
		reference_read(self.target.reads_other ? 0 : width, height, self.unswapped);
	writer_note_window(d->id);
	writer_frame_ends();
}

static void frame_end_of(const struct drawable_target *target)
{
	struct drawable *d = target->id && writer_active() ? drawable_find(target->id) : NULL;
	int saved = errno;

	if (!d)
		return;
	drawable_ask(d, target, may_be_read());
	frame_end(d, d->width, d->height);
	errno = saved;
}

void frame_end_glx(void *display, unsigned long drawable)
{
	frame_end_of(&(struct drawable_target){ .system = DRAWABLE_GLX, .display = display, .id = drawable });
}

void frame_end_egl(void *display, void *surface)
{
	frame_end_of(&(struct drawable_target){ .system = DRAWABLE_EGL, .display = display, .id = (uintptr_t)surface });
}

void frame_draw_to(const struct drawable_target *target)
{
	self.target = *target;
	self.in_primitive = 0;
	threads += !self.draws;
	self.draws = 1;
}

/* A frame ends without a swap: mark it with a fake call. */
static void frame_end_current(void)
{
	const struct drawable_target *t = &self.target;
	struct drawable *d;
	uint8_t *p;

	self.unswapped = 1;
	if ((t->system == DRAWABLE_GLX || t->system == DRAWABLE_EGL) && t->id)
		frame_end_of(t);
	else if ((d = drawable_find(t->id)))
		frame_end(d, t->width, t->height); /* OSMesa's, or none: framebuffer objects are drawn to */
	self.unswapped = 0;
	p = writer_enter_fake(CMD_glFrameTerminatorGREMEDY);
	if (p)
		writer_frame_call_end(p);
	frame_ended();
}

void frame_viewport(int x, int y, int width, int height)
{
	struct drawable *d = self.target.id && writer_active() && !skip_active() ? drawable_find(self.target.id) : NULL;
	int saved = errno;

	drawable_may_have_changed();
	if (!d || !d->width || (width == self.viewport[0] && height == self.viewport[1]) ||
	    ((int64_t)x + width <= d->marked_width && (int64_t)y + height <= d->marked_height))
		return;
	drawable_ask(d, &self.target, 1);
	if (!self.drawn)
		drawable_may_have_changed(); /* let_take_size */
	mark_size(d, d->width, d->height);
	self.viewport[0] = width;
	self.viewport[1] = height;
	errno = saved;
}

/*
 * Mesa's software rasterizer reports the new size of a Wayland window once its buffers have it, with the first draw
 * (22.3.6). So just before the program draws to the window, draw nothing there.
 */
static void let_take_size(const struct drawable_target *t)
{
	if (t->system != DRAWABLE_EGL || !context_current() || (context_has(HAS_FIXED_FUNCTION) && context_get(GL_LIST_INDEX)))
		return;
	if (context_has(HAS_FRAMEBUFFERS) && context_get(GL_FRAMEBUFFER_BINDING))
		return;
	context_errors_before();
	real_glClear(0);
	context_errors_after();
}

/* Before the first draw of a frame: with it a window's buffers get the size that the window has by then (held_size). */
static void frame_begins(void)
{
	const struct drawable_target *t = &self.target;
	struct drawable *d;
	int saved = errno;

	if (self.drawn || !t->id || !writer_active() || skip_active())
		return;
	if (t->system != DRAWABLE_GLX && t->system != DRAWABLE_EGL)
		return;
	d = drawable_find(t->id);
	if (d) {
		let_take_size(t);
		drawable_ask(d, t, may_be_read());
		mark_size(d, d->width, d->height);
	}
	errno = saved;
}

void frame_primitive_begins(void)
{
	frame_begins();
	self.in_primitive = self.drawn = self.primitives = 1;
}

void frame_primitive_ended(void)
{
	self.in_primitive = 0;
}

void frame_drawn(void)
{
	frame_begins();
	self.drawn = self.primitives = 1;
}

void frame_cleared(unsigned buffers)
{
	frame_may_end(FRAME_CLEAR, buffers & GL_COLOR_BUFFER_BIT);
	frame_begins();
	self.drawn = 1;
}

/* Nothing more will be recorded: a program that runs for its recording alone (--quit-after) ends. */
static void quit(void)
{
	static atomic_int quits;

	if (!wish.quit_after || quits++)
		return;
	writer_note_quit();
	kill(getpid(), SIGTERM);
}

void frame_may_end(enum frame_trigger trigger, int truth)
{
	int saved = errno, wanted = trigger == wish.trigger;

	if (trigger == FRAME_FLUSH || trigger == FRAME_FINISH) {
		/* OSMesa has no other call that ends a frame. */
		wanted |= wish.trigger == FRAME_SWAP && self.target.system == DRAWABLE_OSMESA;
		writer_flush_sometimes();
	}
	if (wanted && writer_has_failed())
		quit();
	if (truth && (trigger == FRAME_CLEAR ? self.primitives : self.drawn) && !self.in_primitive &&
	    (wanted || writer_frames() == 0) && context_current() && writer_active()) {
		if (writer_frames() == 0)
			writer_note_end(trigger);
		if (wanted)
			frame_end_current();
	}
	errno = saved;
}

void frame_copied(void)
{
	int saved = errno;

	if (self.drawn && !self.in_primitive && context_current() && writer_active())
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
	press_begin(getenv("RELUME_PRESS"));
	for (unsigned i = 0; trigger && i < N_FRAME_TRIGGERS; i++)
		if (strcmp(trigger, names[i]) == 0)
			wish.trigger = (enum frame_trigger)i;
	if (wish.quit_after)
		writer_will_quit();
	if (!is_wanted(0))
		skip_begin();
}

static void end_recording(void)
{
	writer_end();
	quit();
}

/* A frame is in the trace: end the recording or the program if it was the last one wanted. */
static void frame_recorded(uint64_t frames)
{
	if ((wish.max_frames && frames >= wish.max_frames) || (wish.quit_after && frames >= wish.quit_after)) {
		end_recording();
	} else if (wish.max_bytes && writer_bytes() >= wish.max_bytes) {
		report_say("the trace has reached its maximum size after %llu frame%s; recording ends, the program %s",
		           (unsigned long long)frames, frames == 1 ? "" : "s",
		           wish.quit_after ? "ends as well (--quit-after)" : "keeps running");
		end_recording();
	}
}

static void end_frame(void)
{
	uint64_t frames, next;
	const struct drawable_target *t = &self.target;
	struct drawable *d;

	next = ++program_frames;
	writer_note_end(FRAME_SWAP);
	frames = writer_frame_ended();
	reference_write(frames);
	if (frames)
		frame_recorded(frames);
	if (next > wish.last)
		end_recording();
	d = t->id ? drawable_find(t->id) : NULL;
	if (d)
		press_before(next, d->window);
	if (is_wanted(next) == !skip_active() || !writer_active())
		return;
	if (skip_active()) {
		d = t->system != DRAWABLE_OSMESA && t->id ? drawable_find(t->id) : NULL;
		skip_end();
		restore_drawn(d ? d->width : t->width, d ? d->height : t->height);
	} else {
		skip_begin();
	}
}

void frame_ended(void)
{
	self.drawn = self.primitives = self.in_primitive = 0;
	if (writer_active())
		end_frame();
	if (writer_has_failed())
		quit();
}
