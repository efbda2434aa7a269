/* BlitFramebuffer (GL 3.0 sec. 4.3.2): a pixel rectangle affected only by the scissor. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/pixels/rectangle.h"
#include "replay/gl/surface/screen.h"
#include "replay/gl/surface/shown.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/picture.h"

struct blit {
	int64_t from[4]; /* x0 y0 x1 y1, ascending */
	float corner[2], zoom[2];
	int64_t source[2], place[2], across[2]; /* as given in the call: where both begin, and the extent of the destination */
};

static void blit_one(struct gls_exec *x, struct gls_state *st, const struct blit *b, uint32_t kind,
                     const struct scene_picture *p)
{
	uint32_t width = (uint32_t)(b->from[2] - b->from[0]), height = (uint32_t)(b->from[3] - b->from[1]);
	size_t bytes = kind == SCENE_FLOAT_PIXELS ? 16 : 4;
	uint8_t *texels = gls_scratch(x, (size_t)width * height * bytes);

	for (uint32_t i = 0; texels && i < width * height; i++) {
		int64_t px = b->from[0] + i % width, py = b->from[1] + i / width;
		size_t at = (size_t)(py * p->width + px);
		uint32_t stencil;
		float depth, v[4];

		memset(texels + bytes * i, 0, bytes);
		if (px < 0 || py < 0 || px >= p->width || py >= p->height)
			continue;
		stencil = p->stencil[at];
		depth = p->depth_bits ? (float)p->depth[at] / (float)((1u << p->depth_bits) - 1) : 1;
		gls_picture_color(p, at, v);
		memcpy(texels + bytes * i,
		       kind == SCENE_COLOR_PIXELS ? (const void *)(p->rgba + 4 * at) :
		       kind == SCENE_FLOAT_PIXELS ? v :
		       kind == SCENE_DEPTH_PIXELS ? (const void *)&depth :
		                                    (const void *)&stencil,
		       bytes);
	}
	if (texels)
		gls_copy_rectangle(x, st,
		                   &(struct gls_rectangle){ .kind = kind,
		                                            .width = width,
		                                            .height = height,
		                                            .left = b->corner[0],
		                                            .low = b->corner[1],
		                                            .zoom = { b->zoom[0], b->zoom[1] },
		                                            .texels = texels },
		                   15);
}

/* The two pixels around a point, whose centres are at halves: the lower one, and the weight of the upper one. */
static double find_lower(const struct blit *b, unsigned direction, uint32_t i, uint32_t size, size_t lower[2])
{
	const int64_t least = b->across[direction] < 0 ? b->across[direction] : 0;
	const double from = (double)b->source[direction] +
	                    ((double)(least + (int64_t)i) + 0.5) / (double)b->zoom[direction] - 0.5;
	const double at = fmin(fmax(from, 0), (double)size - 1);

	lower[0] = (size_t)at;
	lower[1] = lower[0] + 1 < size ? lower[0] + 1 : lower[0];
	return at - (double)lower[0];
}

/*
 * Bilinear filtering of the nearest four pixels for each pixel of the destination; beyond the border the last ones are
 * repeated.
 */
static void blit_between(struct gls_exec *x, struct gls_state *st, const struct blit *b, uint32_t kind,
                         const struct scene_picture *p)
{
	const uint32_t width = (uint32_t)llabs(b->across[0]), height = (uint32_t)llabs(b->across[1]);
	const size_t bytes = kind == SCENE_FLOAT_PIXELS ? 16 : 4;
	const float corner[2] = { (float)(b->place[0] + (b->across[0] < 0 ? b->across[0] : 0)),
		                  (float)(b->place[1] + (b->across[1] < 0 ? b->across[1] : 0)) };
	uint8_t *texels = gls_scratch(x, (size_t)width * height * bytes);

	for (uint32_t i = 0; texels && i < width * height; i++) {
		size_t column[2], row[2];
		const double u = find_lower(b, 0, i % width, p->width, column), v = find_lower(b, 1, i / width, p->height, row);
		float near[4], mixed[4] = { 0 };

		for (unsigned k = 0; k < 4; k++) {
			gls_picture_color(p, row[k / 2] * p->width + column[k % 2], near);
			for (unsigned c = 0; c < 4; c++)
				mixed[c] += (float)((k % 2 ? u : 1 - u) * (k / 2 ? v : 1 - v)) * near[c];
		}
		if (kind == SCENE_FLOAT_PIXELS)
			memcpy(texels + bytes * i, mixed, bytes);
		for (unsigned c = 0; c < 4 && kind != SCENE_FLOAT_PIXELS; c++)
			texels[4 * i + c] = (uint8_t)lrintf(255 * fminf(fmaxf(mixed[c], 0), 1));
	}
	if (texels)
		gls_copy_rectangle(x, st,
		                   &(struct gls_rectangle){ .kind = kind,
		                                            .width = width,
		                                            .height = height,
		                                            .left = corner[0],
		                                            .low = corner[1],
		                                            .zoom = { 1, 1 },
		                                            .texels = texels },
		                   15);
}

/*
 * One direction (0: x, 1: y): the source in ascending order, the destination of its lower end, and the magnification.
 * The call gives both ends of the source, then of the destination, for x and y in turn.
 * @return 0: nothing is left
 */
static int find_span(const struct call *c, unsigned direction, struct blit *b)
{
	int64_t s0 = arg_i32(c, direction), s1 = arg_i32(c, direction + 2), d0 = arg_i32(c, direction + 4),
		d1 = arg_i32(c, direction + 6);

	b->from[direction] = s0 < s1 ? s0 : s1;
	b->from[direction + 2] = s0 < s1 ? s1 : s0;
	b->corner[direction] = (float)(s0 < s1 ? d0 : d1);
	b->zoom[direction] = s0 == s1 ? 0 : (float)(d1 - d0) / (float)(s1 - s0);
	b->source[direction] = s0;
	b->place[direction] = d0;
	b->across[direction] = d1 - d0;
	return s0 != s1 && d0 != d1 && llabs(d1 - d0) <= GLS_MAX_RECTANGLE &&
	       b->from[direction + 2] - b->from[direction] <= GLS_MAX_RECTANGLE;
}

GLS_HANDLER(glBlitFramebuffer, OBJECT)
{
	struct blit b;
	uint32_t mask = arg_u(c, 8);
	const struct scene_picture *p;
	struct gls_drawn drawn = { NULL };
	int between;

	if (gls_refuses(x, st, mask & ~(uint32_t)(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT),
	                GL_INVALID_VALUE) ||
	    gls_refuses(x, st, arg_u(c, 9) != GL_NEAREST && arg_u(c, 9) != GL_LINEAR, GL_INVALID_ENUM) ||
	    gls_refuses(x, st, arg_u(c, 9) == GL_LINEAR && mask & (GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT),
	                GL_INVALID_OPERATION))
		return;
	if (!find_span(c, 0, &b) || !find_span(c, 1, &b) || !x->want)
		return;
	between = arg_u(c, 9) == GL_LINEAR && (fabsf(b.zoom[0]) != 1 || fabsf(b.zoom[1]) != 1);
	if (!between)
		drawn = gls_shown_by_blit(x, st);
	p = gls_read_screen(x, st, NULL);
	if (p && (!p->width || !p->height))
		p = NULL; /* nothing to copy */
	if (p && mask & GL_COLOR_BUFFER_BIT && between)
		blit_between(x, st, &b, gls_color_pixels(x, st), p);
	else if (p && mask & GL_COLOR_BUFFER_BIT)
		blit_one(x, st, &b, gls_color_pixels(x, st), p);
	gls_shown_end(x, st, drawn);
	if (!p)
		return;
	if (mask & GL_DEPTH_BUFFER_BIT)
		blit_one(x, st, &b, SCENE_DEPTH_PIXELS, p);
	if (mask & GL_STENCIL_BUFFER_BIT)
		blit_one(x, st, &b, SCENE_STENCIL_PIXELS, p);
}
