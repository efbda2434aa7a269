/* Runs inside the traced program. Drawables, the ends of frames, and what is marked there. */
#include <GL/gl.h>
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "capture/relume.h"
#include "capture/gl/wrap.h"

enum { GLX_WIDTH_ = 0x801D, GLX_HEIGHT_ = 0x801E, EGL_HEIGHT_ = 0x3056, EGL_WIDTH_ = 0x3057 };
enum { ASK_SIZE_AFTER_NS = 100000000 };

enum system { SYSTEM_NONE, SYSTEM_GLX, SYSTEM_EGL, SYSTEM_OSMESA };

struct drawable {
	struct drawable *next;
	uintptr_t id;
	unsigned long window; /* X window or pixmap to ask the size of; 0: the size cannot change */
	int width, height;
	uint64_t asked_ns;
};

/* Only grows, under the lock; few entries. */
static pthread_mutex_t list_lock = PTHREAD_MUTEX_INITIALIZER;
static struct drawable *drawables;

static _Atomic uint64_t program_frames; /* recorded or not */
static _Atomic int size_may_differ = 1;
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

static uint64_t now_ns(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

/* Drawables */

static struct drawable *find_drawable(uintptr_t id)
{
	struct drawable *d;

	pthread_mutex_lock(&list_lock);
	for (d = drawables; d && d->id != id; d = d->next)
		;
	if (!d && (d = calloc(1, sizeof(*d)))) {
		d->id = id;
		d->window = id;
		d->next = drawables;
		drawables = d;
	}
	pthread_mutex_unlock(&list_lock);
	return d;
}

void drawable_is_window(unsigned long glx_window, unsigned long window)
{
	struct drawable *d = glx_window ? find_drawable(glx_window) : NULL;

	if (d)
		d->window = window;
}

void drawable_is_pbuffer(void *display, unsigned long pbuffer)
{
	struct drawable *d = pbuffer ? find_drawable(pbuffer) : NULL;
	unsigned width = 0, height = 0;

	if (!d)
		return;
	writer_nest();
	real_glXQueryDrawable(display, pbuffer, GLX_WIDTH_, &width);
	real_glXQueryDrawable(display, pbuffer, GLX_HEIGHT_, &height);
	writer_unnest();
	d->window = 0;
	d->width = (int)width;
	d->height = (int)height;
}

void drawable_may_have_changed(void)
{
	size_may_differ = 1;
}

/*
 * The size of an X window. By XCB and not by Xlib, where asking for a drawable that is gone calls the program's error
 * handler, which ends the program. Both libraries are the ones that Mesa's GLX has loaded.
 */
struct geometry_reply { /* the X protocol's GetGeometry reply */
	uint8_t response_type, depth;
	uint16_t sequence;
	uint32_t length, root;
	int16_t x, y;
	uint16_t width, height, border_width;
};

static struct {
	void *(*get_connection)(void *);
	unsigned (*get_geometry)(void *, uint32_t);
	struct geometry_reply *(*get_reply)(void *, unsigned, void **);
} xcb;
static pthread_once_t xcb_once = PTHREAD_ONCE_INIT;

static void find_xcb(void)
{
	void *x11 = dlopen("libX11-xcb.so.1", RTLD_LAZY | RTLD_LOCAL), *lib = dlopen("libxcb.so.1", RTLD_LAZY | RTLD_LOCAL);

	if (!x11 || !lib)
		return;
	xcb.get_connection = (void *(*)(void *))dlsym(x11, "XGetXCBConnection");
	xcb.get_geometry = (unsigned (*)(void *, uint32_t))dlsym(lib, "xcb_get_geometry");
	xcb.get_reply = (struct geometry_reply * (*)(void *, unsigned, void **)) dlsym(lib, "xcb_get_geometry_reply");
}

static void ask_window_size(void *display, struct drawable *d)
{
	struct geometry_reply *reply;
	void *connection, *error = NULL;

	pthread_once(&xcb_once, find_xcb);
	if (!xcb.get_connection || !xcb.get_geometry || !xcb.get_reply)
		return;
	connection = xcb.get_connection(display);
	reply = xcb.get_reply(connection, xcb.get_geometry(connection, (uint32_t)d->window), &error);
	if (reply) {
		d->width = reply->width;
		d->height = reply->height;
	}
	free(reply);
	free(error);
}

/* Frames */

static void record_marker(const char *text)
{
	size_t n = strlen(text);
	uint8_t *p = writer_enter_fake(CMD_glStringMarkerGREMEDY);

	if (!p)
		return;
	p = put_sint(put_argument(p, 0), (int64_t)n);
	p = put_string(put_argument(p, 1), text, (long)n);
	writer_call_end(p);
}

/* relume.h: found by name in the process, at run time. */

SHOWN void relume_material(int kind, float amount, float ior);
SHOWN void relume_build_kd_tree(void);

/* A number of at least 0 to six places, with a point whatever the program's locale says. */
static int print_number(char *out, size_t size, float value)
{
	long millionths = value > 0 && value < 1e6f ? (long)((double)value * 1e6 + 0.5) : 0;

	return snprintf(out, size, " %ld.%06ld", millionths / 1000000, millionths % 1000000);
}

void relume_material(int kind, float amount, float ior)
{
	static const char *const names[] = { "matte", "mirror", "glass" };
	char text[96];
	int n;

	if (kind < RT_MATTE_EXT || kind > RT_GLASS_EXT)
		return;
	n = snprintf(text, sizeof(text), "relume:material %s", names[kind]);
	if (kind != RT_MATTE_EXT)
		n += print_number(text + n, sizeof(text) - (size_t)n, amount);
	if (kind == RT_GLASS_EXT)
		print_number(text + n, sizeof(text) - (size_t)n, ior);
	record_marker(text);
}

void relume_build_kd_tree(void)
{
	record_marker("relume:kdtree");
}

void frame_mark_bits(void)
{
	char text[64];

	context_errors_before();
	snprintf(text, sizeof(text), "relume:bits %d %d %d %d %d %d", context_get(GL_ALPHA_BITS), context_get(GL_DEPTH_BITS),
	         context_get(GL_STENCIL_BITS), context_get(GL_FRAMEBUFFER_SRGB_CAPABLE_EXT), context_get(GL_SAMPLES),
	         context_get(GL_DOUBLEBUFFER) != 0);
	context_errors_after();
	record_marker(text);
}

static void frame_end(uintptr_t drawable, int width, int height)
{
	char text[64];

	if (skip_active())
		return;
	if ((width != marked_width || height != marked_height || writer_frames() == 0) && width > 0 && height > 0) {
		snprintf(text, sizeof(text), "relume:drawable %d %d", width, height);
		record_marker(text);
		marked_width = width;
		marked_height = height;
	}
	snprintf(text, sizeof(text), "relume:time %llu", (unsigned long long)now_ns());
	record_marker(text);
	if (drawable == self.drawable && context_is_current() && reference_wanted(writer_frames()))
		reference_read(writer_frames(), width, height, self.unswapped);
	writer_frame_ends();
}

/* Asking costs a trip to the X server: not at each frame, but when the program set a viewport, or after a while. */
static int size_is_old(const struct drawable *d)
{
	return size_may_differ || !d->width || reference_wanted(writer_frames()) || now_ns() - d->asked_ns > ASK_SIZE_AFTER_NS;
}

void frame_end_glx(void *display, unsigned long drawable)
{
	struct drawable *d = drawable && writer_active() ? find_drawable(drawable) : NULL;
	int saved = errno;

	if (!d)
		return;
	if (display && d->window && size_is_old(d)) {
		size_may_differ = 0;
		d->asked_ns = now_ns();
		writer_nest();
		ask_window_size(display, d);
		writer_unnest();
	}
	frame_end(drawable, d->width, d->height);
	errno = saved;
}

void frame_end_egl(void *display, void *surface)
{
	struct drawable *d = surface && writer_active() ? find_drawable((uintptr_t)surface) : NULL;
	int saved = errno;

	if (!d)
		return;
	if (size_is_old(d)) {
		size_may_differ = 0;
		d->asked_ns = now_ns();
		writer_nest();
		real_eglQuerySurface(display, surface, EGL_WIDTH_, &d->width);
		real_eglQuerySurface(display, surface, EGL_HEIGHT_, &d->height);
		writer_unnest();
	}
	frame_end((uintptr_t)surface, d->width, d->height);
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

/* The end of a frame of which only a made-up call tells. */
static void frame_end_current(void)
{
	uint8_t *p;

	self.unswapped = 1;
	if (self.system == SYSTEM_GLX && self.drawable)
		frame_end_glx(self.display, self.drawable);
	else if (self.system == SYSTEM_EGL && self.drawable)
		frame_end_egl(self.display, (void *)self.drawable);
	else
		frame_end(self.drawable, self.width, self.height); /* OSMesa's, or none: framebuffer objects are drawn to */
	self.unswapped = 0;
	p = writer_enter_fake(CMD_glFrameTerminatorGREMEDY);
	if (p)
		writer_call_end(p);
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
	    context_is_current() && writer_active())
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
	return frame >= wish.first && (wish.paused ^ (writer_toggles() & 1)) == 0;
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
		writer_say("the trace has reached its largest size after %llu frames; recording ends, the program goes on",
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
	struct drawable *d = self.system != SYSTEM_OSMESA && self.drawable ? find_drawable(self.drawable) : NULL;

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
		skip_end(width, height);
	} else {
		skip_begin();
	}
}
