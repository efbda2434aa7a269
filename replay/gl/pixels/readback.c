/*
 * Pixels and texels that the program reads (GL 2.1 sec. 4.3.2, 6.1.4). A replay ignores reads into the program's
 * memory; those into a buffer object are data for later calls (ARB_pixel_buffer_object).
 */
#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/pixels/teximage.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/surface/screen.h"
#include "replay/gl/texture/level.h"
#include "replay/gl/texture/pack.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/transfer.h"
#include "replay/machine/args.h"
#include "replay/machine/buffer.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/picture.h"

/* The layout and destination of a read. */
struct reading {
	struct gls_packing to;
	struct gls_buffer *buffer; /* NULL: the program's memory */
};

/*
 * Find the destination of an image that argument `data` of a call refers to. @return 0: not needed, unsupported, or a
 * GL error
 */
static int find_place(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned data,
                      const uint32_t size[3], struct reading *r)
{
	const uint32_t format = arg_u(c, data - 2), type = arg_u(c, data - 1);
	const uint64_t offset = (uint64_t)arg_i(c, data);
	size_t unit;

	r->buffer = gls_buffer_find(st, st->client.pack.buffer);
	if (!r->buffer || !arg_is_offset(c, data) || !size[0] || !size[1])
		return 0;
	if (!gls_packing_find(format, type, &r->to)) {
		gls_unsupported(x, "pixels of this format and type read into a buffer object");
		return 0;
	}
	unit = r->to.packed ? r->to.packed->bytes : r->to.component;
	return !gls_refuses(x, st,
	                    offset % (unit > 4 ? 4 : unit) ||
	                            !gls_packing_lay(&r->to, &st->client.pack, size, offset, r->buffer->bytes),
	                    GL_INVALID_OPERATION);
}

/* Mark bytes as written; those between rows do not change. whole: every pixel was written */
static void wrote(struct gls_exec *x, const struct reading *r, const uint32_t size[3], int whole)
{
	const int has_gaps = (size[1] > 1 && r->to.row != r->to.group * size[0]) ||
	                     (size[2] > 1 && r->to.image != r->to.row * size[1]);

	gls_buffer_fill(x, r->buffer, whole && !has_gaps ? (size_t)r->to.start : SIZE_MAX,
	                whole && !has_gaps ? (size_t)r->to.end : 0);
}

/* ---- ReadPixels ---- */

static void pack_color(const struct gls_state *st, const struct reading *r, const struct scene_picture *p, size_t from,
                       uint8_t *to)
{
	struct gls_packed_color color = { .bytes = !p->colors && !gls_transfer_changes_colors(st) };

	gls_picture_color(p, from, color.rgba);
	gls_transfer_color(st, 0, color.rgba);
	gls_pack_color(&r->to, &color, to);
}

static uint8_t stencil_at(const struct gls_state *st, const struct scene_picture *p, size_t from)
{
	return (uint8_t)gls_transfer_stencil(st, gls_transfer_index(st, p->stencil[from]) & 255);
}

static void pack_depth(const struct gls_state *st, const struct reading *r, const struct scene_picture *p, size_t from,
                       uint8_t *to)
{
	const int changes = st->a.pixel.depth_scale != 1 || st->a.pixel.depth_bias != 0;
	const double most = (double)((1u << p->depth_bits) - 1);

	gls_pack_depth(&r->to, gls_transfer_depth(st, most > 0 ? (float)(p->depth[from] * (1 / most)) : 0), p->depth[from],
	               changes ? 0 : p->depth_bits, r->to.format == GL_DEPTH_STENCIL ? stencil_at(st, p, from) : 0, to);
}

/* Pixels for places off the screen are unchanged. area: as in struct gls_area */
static void pack_pixels(const struct gls_state *st, const struct reading *r, const struct scene_picture *p,
                        const int64_t area[4])
{
	const int64_t left = area[0] > 0 ? area[0] : 0, low = area[1] > 0 ? area[1] : 0;
	const int64_t right = area[0] + area[2] < p->width ? area[0] + area[2] : p->width;
	const int64_t top = area[1] + area[3] < p->height ? area[1] + area[3] : p->height;

	for (int64_t y = low; y < top; y++)
		for (int64_t x = left; x < right; x++) {
			uint8_t *to = r->buffer->data + gls_packing_at(&r->to, (uint32_t)(x - area[0]), (uint32_t)(y - area[1]), 0);
			const size_t from = (size_t)(y * p->width + x);

			if (!r->to.colors)
				gls_pack_stencil(&r->to, stencil_at(st, p, from), to);
			else if (r->to.colors->to[0] == 5)
				pack_depth(st, r, p, from, to);
			else
				pack_color(st, r, p, from, to);
		}
}

GLS_HANDLER(glReadPixels, OBJECT)
{
	const int64_t area[4] = { arg_i32(c, 0), arg_i32(c, 1), arg_i32(c, 2), arg_i32(c, 3) };
	const uint32_t size[3] = { (uint32_t)area[2], (uint32_t)area[3], 0 };
	const struct scene_picture *p;
	struct reading r;
	uint32_t looked;

	if (gls_refuses(x, st, area[2] < 0 || area[3] < 0, GL_INVALID_VALUE) || !find_place(x, st, c, 6, size, &r))
		return;
	looked = !r.to.colors ? 4u : r.to.format == GL_DEPTH_STENCIL ? 6u : r.to.format == GL_DEPTH_COMPONENT ? 2u : 1u;
	p = gls_read_screen(
		x, st,
		&(struct gls_area){ { (int32_t)area[0], (int32_t)area[1], (int32_t)area[2], (int32_t)area[3] },
	                            looked });
	if (p && p->colors && r.to.colors && r.to.colors->to[0] == 4) {
		gls_unsupported(x, "luminance of floats read into a buffer object");
		return;
	}
	if (p) {
		pack_pixels(st, &r, p, area);
		wrote(x, &r, size, area[0] >= 0 && area[1] >= 0 && area[0] + area[2] <= p->width && area[1] + area[3] <= p->height);
	} else if (!x->want || !x->feedback.supply) {
		gls_buffer_lose(x, r.buffer, (size_t)r.to.start, (size_t)r.to.end, (uint32_t)x->frame + 1);
		x->feedback.missing = 1;
	}
}

/* ---- GetTexImage ---- */

/*
 * A texel as in table 6.1: luminance is returned as red. Components with fewer than 8 bits are returned with that
 * precision.
 */
static void load_texel(const struct gls_level *l, const struct gls_format *f, const uint8_t *texel,
                       struct gls_packed_color *color)
{
	const int is_grey = l->base_format == GL_LUMINANCE || l->base_format == GL_LUMINANCE_ALPHA ||
	                    l->base_format == GL_INTENSITY;

	color->is_texel = 1;
	color->bytes = l->texel_bytes == 4;
	gls_texel_load(l->texel_bytes, texel, color->rgba);
	for (unsigned i = 0; i < 4; i++)
		if (f->bits[i]) {
			color->rgba[i] = (float)(texel[i] >> (8 - f->bits[i])) / (float)((1u << f->bits[i]) - 1);
			color->bytes = 0;
		}
	if (is_grey)
		color->rgba[1] = color->rgba[2] = 0;
	if (l->base_format == GL_INTENSITY)
		color->rgba[3] = 1;
}

static void pack_texels(const struct reading *r, const struct gls_level *l)
{
	const struct gls_format *f = gls_format_find(l->internal_format);
	const uint8_t *texel = l->texels, *stencil = gls_level_stencil(l);
	struct gls_packed_color color;
	float depth;

	for (uint32_t z = 0; z < l->depth; z++)
		for (uint32_t y = 0; y < l->height; y++)
			for (uint32_t x = 0; x < l->width; x++, texel += l->texel_bytes) {
				uint8_t *to = r->buffer->data + gls_packing_at(&r->to, x, y, z);

				if (l->base_format == GL_DEPTH_COMPONENT) {
					memcpy(&depth, texel, 4);
					gls_pack_depth(&r->to, depth, (uint32_t)rint((double)(depth > 0 ? depth < 1 ? depth : 1 : 0) * 16777215),
					               r->to.format == GL_DEPTH_STENCIL ? 24 : 0, stencil ? *stencil++ : 0, to);
				} else {
					load_texel(l, f, texel, &color);
					gls_pack_color(&r->to, &color, to);
				}
			}
}

GLS_HANDLER(glGetTexImage, OBJECT)
{
	unsigned face;
	struct gls_texture *t;
	struct gls_level *l;
	struct reading r;
	uint32_t size[3];

	if (!st->client.pack.buffer)
		return;
	if (!x->want && st->draw_framebuffer)
		gls_framebuffer_skip(x, st); /* its pixels are not available */
	t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	l = t ? &t->levels[face][arg_i(c, 1)] : NULL;
	if (!l || !l->texels)
		return;
	size[0] = l->width;
	size[1] = l->height;
	size[2] = t->target == GLS_TEXTURE_3D || t->target == GLS_TEXTURE_2D_ARRAY ? l->depth : 0;
	if (!find_place(x, st, c, 4, size, &r))
		return;
	if (gls_refuses(x, st, !r.to.colors || (r.to.colors->to[0] == 5) != (l->base_format == GL_DEPTH_COMPONENT) ||
	                       (r.to.format == GL_DEPTH_STENCIL && !gls_level_stencil(l)), GL_INVALID_OPERATION))
		return;
	if (l->missing && x->want && x->feedback.supply)
		gls_rewind(x, "a texture has what they drew");
	pack_texels(&r, l);
	wrote(x, &r, size, !l->missing);
	if (l->missing) {
		gls_buffer_lose(x, r.buffer, (size_t)r.to.start, (size_t)r.to.end, l->missing);
		x->feedback.missing = 1;
	}
}

/* ---- unsupported reads ---- */

static void into_buffer(struct gls_exec *x, const struct gls_state *st, const char *what)
{
	if (st->client.pack.buffer)
		gls_unsupported(x, what);
}

/* Compressed images are stored as texels only. */
GLS_HANDLER(glGetCompressedTexImage, NOW) { into_buffer(x, st, "compressed images read into a buffer object"); }
GLS_HANDLER(glGetPolygonStipple, NOW) { into_buffer(x, st, "stipples read into a buffer object"); }
GLS_FAMILY(glGetPixelMap, NOW) { into_buffer(x, st, "pixel maps read into a buffer object"); }
