/* Runs inside the traced program. */
#include "capture/gl/marker.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <float.h>
#include <stdio.h>
#include <string.h>

#include "capture/gl/context.h"
#include "capture/relume.h"
#include "capture/write/fake.h"
#include "real.h"
#include "tables/commands.h"

#define SHOWN __attribute__((visibility("default")))

void marker_write(const char *text)
{
	fake_call(CMD_glStringMarkerGREMEDY, "is", (int)strlen(text), text);
}

SHOWN void relume_material(int kind, float amount, float ior);
SHOWN void relume_build_kd_tree(void);

/* A nonnegative number to six places, with a point in any locale. */
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
	marker_write(text);
}

void relume_build_kd_tree(void)
{
	marker_write("relume:kdtree");
}

/* The GL that draws: versions of Mesa differ where the specification leaves a choice (scene/mesa.h). */
static void marker_write_gl(void)
{
	const char *version = (const char *)real_glGetString(GL_VERSION),
		   *renderer = (const char *)real_glGetString(GL_RENDERER);
	char text[192];

	if (!version || !renderer)
		return;
	snprintf(text, sizeof(text), "relume:gl %s, %s", version, renderer);
	marker_write(text);
}

/* Sizes and properties of the current drawable's buffers. */
struct buffer_bits {
	int alpha, depth, stencil, srgb, accum;
};

static struct buffer_bits conventional_bits(void)
{
	return (struct buffer_bits){ context_get(GL_ALPHA_BITS), context_get(GL_DEPTH_BITS), context_get(GL_STENCIL_BITS),
		                     context_get(GL_FRAMEBUFFER_SRGB_CAPABLE_EXT),
		                     context_has(HAS_DESKTOP) ? context_get(GL_ACCUM_RED_BITS) : 0 };
}

/* A parameter of one of the drawable's buffers; 0 if it lacks that buffer. */
static int ask_buffer(unsigned buffer, unsigned pname)
{
	int value = 0;

	real_glGetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, buffer, pname, &value);
	return value;
}

/* The same in a core profile, which only answers for one buffer at a time (GL 3.2 sec. 6.1.13). */
static struct buffer_bits core_bits(void)
{
	const unsigned color = context_get(GL_DOUBLEBUFFER) ? GL_BACK_LEFT : GL_FRONT_LEFT;

	return (struct buffer_bits){ ask_buffer(color, GL_FRAMEBUFFER_ATTACHMENT_ALPHA_SIZE),
		                     ask_buffer(GL_DEPTH, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE),
		                     ask_buffer(GL_STENCIL, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE),
		                     ask_buffer(color, GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING) == GL_SRGB, 0 };
}

void marker_write_bits(void)
{
	struct buffer_bits bits;
	char text[96];

	context_errors_before();
	bits = context_has(HAS_CONVENTIONAL) ? conventional_bits() : core_bits();
	snprintf(text, sizeof(text), "relume:bits %d %d %d %d %d %d %d", bits.alpha, bits.depth, bits.stencil, bits.srgb,
	         context_get(GL_SAMPLES), !context_has(HAS_DESKTOP) || context_get(GL_DOUBLEBUFFER) != 0, bits.accum);
	context_errors_after();
	marker_write(text);
	marker_write_gl();
	if (FLT_EVAL_METHOD == 2) /* this build uses the x87, so the distribution's GL library does as well */
		marker_write("relume:x87");
}
