/* Runs inside the traced program. */
#include "capture/gl/restore.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <pthread.h>
#include <sys/mman.h>

#include "capture/format/sizes.h"
#include "capture/gl/context.h"
#include "capture/gl/drawable.h"
#include "capture/gl/reading.h"
#include "capture/gl/skip.h"
#include "capture/write/fake.h"
#include "capture/write/pages.h"
#include "capture/write/writer.h"
#include "real.h"

enum { MAX_TEXTURES = 4096, MAX_LEVELS = 16, MAX_UNITS = 8 };

struct texture {
	unsigned name, target;
};

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct texture textures[MAX_TEXTURES]; /* drawn to, as far as we know; under the lock */
static int n_textures;

static const struct pixel_layout close_layout = { .alignment = 1 }; /* rows tightly packed */

/* Textures with drawn contents */

static void note_texture(unsigned target, unsigned name)
{
	int i;

	pthread_mutex_lock(&lock);
	for (i = 0; i < n_textures && textures[i].name != name; i++)
		;
	if (i == n_textures && n_textures < MAX_TEXTURES)
		textures[n_textures++] = (struct texture){ name, target };
	pthread_mutex_unlock(&lock);
}

static unsigned whole_target(unsigned target)
{
	return target >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && target <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z ?
	               GL_TEXTURE_CUBE_MAP :
	               target;
}

static unsigned binding_of(unsigned target)
{
	switch (target) {
	case GL_TEXTURE_1D: return GL_TEXTURE_BINDING_1D;
	case GL_TEXTURE_2D: return GL_TEXTURE_BINDING_2D;
	case GL_TEXTURE_3D: return GL_TEXTURE_BINDING_3D;
	case GL_TEXTURE_CUBE_MAP: return GL_TEXTURE_BINDING_CUBE_MAP;
	case GL_TEXTURE_RECTANGLE: return GL_TEXTURE_BINDING_RECTANGLE;
	default: return 0;
	}
}

void restore_texture_copied(unsigned target)
{
	unsigned binding = skip_active() ? binding_of(whole_target(target)) : 0;
	int name = binding && writer_active() && !skip_is_compiling() ? context_get(binding) : 0;

	if (name)
		note_texture(whole_target(target), (unsigned)name);
}

void restore_texture_attached(unsigned target, unsigned name)
{
	if (name && writer_active() && binding_of(whole_target(target)))
		note_texture(whole_target(target), name);
}

/* Pixel state */

static const unsigned store_names[] = { GL_UNPACK_SWAP_BYTES,  GL_UNPACK_LSB_FIRST,   GL_UNPACK_ROW_LENGTH,
	                                GL_UNPACK_SKIP_ROWS,   GL_UNPACK_SKIP_PIXELS, GL_UNPACK_ALIGNMENT,
	                                GL_UNPACK_SKIP_IMAGES, GL_UNPACK_IMAGE_HEIGHT };
static const unsigned transfer_names[] = { GL_RED_SCALE, GL_RED_BIAS,    GL_GREEN_SCALE, GL_GREEN_BIAS,  GL_BLUE_SCALE,
	                                   GL_BLUE_BIAS, GL_ALPHA_SCALE, GL_ALPHA_BIAS,  GL_DEPTH_SCALE, GL_DEPTH_BIAS,
	                                   GL_MAP_COLOR, GL_MAP_STENCIL, GL_INDEX_SHIFT, GL_INDEX_OFFSET };
enum {
	N_STORE = sizeof(store_names) / sizeof(store_names[0]),
	N_TRANSFER = sizeof(transfer_names) / sizeof(transfer_names[0]),
	FIRST_3D = 6,
	N_SCALES = 10 /* scales, initially 1, and biases take turns; all others are 0 */
};
static int store_initial(unsigned i)
{
	return store_names[i] == GL_UNPACK_ALIGNMENT; /* 1: rows tightly packed; all others 0 */
}

void restore_make_neutral(int back)
{
	int buffer = context_has(HAS_PIXEL_BUFFERS) ? context_get(GL_PIXEL_UNPACK_BUFFER_BINDING) : 0;

	if (buffer)
		fake_call(CMD_glBindBuffer, "eu", GL_PIXEL_UNPACK_BUFFER, back ? (unsigned)buffer : 0);
	for (unsigned i = 0; i < (context_has(HAS_3D) ? N_STORE : FIRST_3D); i++) {
		int value = context_get(store_names[i]);

		if (value != store_initial(i))
			fake_call(CMD_glPixelStorei, "ei", store_names[i], back ? value : store_initial(i));
	}
	for (unsigned i = 0; i < N_TRANSFER; i++) {
		float value, initial = i < N_SCALES && i % 2 == 0 ? 1.0f : 0.0f;

		real_glGetFloatv(transfer_names[i], &value);
		if (value != initial)
			fake_call(CMD_glPixelTransferf, "ef", transfer_names[i], (double)(back ? value : initial));
	}
}

/* Textures */

/* Rows are tightly packed on both sides. 0 if there is no such level. */
static int restore_level(unsigned target, int level)
{
	int width = context_get_level(target, level, GL_TEXTURE_WIDTH),
	    height = context_get_level(target, level, GL_TEXTURE_HEIGHT);
	int depth = target == GL_TEXTURE_3D ? context_get_level(target, level, GL_TEXTURE_DEPTH) : 1;
	int wide = context_get_level(target, level, GL_TEXTURE_RED_SIZE) > 8;
	unsigned format = GL_RGBA, type = wide ? GL_FLOAT : GL_UNSIGNED_BYTE;
	long bytes;
	void *pixels;

	if (width <= 0 || height <= 0 || depth <= 0)
		return 0;
	if (context_get_level(target, level, GL_TEXTURE_COMPRESSED))
		return 1; /* GL draws to none of these */
	if (context_get_level(target, level, GL_TEXTURE_DEPTH_SIZE)) {
		int stencil = context_get_level(target, level, GL_TEXTURE_STENCIL_SIZE);

		format = stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT;
		type = stencil ? GL_UNSIGNED_INT_24_8 : GL_FLOAT;
	}
	bytes = image_bytes(&close_layout, &(struct pixel_box){ 3, format, type, width, height, depth });
	pixels = bytes > 0 ? pages_map((size_t)bytes) : NULL;
	if (!pixels)
		return 0;
	real_glGetTexImage(target, level, format, type, pixels);
	if (target == GL_TEXTURE_1D)
		fake_call(CMD_glTexSubImage1D, "eiiieeb", target, level, 0, width, format, type, pixels, bytes);
	else if (target == GL_TEXTURE_3D)
		fake_call(CMD_glTexSubImage3D, "eiiiiiiieeb", target, level, 0, 0, 0, width, height, depth, format,
		          type, pixels, bytes);
	else
		fake_call(CMD_glTexSubImage2D, "eiiiiieeb", target, level, 0, 0, width, height, format, type, pixels, bytes);
	munmap(pixels, (size_t)bytes);
	return 1;
}

static void restore_texture(const struct texture *t)
{
	int bound = context_get(binding_of(t->target)), cube = t->target == GL_TEXTURE_CUBE_MAP;

	if (!real_glIsTexture(t->name))
		return;
	if (bound != (int)t->name) {
		real_glBindTexture(t->target, t->name);
		fake_call(CMD_glBindTexture, "eu", t->target, t->name);
	}
	for (unsigned face = 0; face < (cube ? 6 : 1); face++) {
		unsigned target = cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + face : t->target;

		for (int level = 0; level < MAX_LEVELS && restore_level(target, level); level++)
			;
	}
	if (bound != (int)t->name) {
		real_glBindTexture(t->target, (unsigned)bound);
		fake_call(CMD_glBindTexture, "eu", t->target, (unsigned)bound);
	}
}

/* The window */

/* Within PushAttrib and PopAttrib: let fragments reach the buffers unchanged. */
static void make_pass_through(void)
{
	static const unsigned caps[] = {
		GL_ALPHA_TEST,          GL_BLEND,        GL_DITHER,       GL_FOG,        GL_LIGHTING,
		GL_COLOR_LOGIC_OP,      GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_DEPTH_TEST, GL_COLOR_SUM,
		GL_FRAGMENT_PROGRAM_ARB
	};
	static const unsigned targets[] = { GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP,
		                            GL_TEXTURE_RECTANGLE };
	int active = context_has(HAS_MULTITEXTURE) ? context_get(GL_ACTIVE_TEXTURE) : 0;
	int units = active ? context_get(GL_MAX_TEXTURE_UNITS) : 1;

	for (unsigned i = 0; i < sizeof(caps) / sizeof(caps[0]); i++)
		if (real_glIsEnabled(caps[i]))
			fake_call(CMD_glDisable, "e", caps[i]);
	for (int unit = 0; unit < units && unit < MAX_UNITS; unit++) {
		if (active)
			real_glActiveTexture(GL_TEXTURE0 + (unsigned)unit);
		for (unsigned i = 0; i < sizeof(targets) / sizeof(targets[0]); i++) {
			if (!real_glIsEnabled(targets[i]))
				continue;
			if (active)
				fake_call(CMD_glActiveTexture, "e", GL_TEXTURE0 + (unsigned)unit);
			fake_call(CMD_glDisable, "e", targets[i]);
		}
	}
	if (active)
		real_glActiveTexture((unsigned)active);
	fake_call(CMD_glPixelZoom, "ff", 1.0, 1.0);
	fake_call(CMD_glDrawBuffer, "e", context_get(GL_DOUBLEBUFFER) ? GL_BACK : GL_FRONT);
	fake_call(CMD_glDepthMask, "t", 1u);
	fake_call(CMD_glStencilMask, "u", ~0u);
	fake_call(CMD_glWindowPos2i, "ii", 0, 0);
}

static void draw_pixels(int width, int height, unsigned format, unsigned type)
{
	long bytes = image_bytes(&close_layout, &(struct pixel_box){ 2, format, type, width, height, 1 });
	void *pixels = bytes > 0 ? pages_map((size_t)bytes) : NULL;

	if (!pixels)
		return;
	if (format == GL_RGBA)
		reading_colors(width, height, pixels);
	else
		real_glReadPixels(0, 0, width, height, format, type, pixels);
	fake_call(CMD_glDrawPixels, "iieeb", width, height, format, type, pixels, bytes);
	munmap(pixels, (size_t)bytes);
}

/* `framebuffer`: bound for drawing by the program; 0 is the window. */
static void restore_window(int width, int height, unsigned framebuffer)
{
	unsigned draw_target = context_has(HAS_READ_FRAMEBUFFER) ? GL_DRAW_FRAMEBUFFER : GL_FRAMEBUFFER;
	int program = context_has(HAS_BUFFERS) && context_has(HAS_ATTRIBUTES) ? context_get(GL_CURRENT_PROGRAM) : 0;

	if (width <= 0 || height <= 0 || !context_has(HAS_WINDOW_POS) || context_get(GL_RENDER_MODE) != GL_RENDER ||
	    context_get(GL_ATTRIB_STACK_DEPTH) >= context_get(GL_MAX_ATTRIB_STACK_DEPTH))
		return;
	if (framebuffer)
		fake_call(CMD_glBindFramebuffer, "eu", draw_target, 0);
	fake_call(CMD_glPushAttrib, "m", GL_ALL_ATTRIB_BITS);
	if (program)
		fake_call(CMD_glUseProgram, "u", 0);
	make_pass_through();
	fake_call(CMD_glColorMask, "tttt", 1u, 1u, 1u, 1u);
	draw_pixels(width, height, GL_RGBA, GL_UNSIGNED_BYTE);
	if (context_get(GL_STENCIL_BITS) > 0)
		draw_pixels(width, height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE);
	if (context_get(GL_DEPTH_BITS) > 0) {
		fake_call(CMD_glColorMask, "tttt", 0u, 0u, 0u, 0u);
		fake_call(CMD_glEnable, "e", GL_DEPTH_TEST);
		fake_call(CMD_glDepthFunc, "e", GL_ALWAYS);
		draw_pixels(width, height, GL_DEPTH_COMPONENT, GL_FLOAT);
	}
	if (program)
		fake_call(CMD_glUseProgram, "u", (unsigned)program);
	fake_call(CMD_glPopAttrib, "");
	if (framebuffer)
		fake_call(CMD_glBindFramebuffer, "eu", draw_target, framebuffer);
}

void restore_drawn(int width, int height)
{
	struct reading_state state = { 0 };

	if (!context_has(HAS_FIXED_FUNCTION) || context_get(GL_LIST_INDEX))
		return;
	context_errors_before();
	drawable_make_size_known(); /* its clear was left out with its frame */
	restore_make_neutral(0);
	reading_begin(&state);
	real_glPixelStorei(GL_PACK_ALIGNMENT, 1); /* restored with everything else */
	pthread_mutex_lock(&lock);
	for (int i = 0; i < n_textures; i++)
		restore_texture(&textures[i]);
	pthread_mutex_unlock(&lock);
	restore_window(width, height,
	               (unsigned)(context_has(HAS_READ_FRAMEBUFFER) ? state.draw_framebuffer : state.framebuffer));
	reading_end(&state);
	restore_make_neutral(1);
	context_errors_after();
}
