/* Drawing of pixels (GL 2.1 sec. 3.6, 3.7, 4.3.3): Bitmap, DrawPixels, CopyPixels. */
#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/pixels/rectangle.h"
#include "replay/gl/surface/screen.h"
#include "replay/gl/texture/legal.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/transfer.h"
#include "replay/gl/texture/unpack.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/picture.h"

GLS_HANDLER(glBitmap, STATE, BITMAP)
{
	struct gls_pixels p = { .width = arg_u(c, 0), .height = arg_u(c, 1), .store = gls_client_store(x, st) };
	float *at = st->a.current.raster_position;
	uint8_t *texels;

	if (gls_refuses(x, st, arg_i(c, 0) < 0 || arg_i(c, 1) < 0, GL_INVALID_VALUE))
		return;
	if (!st->a.current.raster_valid)
		return;
	p.data = gls_pixel_source(st, c, 6, &p.n);
	if (p.data && p.width && p.height && p.width <= GLS_MAX_RECTANGLE && p.height <= GLS_MAX_RECTANGLE && x->want) {
		gls_pixel_missing(x, st, c, 6);
		texels = gls_scratch(x, (size_t)p.width * p.height * 4);
		for (uint32_t i = 0; texels && i < p.width * p.height; i++)
			memset(texels + 4 * (size_t)i, gls_unpack_bit(&p, i % p.width, i / p.width) ? 255 : 0, 4);
		/*
		 * The lower left corner is rounded down to whole pixels; Mesa first adds a little, against rounding
		 * errors.
		 */
		if (texels)
			gls_draw_rectangle(x, st,
			                   &(struct gls_rectangle){ .kind = SCENE_BITMAP,
			                                            .width = p.width,
			                                            .height = p.height,
			                                            .left = floorf(at[0] + 0.0001f - arg_f(c, 2)),
			                                            .low = floorf(at[1] + 0.0001f - arg_f(c, 3)),
			                                            .zoom = { 1, 1 },
			                                            .texels = texels });
	}
	at[0] += arg_f(c, 4);
	at[1] += arg_f(c, 5);
}

/*
 * A rectangle at the raster position, with PixelZoom.
 * @param copied  1: the pixels come from the read buffer; Mesa (22.3.6) keeps a window's rows from the top
 */
static struct gls_rectangle at_raster_position(const struct gls_state *st, uint32_t kind, uint32_t width,
                                               uint32_t height, const uint8_t *texels, int copied)
{
	const float *at = st->a.current.raster_position, *zoom = st->a.pixel.zoom;

	return (struct gls_rectangle){ .kind = kind,
		                       .width = width,
		                       .height = height,
		                       .left = roundf(at[0]),
		                       .low = roundf(at[1]),
		                       .zoom = { zoom[0], zoom[1] },
		                       .texels = texels,
		                       .from_top = copied && !st->read_framebuffer };
}

/*
 * Draw depths and stencil values together (EXT_packed_depth_stencil).
 * @param texels  depths; overwritten by stencil values
 */
static void draw_depth_stencil(struct gls_exec *x, struct gls_state *st, uint32_t width, uint32_t height,
                               uint8_t *texels, const uint8_t *stencil, int copied)
{
	struct gls_rectangle r = at_raster_position(st, SCENE_DEPTH_PIXELS, width, height, texels, copied);

	gls_draw_depths(x, st, &r);
	for (size_t i = 0; i < (size_t)width * height; i++) {
		uint32_t value = stencil[i];

		memcpy(texels + 4 * i, &value, 4);
	}
	r.kind = SCENE_STENCIL_PIXELS;
	gls_draw_rectangle(x, st, &r);
}

static uint32_t kind_of(uint32_t format)
{
	return format == GL_STENCIL_INDEX || format == GL_STENCIL ? SCENE_STENCIL_PIXELS :
	       format == GL_DEPTH_COMPONENT || format == GL_DEPTH ? SCENE_DEPTH_PIXELS : SCENE_COLOR_PIXELS;
}

/* 1 if a rectangle of this size is drawn at all. */
static int is_drawable(const struct gls_exec *x, const struct gls_state *st, uint32_t width, uint32_t height)
{
	return st->a.current.raster_valid && width && height && width <= GLS_MAX_RECTANGLE &&
	       height <= GLS_MAX_RECTANGLE && x->want;
}

GLS_HANDLER(glDrawPixels, STATE)
{
	struct gls_pixels p = { .format = arg_u(c, 2), .type = arg_u(c, 3), .width = arg_u(c, 0), .height = arg_u(c, 1),
		                .store = gls_client_store(x, st), .drawn = 1 };
	int indices = p.format == GL_COLOR_INDEX || p.format == GL_STENCIL_INDEX, rc;
	uint32_t kind = kind_of(p.format), wrong;
	struct gls_rectangle r;
	uint8_t *texels, *stencil;

	if (gls_refuses(x, st, arg_i(c, 0) < 0 || arg_i(c, 1) < 0, GL_INVALID_VALUE))
		return;
	wrong = gls_pixels_error(p.format, p.type, st->mesa);
	if (gls_refuses_by(x, st, wrong))
		return;
	p.data = gls_pixel_source(st, c, 4, &p.n);
	if (!p.data || !is_drawable(x, st, p.width, p.height))
		return;
	gls_pixel_missing(x, st, c, 4);
	if (kind == SCENE_COLOR_PIXELS && !indices)
		kind = gls_color_pixels(x, st);
	texels = gls_scratch(x, (size_t)p.width * p.height * (kind == SCENE_FLOAT_PIXELS ? 16 : 5));
	if (!texels)
		return;
	if (p.format == GL_DEPTH_STENCIL) {
		stencil = texels + 4 * (size_t)p.width * p.height;
		if (gls_unpack_pixels(x, st, &p, GL_DEPTH_COMPONENT, texels) == -1)
			return;
		gls_unpack_stencil(&p, stencil);
		draw_depth_stencil(x, st, p.width, p.height, texels, stencil, 0);
		return;
	}
	if (!indices || gls_unpack_indices(st, &p, texels)) {
		rc = gls_unpack_pixels(x, st, &p, kind == SCENE_DEPTH_PIXELS ? GL_DEPTH_COMPONENT :
		                                  kind == SCENE_FLOAT_PIXELS ? GL_RGBA32F : GL_RGBA, texels);
		if (rc == -2 && p.store->buffer) /* then nothing is drawn (sec. 4.3.1, ARB_pixel_buffer_object) */
			gls_error(x, st, GL_INVALID_OPERATION);
		if (rc == -1 || (rc == -2 && p.store->buffer))
			return;
	}
	r = at_raster_position(st, kind, p.width, p.height, texels, 0);
	gls_draw_rectangle(x, st, &r);
}

/* Convert a pixel of the read buffer to a texel; 0 outside of the buffer, where GL leaves the value undefined. */
static void copy_texel(const struct gls_state *st, const struct scene_picture *p, uint32_t kind, int64_t x, int64_t y,
                       uint8_t *texel)
{
	uint32_t bits = p->depth_bits, value;
	size_t from;
	float v[4];

	memset(texel, 0, kind == SCENE_FLOAT_PIXELS ? 16 : 4);
	if (x < 0 || y < 0 || x >= p->width || y >= p->height)
		return;
	from = (size_t)y * p->width + (size_t)x;
	if (kind == SCENE_STENCIL_PIXELS) {
		value = gls_transfer_index(st, p->stencil[from]);
		memcpy(texel, &value, 4);
	} else if (kind == SCENE_DEPTH_PIXELS) {
		v[0] = gls_transfer_depth(st, bits ? (float)p->depth[from] / (float)((1u << bits) - 1) : 0);
		memcpy(texel, v, 4);
	} else {
		gls_picture_color(p, from, v);
		gls_transfer_color(st, 1, v);
		gls_format_store(gls_format_find(kind == SCENE_FLOAT_PIXELS ? GL_RGBA32F : GL_RGBA), v, 0, texel);
	}
}

GLS_HANDLER(glCopyPixels, STATE)
{
	int64_t x0 = arg_i32(c, 0), y0 = arg_i32(c, 1);
	uint32_t width = arg_u(c, 2), height = arg_u(c, 3), kind = kind_of(arg_u(c, 4));
	const struct scene_picture *p;
	struct gls_rectangle r;
	uint8_t *texels;
	size_t bytes;

	if (gls_refuses(x, st, arg_i(c, 2) < 0 || arg_i(c, 3) < 0, GL_INVALID_VALUE) ||
	    gls_refuses(x, st,
	                arg_u(c, 4) != GL_COLOR && arg_u(c, 4) != GL_DEPTH && arg_u(c, 4) != GL_STENCIL &&
	                        arg_u(c, 4) != GL_DEPTH_STENCIL,
	                GL_INVALID_ENUM))
		return;
	if (!is_drawable(x, st, width, height))
		return;
	if (kind == SCENE_COLOR_PIXELS)
		kind = gls_color_pixels(x, st);
	bytes = kind == SCENE_FLOAT_PIXELS ? 16 : 4;
	p = gls_read_screen(x, st, &(struct gls_area){ { (int32_t)x0, (int32_t)y0, (int32_t)width, (int32_t)height },
	                                               arg_u(c, 4) == GL_DEPTH_STENCIL ? 6u : kind == SCENE_DEPTH_PIXELS ? 2u :
	                                               kind == SCENE_STENCIL_PIXELS ? 4u : 1u });
	texels = p ? gls_scratch(x, (size_t)width * height * (bytes + 1)) : NULL;
	if (!texels)
		return;
	if (arg_u(c, 4) == GL_DEPTH_STENCIL) {
		uint8_t *stencil = texels + 4 * (size_t)width * height, value[4];

		for (uint32_t i = 0; i < width * height; i++) {
			copy_texel(st, p, SCENE_DEPTH_PIXELS, x0 + i % width, y0 + i / width, texels + 4 * (size_t)i);
			copy_texel(st, p, SCENE_STENCIL_PIXELS, x0 + i % width, y0 + i / width, value);
			stencil[i] = value[0];
		}
		draw_depth_stencil(x, st, width, height, texels, stencil, 1);
		return;
	}
	for (uint32_t i = 0; i < width * height; i++)
		copy_texel(st, p, kind, x0 + i % width, y0 + i / width, texels + bytes * i);
	r = at_raster_position(st, kind, width, height, texels, 1);
	gls_draw_rectangle(x, st, &r);
}
