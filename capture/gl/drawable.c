/* Runs inside the traced program. */
#include "capture/gl/drawable.h"

#include <GL/gl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>

#include "capture/gl/context.h"
#include "capture/gl/resolve.h"
#include "capture/write/clock.h"
#include "capture/write/fake.h"
#include "capture/write/writer.h"
#include "real.h"

enum { GLX_WIDTH_ = 0x801D, GLX_HEIGHT_ = 0x801E, EGL_HEIGHT_ = 0x3056, EGL_WIDTH_ = 0x3057 };
enum { ASK_SIZE_AFTER_NS = 100000000 };

/* Only grows, under the lock; few entries. */
static pthread_mutex_t list_lock = PTHREAD_MUTEX_INITIALIZER;
static struct drawable *drawables;

static _Atomic int size_may_differ = 1;

struct drawable *drawable_find(uintptr_t id)
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
	struct drawable *d = glx_window ? drawable_find(glx_window) : NULL;

	if (d)
		d->window = window;
}

void drawable_is_pbuffer(void *display, unsigned long pbuffer)
{
	struct drawable *d = pbuffer ? drawable_find(pbuffer) : NULL;
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
 * Query the size of an X window through XCB: if a drawable is gone, Xlib would call the program's error handler, which
 * ends the program. Mesa's GLX has loaded both libraries.
 */
struct geometry_reply { /* the X protocol's GetGeometry reply */
	uint8_t response_type, depth;
	uint16_t sequence;
	uint32_t length, root;
	int16_t x, y;
	uint16_t width, height, border_width;
};

struct geometry_cookie { /* a struct, as in XCB: i386 returns structs and numbers in different ways */
	unsigned sequence;
};

static struct {
	void *(*get_connection)(void *);
	struct geometry_cookie (*get_geometry)(void *, uint32_t);
	struct geometry_reply *(*get_reply)(void *, struct geometry_cookie, void **);
} xcb;
static pthread_once_t xcb_once = PTHREAD_ONCE_INIT;

static void find_xcb(void)
{
	void *x11 = dlopen("libX11-xcb.so.1", RTLD_LAZY | RTLD_LOCAL), *lib = dlopen("libxcb.so.1", RTLD_LAZY | RTLD_LOCAL);

	if (!x11 || !lib)
		return;
	xcb.get_connection = (void *(*)(void *))resolve_in(x11, "XGetXCBConnection");
	xcb.get_geometry = (struct geometry_cookie (*)(void *, uint32_t))resolve_in(lib, "xcb_get_geometry");
	xcb.get_reply = (struct geometry_reply * (*)(void *, struct geometry_cookie, void **))
		resolve_in(lib, "xcb_get_geometry_reply");
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

void drawable_ask(struct drawable *d, const struct drawable_target *target, int exact)
{
	uint64_t now = clock_ns();

	if (target->system == DRAWABLE_GLX && (!target->display || !d->window))
		return;
	if (!size_may_differ && d->width && !exact && now - d->asked_ns <= ASK_SIZE_AFTER_NS)
		return;
	size_may_differ = 0;
	d->asked_ns = now;
	writer_nest();
	if (target->system == DRAWABLE_GLX) {
		ask_window_size(target->display, d);
	} else {
		real_eglQuerySurface(target->display, (void *)d->id, EGL_WIDTH_, &d->width);
		real_eglQuerySurface(target->display, (void *)d->id, EGL_HEIGHT_, &d->height);
	}
	writer_unnest();
}

/*
 * glretrace makes a small window and resizes it at the first viewport. Mesa's software rasterizer notices the new size
 * when something is drawn to the front buffer, or at the first swap: all of the first frame but a corner would be lost
 * (Mesa 22.3.6). So draw there, but change nothing: clear no buffers.
 */
void drawable_make_size_known(void)
{
	if (!context_has(HAS_DESKTOP) || context_get(GL_DRAW_BUFFER) != GL_BACK)
		return;
	fake_call(CMD_glDrawBuffer, "e", GL_FRONT);
	fake_call(CMD_glClear, "c", 0);
	fake_call(CMD_glFlush, "");
	fake_call(CMD_glDrawBuffer, "e", GL_BACK);
}
