/* Pixels drawn as pixels (GL 2.1 sec. 3.6, 3.7, 4.3.3): Bitmap, DrawPixels, CopyPixels. */
#include "replay/gl/surface/pixels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/trace.h"
#include "replay/build/frame.h"
#include "replay/gl/surface/feedback.h"
#include "replay/gl/texture/teximage.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"

#define MAX_SIDE 16384

/* ---- reading bits and indices ---- */

/* A bit of a bitmap in client memory (sec. 3.7), rows and the first bit as the unpack state says. */
static int bit_at(const struct gls_pixel_store *u, const uint8_t *data, size_t n, uint32_t width, uint32_t x, uint32_t y)
{
	size_t groups = u->row_length > 0 ? (size_t)u->row_length : width, align = (size_t)u->alignment;
	size_t row = (((groups + 7) / 8) + align - 1) / align * align;
	size_t bit = (size_t)u->skip_pixels + x, at = ((size_t)u->skip_rows + y) * row + bit / 8;

	return at < n && data[at] >> (u->lsb_first ? bit & 7 : 7 - (bit & 7)) & 1;
}

static size_t index_bytes(uint32_t type)
{
	switch (type) {
	case GL_UNSIGNED_BYTE:
	case GL_BYTE:
		return 1;
	case GL_UNSIGNED_SHORT:
	case GL_SHORT:
		return 2;
	case GL_UNSIGNED_INT:
	case GL_INT:
	case GL_FLOAT:
		return 4;
	default:
		return 0;
	}
}

/* A colour or stencil index, shifted and offset (sec. 3.6.5). */
static uint32_t index_at(const struct gls_state *st, uint32_t type, const uint8_t *data, size_t n, uint32_t width, uint32_t x,
                         uint32_t y)
{
	const struct gls_pixel_store *u = &st->client.unpack;
	const struct gls_pixel *p = &st->a.pixel;
	size_t size = index_bytes(type), align = (size_t)u->alignment, at;
	size_t row = ((u->row_length > 0 ? (size_t)u->row_length : width) * size + align - 1) / align * align;
	uint32_t value = 0;
	float f;

	if (type == GL_BITMAP) {
		value = (uint32_t)bit_at(u, data, n, width, x, y);
	} else {
		at = ((size_t)u->skip_rows + y) * row + ((size_t)u->skip_pixels + x) * size;
		for (size_t i = 0; i < size && at + size <= n; i++)
			value |= (uint32_t)data[at + (u->swap_bytes ? size - 1 - i : i)] << (8 * i);
		if (type == GL_FLOAT) {
			memcpy(&f, &value, 4);
			value = token_of_float(f);
		}
	}
	value = p->index_shift >= 0 ? value << (p->index_shift & 31) : value >> (-p->index_shift & 31);
	return value + (uint32_t)p->index_offset;
}

static uint8_t mapped(const struct gls_pixel_map *m, uint32_t index)
{
	float v = m->size ? m->values[index & (m->size - 1)] : 0;

	return (uint8_t)(v > 0 ? v < 1 ? v * 255 + 0.5f : 255 : 0);
}

/* ---- drawing ---- */

/*
 * A rectangle of pixels as fragments (sec. 3.6.4): the raster position's colours, texture coordinates and distance; what
 * else fragments go through is the state's. x, y: window coordinates of its first pixel's outer corner.
 */
void gls_draw_rectangle(struct gls_exec *x, struct gls_state *st, uint32_t kind, float left, float low, uint32_t width,
                        uint32_t height, const float zoom[2], const uint8_t *texels)
{
	struct gls_attribs saved = st->a;
	struct gls_texture_image *image;
	struct scene_rectangle r = { .kind = kind, .width = width, .height = height, .zoom = { zoom[0], zoom[1] } };
	float values[N_GLS_ATTRIBUTES][4];

	if (!gls_is_drawn(x, st) || !width || !height)
		return;
	image = gls_texture_image_find(x, width, height, kind == SCENE_FLOAT_PIXELS ? 16 : 4, texels);
	if (!image)
		return;
	memcpy(values, st->a.current.attribute, sizeof(values));
	memcpy(values[GLS_ATTR_COLOR], st->a.current.raster_color, 16);
	memcpy(values[GLS_ATTR_SECONDARY], st->a.current.raster_secondary, 16);
	memcpy(values[GLS_ATTR_TEXCOORD], st->a.current.raster_texcoord, sizeof(st->a.current.raster_texcoord));
	values[GLS_ATTR_FOG_COORD][0] = st->a.current.raster_distance;
	/* What a vertex would go through has been gone through. */
	st->a.fog.color_sum |= st->a.lighting.enabled && st->a.lighting.separate_specular;
	st->a.lighting.enabled = st->a.lighting.color_material = 0;
	st->a.lighting.shade_model = GL_SMOOTH;
	st->a.fog.coord_source = GL_FOG_COORD;
	st->a.transform.clip_plane_mask = 0;
	st->a.point.smooth = st->a.point.sprite = 0;
	st->a.multisample.enabled = 0; /* Mesa draws them to whole pixels */
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		st->a.texturing.units[u].gen_enabled = 0;
	gls_frame_add_rectangle(x, st, &r, image, (float[4]){ left, low, st->a.current.raster_position[2], 1 },
	                        (const float (*)[4])values);
	st->a = saved;
	st->dirty |= GLS_DIRTY_ALL;
	gls_texture_image_release(image);
}

void gls_draw_rectangle_plainly(struct gls_exec *x, struct gls_state *st, uint32_t kind, float left, float low, uint32_t width,
                                uint32_t height, const float zoom[2], const uint8_t *texels)
{
	struct gls_attribs saved = st->a;
	uint32_t mode = st->render_mode, discard = st->rasterizer_discard;

	st->render_mode = GL_RENDER; /* blits are no rendering: no mode holds them back */
	st->rasterizer_discard = 0;
	st->a.color.alpha_test = st->a.color.blend = st->a.color.logic_op_enabled = st->a.stencil.enabled = st->a.fog.enabled = 0;
	st->a.depth.enabled = st->a.depth.write = kind == SCENE_DEPTH_PIXELS;
	st->a.depth.func = GL_ALWAYS;
	st->a.stencil.side[0].write_mask = 255;
	if (kind != SCENE_COLOR_PIXELS && kind != SCENE_FLOAT_PIXELS)
		st->a.color.mask = 0;
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		st->a.texturing.units[u].enabled = 0;
	gls_draw_rectangle(x, st, kind, left, low, width, height, zoom, texels);
	st->a = saved;
	st->render_mode = mode;
	st->rasterizer_discard = discard;
	st->dirty = GLS_DIRTY_ALL;
}

GLS_HANDLER(glBitmap, STATE)
{
	uint32_t width = arg_u(c, 0), height = arg_u(c, 1);
	float *at = st->a.current.raster_position;
	size_t n;
	const uint8_t *data = gls_pixel_source(st, c, 6, &n);
	uint8_t *texels;

	if (arg_i(c, 0) < 0 || arg_i(c, 1) < 0) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	if (!st->a.current.raster_valid)
		return;
	if (data && width && height && width <= MAX_SIDE && height <= MAX_SIDE && x->want) {
		texels = gls_scratch(x, (size_t)width * height * 4);
		for (uint32_t i = 0; texels && i < width * height; i++)
			memset(texels + 4 * (size_t)i, bit_at(&st->client.unpack, data, n, width, i % width, i / width) ? 255 : 0, 4);
		/* the lower left corner goes to whole pixels, downwards; a little up as Mesa has it against rounding */
		if (texels)
			gls_draw_rectangle(x, st, SCENE_BITMAP, floorf(at[0] + 0.0001f - arg_f(c, 2)), floorf(at[1] + 0.0001f - arg_f(c, 3)), width,
			     height, (float[2]){ 1, 1 }, texels);
	}
	at[0] += arg_f(c, 4);
	at[1] += arg_f(c, 5);
}

int gls_unpack_indices(const struct gls_state *st, uint32_t format, uint32_t type, const uint8_t *data, size_t n, uint32_t width,
                       uint32_t height, uint8_t *texels)
{
	if (type != GL_BITMAP && !index_bytes(type))
		return -1;
	for (size_t i = 0; i < (size_t)width * height; i++, texels += 4) {
		uint32_t value = index_at(st, type, data, n, width, (uint32_t)(i % width), (uint32_t)(i / width));
		const struct gls_pixel_map *m = &st->pixel_maps[GL_PIXEL_MAP_S_TO_S - GL_PIXEL_MAP_I_TO_I];

		if (format == GL_STENCIL_INDEX) {
			if (st->a.pixel.map_stencil && m->size)
				value = token_of_float(m->values[value & (m->size - 1)]);
			memcpy(texels, &value, 4);
			continue;
		}
		for (unsigned k = 0; k < 4; k++)
			texels[k] = mapped(&st->pixel_maps[GL_PIXEL_MAP_I_TO_R - GL_PIXEL_MAP_I_TO_I + k], value);
	}
	return 0;
}

/* Depth and stencil values at once (EXT_packed_depth_stencil): written under their masks, whatever the tests and colours are. */
static void draw_depth_stencil(struct gls_exec *x, struct gls_state *st, const float *at, uint32_t width, uint32_t height,
                               uint8_t *texels, const uint8_t *stencil)
{
	struct gls_depth depth = st->a.depth;
	uint32_t mask = st->a.color.mask, tested = st->a.stencil.enabled, value;

	st->a.color.mask = 0;
	st->a.stencil.enabled = 0;
	st->a.depth.enabled = 1;
	st->a.depth.func = GL_ALWAYS;
	gls_draw_rectangle(x, st, SCENE_DEPTH_PIXELS, rintf(at[0]), rintf(at[1]), width, height, st->a.pixel.zoom, texels);
	st->a.depth = depth;
	st->a.color.mask = mask;
	st->a.stencil.enabled = tested;
	for (size_t i = 0; i < (size_t)width * height; i++) {
		value = stencil[i];
		memcpy(texels + 4 * i, &value, 4);
	}
	gls_draw_rectangle(x, st, SCENE_STENCIL_PIXELS, rintf(at[0]), rintf(at[1]), width, height, st->a.pixel.zoom, texels);
}

static uint32_t kind_of(uint32_t format)
{
	return format == GL_STENCIL_INDEX || format == GL_STENCIL ? SCENE_STENCIL_PIXELS :
	       format == GL_DEPTH_COMPONENT || format == GL_DEPTH ? SCENE_DEPTH_PIXELS : SCENE_COLOR_PIXELS;
}

GLS_HANDLER(glDrawPixels, STATE)
{
	uint32_t width = arg_u(c, 0), height = arg_u(c, 1), format = arg_u(c, 2), type = arg_u(c, 3);
	const float *at = st->a.current.raster_position;
	size_t n;
	const uint8_t *data = gls_pixel_source(st, c, 4, &n);
	uint8_t *texels;
	int indices = format == GL_COLOR_INDEX || format == GL_STENCIL_INDEX, rc;
	uint32_t kind = kind_of(format);

	if (arg_i(c, 0) < 0 || arg_i(c, 1) < 0) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	if (!st->a.current.raster_valid || !data || !width || !height || width > MAX_SIDE || height > MAX_SIDE || !x->want)
		return;
	if (kind == SCENE_COLOR_PIXELS && !indices)
		kind = gls_color_pixels(x, st);
	texels = gls_scratch(x, (size_t)width * height * (kind == SCENE_FLOAT_PIXELS ? 16 : 5));
	if (!texels)
		return;
	if (format == GL_DEPTH_STENCIL) {
		uint8_t *stencil = texels + 4 * (size_t)width * height;

		if (gls_unpack_pixels(x, st, format, type, width, height, 0, data, n, GL_DEPTH_COMPONENT, texels) == -1)
			return;
		gls_unpack_stencil(st, type, width, height, data, n, stencil);
		draw_depth_stencil(x, st, at, width, height, texels, stencil);
		return;
	}
	if (!indices || gls_unpack_indices(st, format, type, data, n, width, height, texels)) {
		rc = gls_unpack_pixels(x, st, format, type, width, height, 0, data, n,
		                       kind == SCENE_DEPTH_PIXELS ? GL_DEPTH_COMPONENT : kind == SCENE_FLOAT_PIXELS ? GL_RGBA32F : GL_RGBA,
		                       texels);
		if (rc == -2 && st->client.unpack.buffer) /* nor is anything drawn (sec. 4.3.1, ARB_pixel_buffer_object) */
			gls_error(x, st, GL_INVALID_OPERATION);
		if (rc == -1 || (rc == -2 && st->client.unpack.buffer))
			return;
	}
	gls_draw_rectangle(x, st, kind, rintf(at[0]), rintf(at[1]), width, height, st->a.pixel.zoom, texels);
}

/* A place of the screen as a texel of a copy; outside of it nothing is defined: 0. */
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
		value = p->stencil[from];
		value = st->a.pixel.index_shift >= 0 ? value << (st->a.pixel.index_shift & 31) :
		                                       value >> (-st->a.pixel.index_shift & 31);
		value += (uint32_t)st->a.pixel.index_offset;
		memcpy(texel, &value, 4);
		return;
	}
	if (kind == SCENE_DEPTH_PIXELS) {
		v[0] = (bits ? (float)p->depth[from] / (float)((1u << bits) - 1) : 0) * st->a.pixel.depth_scale +
		       st->a.pixel.depth_bias;
		v[0] = v[0] > 0 ? v[0] < 1 ? v[0] : 1 : 0;
		memcpy(texel, v, 4);
		return;
	}
	gls_picture_color(p, from, v);
	gls_store_pixel(st, kind == SCENE_FLOAT_PIXELS ? GL_RGBA32F : GL_RGBA, v, texel);
}

GLS_HANDLER(glCopyPixels, STATE)
{
	int64_t x0 = arg_i32(c, 0), y0 = arg_i32(c, 1);
	uint32_t width = arg_u(c, 2), height = arg_u(c, 3), kind = kind_of(arg_u(c, 4));
	const float *at = st->a.current.raster_position;
	const struct scene_picture *p;
	uint8_t *texels;
	size_t bytes;

	if (arg_i(c, 2) < 0 || arg_i(c, 3) < 0) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	if (!st->a.current.raster_valid || !width || !height || width > MAX_SIDE || height > MAX_SIDE || !x->want)
		return;
	if (kind == SCENE_COLOR_PIXELS)
		kind = gls_color_pixels(x, st);
	bytes = kind == SCENE_FLOAT_PIXELS ? 16 : 4;
	p = gls_read_screen(x, st);
	texels = p ? gls_scratch(x, (size_t)width * height * (bytes + 1)) : NULL;
	if (texels && arg_u(c, 4) == GL_DEPTH_STENCIL) {
		uint8_t *stencil = texels + 4 * (size_t)width * height, value[4];

		for (uint32_t i = 0; i < width * height; i++) {
			copy_texel(st, p, SCENE_DEPTH_PIXELS, x0 + i % width, y0 + i / width, texels + 4 * (size_t)i);
			copy_texel(st, p, SCENE_STENCIL_PIXELS, x0 + i % width, y0 + i / width, value);
			stencil[i] = value[0];
		}
		draw_depth_stencil(x, st, at, width, height, texels, stencil);
		return;
	}
	for (uint32_t i = 0; texels && i < width * height; i++)
		copy_texel(st, p, kind, x0 + i % width, y0 + i / width, texels + bytes * i);
	if (texels)
		gls_draw_rectangle(x, st, kind, rintf(at[0]), rintf(at[1]), width, height, st->a.pixel.zoom, texels);
}

/* ---- pixel maps, sec. 3.6.3 ---- */

/* Numbers in the bound unpack buffer. @return 0, or -1: it is too small */
static int buffered(struct gls_state *st, const struct call *c, uint32_t size, uint32_t type, float *out)
{
	size_t n, bytes = index_bytes(type);
	const uint8_t *data = gls_pixel_source(st, c, 2, &n);
	uint32_t value;

	if (!data || n < size * bytes)
		return -1;
	for (uint32_t i = 0; i < size; i++) {
		value = 0;
		memcpy(&value, data + i * bytes, bytes);
		if (type == GL_FLOAT)
			memcpy(&out[i], &value, 4);
		else
			out[i] = (float)value;
	}
	return 0;
}

static void pixel_map(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t type)
{
	uint32_t which = arg_u(c, 0) - GL_PIXEL_MAP_I_TO_I, size = arg_u(c, 1);
	struct gls_pixel_map *m = &st->pixel_maps[which < N_GLS_PIXEL_MAPS ? which : 0];
	int indices = which < 2; /* I_TO_I and S_TO_S hold indices, the rest colours */

	if (which >= N_GLS_PIXEL_MAPS) {
		gls_error(x, st, GL_INVALID_ENUM);
		return;
	}
	if (!size || size > GLS_MAX_PIXEL_MAP || (which < 6 && size & (size - 1))) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	memset(m, 0, sizeof(*m));
	m->size = size;
	if (st->client.unpack.buffer ? buffered(st, c, size, type, m->values) : arg_floats(c, 2, m->values, size) < size)
		gls_unsupported(x, "pixel maps beyond what the recording holds");
	for (uint32_t i = 0; i < size && !indices && type != GL_FLOAT; i++)
		m->values[i] /= type == GL_UNSIGNED_SHORT ? 65535.0f : 4294967295.0f;
}

GLS_HANDLER(glPixelMapfv, STATE) { pixel_map(x, st, c, GL_FLOAT); }
GLS_HANDLER(glPixelMapuiv, STATE) { pixel_map(x, st, c, GL_UNSIGNED_INT); }
GLS_HANDLER(glPixelMapusv, STATE) { pixel_map(x, st, c, GL_UNSIGNED_SHORT); }
