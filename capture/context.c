/* Runs inside the traced program. Contexts, drawables and frames. */
#include <GL/gl.h>
#include <GL/glext.h>
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "capture/content.h"
#include "capture/relume.h"
#include "capture/wrap.h"

enum { GLX_WIDTH_ = 0x801D, GLX_HEIGHT_ = 0x801E, EGL_HEIGHT_ = 0x3056, EGL_WIDTH_ = 0x3057 };
enum { MAX_ERRORS = 8, ASK_SIZE_AFTER_NS = 100000000 };

struct context {
	struct context *next;
	void *handle;
	unsigned features;
	int bound; /* has been current before */
	unsigned errors[MAX_ERRORS];
	int n_errors;
	struct content_table *contents;
};

struct drawable {
	struct drawable *next;
	uintptr_t id;
	unsigned long window; /* X window or pixmap to ask the size of; 0: the size cannot change */
	int width, height;
	uint64_t asked_ns;
};

/* Both lists only grow, under the lock; few entries. */
static pthread_mutex_t lists_lock = PTHREAD_MUTEX_INITIALIZER;
static struct context *contexts;
static struct drawable *drawables;

static _Atomic int size_may_differ = 1;
static _Atomic int marked_width, marked_height; /* of the last size marker */
static uint64_t max_frames, quit_after;         /* 0: no such wish */

static __thread struct context *current __attribute__((tls_model("initial-exec")));
static __thread uintptr_t current_drawable __attribute__((tls_model("initial-exec")));

static uint64_t now_ns(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

/* Features */

int context_has(enum context_feature feature)
{
	return current && (current->features & feature);
}

int context_get(unsigned pname)
{
	int value = 0;

	if (current)
		real_glGetIntegerv(pname, &value);
	return value;
}

struct content_table **context_contents(void)
{
	return &current->contents;
}

/* 1 where `list` holds `name` as a whole word. */
static int has_word(const char *list, const char *name)
{
	size_t n = strlen(name);

	for (const char *at = list; at && (at = strstr(at, name)); at += n)
		if ((at == list || at[-1] == ' ') && (at[n] == ' ' || at[n] == '\0'))
			return 1;
	return 0;
}

static const struct {
	unsigned feature;
	int version;            /* 10 * major + minor from which on it is part of GL */
	const char *extensions[3];
} feature_table[] = {
	{ HAS_3D, 12, { "GL_EXT_texture3D" } },
	{ HAS_MULTITEXTURE, 13, { "GL_ARB_multitexture" } },
	{ HAS_FOG_COORD, 14, { "GL_EXT_fog_coord" } },
	{ HAS_SECONDARY_COLOR, 14, { "GL_EXT_secondary_color" } },
	{ HAS_BUFFERS, 15, { "GL_ARB_vertex_buffer_object" } },
	{ HAS_ATTRIBUTES, 20, { "GL_ARB_vertex_program", "GL_ARB_vertex_shader" } },
	{ HAS_PIXEL_BUFFERS, 21, { "GL_ARB_pixel_buffer_object", "GL_EXT_pixel_buffer_object" } },
	{ HAS_FRAMEBUFFERS, 30, { "GL_ARB_framebuffer_object", "GL_EXT_framebuffer_object" } },
	{ HAS_READ_FRAMEBUFFER, 30, { "GL_ARB_framebuffer_object", "GL_EXT_framebuffer_blit" } },
	{ HAS_MAP_RANGE, 30, { "GL_ARB_map_buffer_range" } },
	{ HAS_VERTEX_ARRAYS, 30, { "GL_ARB_vertex_array_object" } },
	{ HAS_INTEGER_ATTRIBUTES, 30, { "GL_EXT_gpu_shader4" } },
	{ HAS_RESTART, 31, { NULL } },
	{ HAS_DIVISOR, 33, { "GL_ARB_instanced_arrays" } },
	{ HAS_FIXED_RESTART, 43, { "GL_ARB_ES3_compatibility" } },
	{ HAS_PACK_INVERT, 1000, { "GL_MESA_pack_invert" } },
};

static unsigned find_features(void)
{
	const char *text = (const char *)real_glGetString(GL_VERSION), *extensions = NULL;
	unsigned features = HAS_DESKTOP;
	int major = 0, minor = 0, version, profile = 0;

	if (!text)
		return 0;
	if (strncmp(text, "OpenGL ES", 9) == 0) /* no fixed-function queries; what ES 2 and GL 2.0 share */
		return HAS_BUFFERS | HAS_ATTRIBUTES | HAS_FRAMEBUFFERS;
	if (sscanf(text, "%d.%d", &major, &minor) != 2)
		return 0;
	version = 10 * major + minor;
	if (version >= 32)
		real_glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
	if (!(profile & GL_CONTEXT_CORE_PROFILE_BIT)) {
		features |= HAS_FIXED_FUNCTION;
		extensions = (const char *)real_glGetString(GL_EXTENSIONS); /* an error in a core profile */
	}
	for (size_t i = 0; i < sizeof(feature_table) / sizeof(feature_table[0]); i++) {
		if (version >= feature_table[i].version)
			features |= feature_table[i].feature;
		for (int j = 0; j < 3 && feature_table[i].extensions[j]; j++)
			if (has_word(extensions, feature_table[i].extensions[j]))
				features |= feature_table[i].feature;
	}
	return features;
}

/* Contexts */

static struct context *find_context(void *handle)
{
	struct context *c;

	pthread_mutex_lock(&lists_lock);
	for (c = contexts; c && c->handle != handle; c = c->next)
		;
	if (!c && (c = calloc(1, sizeof(*c)))) {
		c->handle = handle;
		c->next = contexts;
		contexts = c;
	}
	pthread_mutex_unlock(&lists_lock);
	return c;
}

void context_destroyed(void *handle)
{
	pthread_mutex_lock(&lists_lock);
	for (struct context *c = contexts; c; c = c->next)
		if (c->handle == handle && handle && c != current) {
			c->handle = NULL; /* the address may come back as another context */
			content_free(&c->contents);
		}
	pthread_mutex_unlock(&lists_lock);
}

static void record_rectangle(unsigned command, const int rectangle[4])
{
	uint8_t *p = writer_enter_fake(command);

	if (!p)
		return;
	for (unsigned i = 0; i < 4; i++)
		p = put_sint(put_argument(p, i), rectangle[i]);
	writer_call_end(p);
}

/* GL sets viewport and scissor to the drawable when a context is first made current: that is how a reader learns its size. */
static void made_current(void *handle, uintptr_t drawable)
{
	int rectangle[4] = { 0, 0, 0, 0 };

	struct context *before = current;

	current = handle ? find_context(handle) : NULL;
	current_drawable = drawable;
	if (current != before)
		arrays_forget();
	if (!current || current->bound)
		return;
	current->bound = 1;
	current->features = find_features();
	real_glGetIntegerv(GL_VIEWPORT, rectangle);
	record_rectangle(CMD_glViewport, rectangle);
	real_glGetIntegerv(GL_SCISSOR_BOX, rectangle);
	record_rectangle(CMD_glScissor, rectangle);
}

void context_made_current_glx(int ok, void *display, unsigned long drawable, void *context)
{
	(void)display;
	if (ok && writer_active())
		made_current(context, drawable);
}

void context_made_current_egl(unsigned ok, void *display, void *surface, void *context)
{
	(void)display;
	if (ok && writer_active())
		made_current(context, (uintptr_t)surface);
}

void context_made_current_osmesa(unsigned ok, void *context, int width, int height)
{
	(void)width;
	(void)height;
	if (!ok)
		return;
	resolve_prefer_osmesa();
	if (writer_active())
		made_current(context, 0);
}

/* Errors */

unsigned context_pending_error(unsigned error)
{
	unsigned first;

	if (!current || !current->n_errors)
		return error;
	if (error && current->n_errors < MAX_ERRORS)
		current->errors[current->n_errors++] = error;
	first = current->errors[0];
	current->n_errors--;
	memmove(current->errors, current->errors + 1, sizeof(current->errors[0]) * (size_t)current->n_errors);
	return first;
}

void context_errors_before(void)
{
	unsigned error;

	for (int i = 0; i < MAX_ERRORS && (error = real_glGetError()); i++)
		if (current && current->n_errors < MAX_ERRORS)
			current->errors[current->n_errors++] = error;
}

void context_errors_after(void)
{
	for (int i = 0; i < MAX_ERRORS && real_glGetError(); i++)
		;
}

/* Drawables */

static struct drawable *find_drawable(uintptr_t id)
{
	struct drawable *d;

	pthread_mutex_lock(&lists_lock);
	for (d = drawables; d && d->id != id; d = d->next)
		;
	if (!d && (d = calloc(1, sizeof(*d)))) {
		d->id = id;
		d->window = id;
		d->next = drawables;
		drawables = d;
	}
	pthread_mutex_unlock(&lists_lock);
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

static void frame_end(uintptr_t drawable, int width, int height)
{
	char text[64];

	if ((width != marked_width || height != marked_height || writer_frames() == 0) && width > 0 && height > 0) {
		snprintf(text, sizeof(text), "relume:drawable %d %d", width, height);
		record_marker(text);
		marked_width = width;
		marked_height = height;
	}
	snprintf(text, sizeof(text), "relume:time %llu", (unsigned long long)now_ns());
	record_marker(text);
	if (current && drawable == current_drawable && reference_wanted(writer_frames()))
		reference_read(writer_frames(), width, height);
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

static uint64_t frames_from(const char *name)
{
	const char *text = getenv(name);

	return text ? strtoull(text, NULL, 10) : 0;
}

__attribute__((constructor)) static void read_wishes(void)
{
	max_frames = frames_from("RELUME_MAX_FRAMES");
	quit_after = frames_from("RELUME_QUIT_AFTER");
}

void frame_ended(void)
{
	uint64_t frames = writer_active() ? writer_frame_ended() : 0;

	if (!frames)
		return;
	if ((max_frames && frames >= max_frames) || (quit_after && frames >= quit_after))
		writer_end();
	if (quit_after && frames >= quit_after) {
		writer_note_quit();
		kill(getpid(), SIGTERM);
	}
}

void frame_may_have_ended(void)
{
	writer_flush_sometimes();
}
