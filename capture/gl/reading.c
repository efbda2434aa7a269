/* Runs inside the traced program. */
#include "capture/gl/reading.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <stdint.h>

#include "capture/gl/context.h"
#include "real.h"

static const unsigned pack_state[READING_PACK] = { GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST,   GL_PACK_ROW_LENGTH,
	                                           GL_PACK_SKIP_ROWS,  GL_PACK_SKIP_PIXELS, GL_PACK_ALIGNMENT };
/* Scales, initially 1, and biases take turns. */
static const unsigned transfer_state[READING_TRANSFER] = { GL_RED_SCALE,   GL_RED_BIAS,  GL_GREEN_SCALE, GL_GREEN_BIAS,
	                                                   GL_BLUE_SCALE,  GL_BLUE_BIAS, GL_ALPHA_SCALE, GL_ALPHA_BIAS,
	                                                   GL_DEPTH_SCALE, GL_DEPTH_BIAS };

static unsigned read_target(void)
{
	return context_has(HAS_READ_FRAMEBUFFER) ? GL_READ_FRAMEBUFFER : GL_FRAMEBUFFER;
}

void reading_begin(struct reading_state *s)
{
	if (context_has(HAS_FRAMEBUFFERS)) {
		s->framebuffer = context_get(context_has(HAS_READ_FRAMEBUFFER) ? GL_READ_FRAMEBUFFER_BINDING :
		                                                               GL_FRAMEBUFFER_BINDING);
		if (s->framebuffer)
			real_glBindFramebuffer(read_target(), 0);
		/* Buffers, bits and samples are asked of the draw framebuffer. */
		s->draw_framebuffer = context_has(HAS_READ_FRAMEBUFFER) ? context_get(GL_DRAW_FRAMEBUFFER_BINDING) : 0;
		if (s->draw_framebuffer)
			real_glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
	}
	s->read_buffer = context_get(GL_READ_BUFFER);
	real_glReadBuffer(context_get(GL_DOUBLEBUFFER) ? GL_BACK : GL_FRONT);
	if (context_has(HAS_PIXEL_BUFFERS)) {
		s->pack_buffer = context_get(GL_PIXEL_PACK_BUFFER_BINDING);
		if (s->pack_buffer)
			real_glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
	}
	for (int i = 0; i < READING_PACK; i++) {
		s->pack[i] = context_get(pack_state[i]);
		real_glPixelStorei(pack_state[i], pack_state[i] == GL_PACK_ALIGNMENT ? 4 : 0);
	}
	if (context_has(HAS_PACK_INVERT)) {
		s->pack_invert = context_get(GL_PACK_INVERT_MESA);
		real_glPixelStorei(GL_PACK_INVERT_MESA, 0);
	}
	if (!context_has(HAS_FIXED_FUNCTION))
		return;
	s->map_color = context_get(GL_MAP_COLOR);
	if (s->map_color)
		real_glPixelTransferi(GL_MAP_COLOR, 0);
	for (int i = 0; i < READING_TRANSFER; i++) {
		float initial = i % 2 ? 0.0f : 1.0f;

		real_glGetFloatv(transfer_state[i], &s->transfer[i]);
		if (s->transfer[i] != initial)
			real_glPixelTransferf(transfer_state[i], initial);
	}
}

void reading_end(const struct reading_state *s)
{
	if (context_has(HAS_FIXED_FUNCTION)) {
		for (int i = 0; i < READING_TRANSFER; i++)
			if (s->transfer[i] != (i % 2 ? 0.0f : 1.0f))
				real_glPixelTransferf(transfer_state[i], s->transfer[i]);
		if (s->map_color)
			real_glPixelTransferi(GL_MAP_COLOR, s->map_color);
	}
	if (context_has(HAS_PACK_INVERT))
		real_glPixelStorei(GL_PACK_INVERT_MESA, s->pack_invert);
	for (int i = 0; i < READING_PACK; i++)
		real_glPixelStorei(pack_state[i], s->pack[i]);
	if (s->pack_buffer)
		real_glBindBuffer(GL_PIXEL_PACK_BUFFER, (unsigned)s->pack_buffer);
	real_glReadBuffer((unsigned)s->read_buffer);
	if (s->framebuffer)
		real_glBindFramebuffer(read_target(), (unsigned)s->framebuffer);
	if (s->draw_framebuffer)
		real_glBindFramebuffer(GL_DRAW_FRAMEBUFFER, (unsigned)s->draw_framebuffer);
}

/*
 * A multisampled window shows the mean of a pixel's samples. glReadPixels need not return it: Mesa's software
 * rasterizers return one sample (22.3.6). So a blit into a temporary renderbuffer computes what the window will show,
 * as the driver does at the swap.
 */
static void read_resolved(int width, int height, void *pixels)
{
	int renderbuffer = context_get(GL_RENDERBUFFER_BINDING);
	unsigned framebuffer = 0, colors = 0, scissor = real_glIsEnabled(GL_SCISSOR_TEST),
		 srgb = real_glIsEnabled(GL_FRAMEBUFFER_SRGB);

	real_glGenFramebuffers(1, &framebuffer);
	real_glGenRenderbuffers(1, &colors);
	real_glBindRenderbuffer(GL_RENDERBUFFER, colors);
	real_glRenderbufferStorage(GL_RENDERBUFFER, context_get(GL_ALPHA_BITS) > 0 ? GL_RGBA8 : GL_RGB8, width, height);
	real_glBindRenderbuffer(GL_RENDERBUFFER, (unsigned)renderbuffer);
	real_glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
	real_glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colors);
	if (scissor)
		real_glDisable(GL_SCISSOR_TEST);
	if (srgb)
		real_glDisable(GL_FRAMEBUFFER_SRGB);
	real_glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
	if (scissor)
		real_glEnable(GL_SCISSOR_TEST);
	if (srgb)
		real_glEnable(GL_FRAMEBUFFER_SRGB);
	real_glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
	real_glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
	real_glBindFramebuffer(GL_FRAMEBUFFER, 0);
	real_glDeleteFramebuffers(1, &framebuffer);
	real_glDeleteRenderbuffers(1, &colors);
}

void reading_colors(int width, int height, void *pixels)
{
	if (context_has(HAS_DESKTOP) && context_has(HAS_FRAMEBUFFERS) && context_has(HAS_READ_FRAMEBUFFER) &&
	    context_get(GL_SAMPLES) > 1)
		read_resolved(width, height, pixels);
	else
		real_glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}

/* 1 if the buffers have a pixel there: reading it overwrites two different values alike. */
static int has_pixel(int x, int y)
{
	uint32_t pixel[2] = { 0, ~0u };

	for (int i = 0; i < 2; i++)
		real_glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &pixel[i]);
	return pixel[0] == pixel[1];
}

void reading_held(int *width, int *height)
{
	int *sides[2] = { width, height };

	if (has_pixel(*width - 1, *height - 1) || !has_pixel(0, 0))
		return;
	for (int side = 0; side < 2; side++) {
		int least = 1, most = *sides[side];

		while (least < most) {
			const int middle = most - (most - least) / 2;

			if (has_pixel(side ? 0 : middle - 1, side ? middle - 1 : 0))
				least = middle;
			else
				most = middle - 1;
		}
		*sides[side] = least;
	}
}
