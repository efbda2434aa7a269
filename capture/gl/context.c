/* Runs inside the traced program. */
#include "capture/gl/context.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "real.h"

enum { MAX_ERRORS = 8 };

struct context {
	struct context *next;
	void *handle;
	unsigned features;
	int bound; /* has been current before */
	unsigned errors[MAX_ERRORS];
	int n_errors;
	struct slot {
		void *data;
		void (*release)(void *data);
	} slots[N_CONTEXT_SLOTS];
};

/* Only grows, under the lock; few entries. */
static pthread_mutex_t list_lock = PTHREAD_MUTEX_INITIALIZER;
static struct context *contexts;

static __thread struct context *current __attribute__((tls_model("initial-exec")));
static __thread unsigned turn __attribute__((tls_model("initial-exec")));

/* Features and state */

const void *context_current(void)
{
	return current;
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

int context_get_level(unsigned target, int level, unsigned pname)
{
	int value = 0;

	real_glGetTexLevelParameteriv(target, level, pname, &value);
	return value;
}

/* 1 if `list` contains `name` as a whole word. */
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
	int version;            /* 10 * major + minor of the first GL that has it */
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

/* "OpenGL ES-CM 1.1", the common profile, or -CL, that without floats. */
static unsigned find_es1_features(const char *version)
{
	const char *extensions = (const char *)real_glGetString(GL_EXTENSIONS);
	unsigned features = HAS_CONVENTIONAL | HAS_MULTITEXTURE;

	if (strstr(version, " 1.0") != version + strlen("OpenGL ES-CM"))
		features |= HAS_BUFFERS;
	if (has_word(extensions, "GL_OES_framebuffer_object"))
		features |= HAS_FRAMEBUFFERS;
	if (has_word(extensions, "GL_OES_point_size_array"))
		features |= HAS_POINT_SIZES;
	return features;
}

static unsigned find_features(void)
{
	const char *text = (const char *)real_glGetString(GL_VERSION), *extensions = NULL;
	unsigned features = HAS_DESKTOP;
	int major = 0, minor = 0, version, profile = 0;

	if (!text)
		return 0;
	if (strncmp(text, "OpenGL ES-C", 11) == 0)
		return find_es1_features(text);
	if (strncmp(text, "OpenGL ES", 9) == 0) /* no fixed-function queries; what ES 2 and GL 2.0 share */
		return HAS_BUFFERS | HAS_ATTRIBUTES | HAS_FRAMEBUFFERS;
	if (sscanf(text, "%d.%d", &major, &minor) != 2)
		return 0;
	version = 10 * major + minor;
	if (version >= 32)
		real_glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
	if (!(profile & GL_CONTEXT_CORE_PROFILE_BIT)) {
		features |= HAS_FIXED_FUNCTION | HAS_CONVENTIONAL;
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

void *context_data(enum context_slot slot)
{
	return current ? current->slots[slot].data : NULL;
}

void context_set_data(enum context_slot slot, void *data, void (*release)(void *data))
{
	current->slots[slot] = (struct slot){ data, release };
}

unsigned context_turn(void)
{
	return turn;
}

int context_select(void *handle)
{
	struct context *before = current;

	current = handle ? find_context(handle) : NULL;
	turn += current != before;
	if (!current || current->bound)
		return 0;
	current->bound = 1;
	current->features = find_features();
	return 1;
}

void context_destroyed(void *handle)
{
	pthread_mutex_lock(&list_lock);
	for (struct context *c = contexts; c; c = c->next) {
		if (c->handle != handle || !handle || c == current)
			continue;
		c->handle = NULL; /* the address may be reused for another context */
		for (int i = 0; i < N_CONTEXT_SLOTS; i++)
			if (c->slots[i].data)
				c->slots[i].release(c->slots[i].data);
		memset(c->slots, 0, sizeof(c->slots));
	}
	pthread_mutex_unlock(&list_lock);
}

/*
 * Errors. A driver whose flag was not fetched would not note another error (GL 2.1 sec. 2.5), so while the program has
 * some to fetch here, later ones are dropped.
 */

unsigned context_pending_error(unsigned error)
{
	unsigned first;

	if (!current || !current->n_errors)
		return error;
	first = current->errors[0];
	current->n_errors--;
	memmove(current->errors, current->errors + 1, sizeof(current->errors[0]) * (size_t)current->n_errors);
	return first;
}

void context_errors_before(void)
{
	const int keep = current && !current->n_errors;
	unsigned error;

	for (int i = 0; i < MAX_ERRORS && (error = real_glGetError()); i++)
		if (keep)
			current->errors[current->n_errors++] = error;
}

void context_errors_after(void)
{
	for (int i = 0; i < MAX_ERRORS && real_glGetError(); i++)
		;
}
