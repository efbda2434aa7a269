/* Runs inside the traced program. Contexts: which is current, what it can do, whose errors are pending. */
#include <GL/gl.h>
#include <GL/glext.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include "capture/write/content.h"
#include "capture/gl/mirror.h"
#include "capture/gl/wrap.h"

enum { MAX_ERRORS = 8 };

struct context {
	struct context *next;
	void *handle;
	unsigned features;
	int bound; /* has been current before */
	unsigned errors[MAX_ERRORS];
	int n_errors;
	struct content_table *contents;
	struct mirror_table *mirrors;
	struct runs_table *runs;
};

/* Only grows, under the lock; few entries. */
static pthread_mutex_t list_lock = PTHREAD_MUTEX_INITIALIZER;
static struct context *contexts;

static __thread struct context *current __attribute__((tls_model("initial-exec")));

/* Features */

int context_is_current(void)
{
	return current != NULL;
}

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

struct mirror_table **context_mirrors(void)
{
	return &current->mirrors;
}

struct runs_table **context_runs(void)
{
	return current ? &current->runs : NULL;
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
	{ HAS_WINDOW_POS, 14, { "GL_ARB_window_pos" } },
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
	{ HAS_INDIRECT, 40, { "GL_ARB_draw_indirect" } },
	{ HAS_RESTART_NV, 1000, { "GL_NV_primitive_restart" } },
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

	pthread_mutex_lock(&list_lock);
	for (c = contexts; c && c->handle != handle; c = c->next)
		;
	if (!c && (c = calloc(1, sizeof(*c)))) {
		c->handle = handle;
		c->next = contexts;
		contexts = c;
	}
	pthread_mutex_unlock(&list_lock);
	return c;
}

void context_destroyed(void *handle)
{
	pthread_mutex_lock(&list_lock);
	for (struct context *c = contexts; c; c = c->next)
		if (c->handle == handle && handle && c != current) {
			c->handle = NULL; /* the address may come back as another context */
			maps_context_destroyed(&c->contents);
			content_free(&c->contents);
			mirror_free(&c->mirrors);
			runs_free(&c->runs);
		}
	pthread_mutex_unlock(&list_lock);
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

static void record_value(unsigned command, uint8_t *(*put)(uint8_t *, uint32_t), uint32_t value)
{
	uint8_t *p = writer_enter_fake(command);

	if (!p)
		return;
	p = put(put_argument(p, 0), value);
	writer_call_end(p);
}

static uint8_t *put_clear_bits(uint8_t *p, uint32_t v)
{
	return put_bits(p, v, &bits_ClearBufferMask);
}

/*
 * glretrace makes a small window and resizes it at the first viewport, of which Mesa's software rasterizer learns when something
 * is drawn to the front buffer or at the first swap: all of the first frame but a corner would be lost (Mesa 22.3.6). So
 * nothing is drawn there: a clear of no buffers.
 */
void context_make_size_known(void)
{
	uint8_t *p;

	if (!context_has(HAS_DESKTOP) || context_get(GL_DRAW_BUFFER) != GL_BACK)
		return;
	record_value(CMD_glDrawBuffer, put_enum, GL_FRONT);
	record_value(CMD_glClear, put_clear_bits, 0);
	p = writer_enter_fake(CMD_glFlush);
	if (p)
		writer_call_end(p);
	record_value(CMD_glDrawBuffer, put_enum, GL_BACK);
}

/* GL sets viewport and scissor to the drawable when a context is first made current: that is how a reader learns its size. */
static void made_current(void *handle)
{
	int rectangle[4] = { 0, 0, 0, 0 };

	struct context *before = current;

	current = handle ? find_context(handle) : NULL;
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
	context_make_size_known();
	if (current->features & HAS_FIXED_FUNCTION)
		frame_mark_bits();
}

void context_made_current_glx(int ok, void *display, unsigned long drawable, void *context)
{
	if (!ok || !writer_active())
		return;
	frame_drawable_glx(display, drawable);
	made_current(context);
}

void context_made_current_egl(unsigned ok, void *display, void *surface, void *context)
{
	if (!ok || !writer_active())
		return;
	frame_drawable_egl(display, surface);
	made_current(context);
}

void context_made_current_osmesa(unsigned ok, void *context, int width, int height)
{
	if (!ok)
		return;
	resolve_prefer_osmesa();
	if (!writer_active())
		return;
	frame_drawable_osmesa(context, width, height);
	made_current(context);
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
