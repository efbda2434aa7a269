/* Pixel storage modes, pixel transfer and pixel maps (GL 2.1 sec. 3.6.1, 3.6.3). */
#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/texture/unpack.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/state.h"

/* ---- storage, sec. 3.6.1 ---- */

static void pixel_store(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	int64_t value = arg_i(c, 1);
	uint32_t pname = arg_u(c, 0);
	struct gls_pixel_store *s = pname >= GL_PACK_SWAP_BYTES && pname <= GL_PACK_ALIGNMENT ? &st->client.pack
	                                                                                     : &st->client.unpack;

	if (value < 0 || value > (1 << 24)) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	switch (pname) {
	case GL_PACK_SWAP_BYTES:
	case GL_UNPACK_SWAP_BYTES:
		s->swap_bytes = value != 0;
		break;
	case GL_PACK_LSB_FIRST:
	case GL_UNPACK_LSB_FIRST:
		s->lsb_first = value != 0;
		break;
	case GL_PACK_ROW_LENGTH:
	case GL_UNPACK_ROW_LENGTH:
		s->row_length = (int32_t)value;
		break;
	case GL_PACK_SKIP_ROWS:
	case GL_UNPACK_SKIP_ROWS:
		s->skip_rows = (int32_t)value;
		break;
	case GL_PACK_SKIP_PIXELS:
	case GL_UNPACK_SKIP_PIXELS:
		s->skip_pixels = (int32_t)value;
		break;
	case GL_PACK_ALIGNMENT:
	case GL_UNPACK_ALIGNMENT:
		if (value != 1 && value != 2 && value != 4 && value != 8)
			gls_error(x, st, GL_INVALID_VALUE);
		else
			s->alignment = (int32_t)value;
		break;
	case GL_UNPACK_IMAGE_HEIGHT:
		st->client.unpack.image_height = (int32_t)value;
		break;
	case GL_UNPACK_SKIP_IMAGES:
		st->client.unpack.skip_images = (int32_t)value;
		break;
	case GL_PACK_IMAGE_HEIGHT:
		st->client.pack.image_height = (int32_t)value;
		break;
	case GL_PACK_SKIP_IMAGES:
		st->client.pack.skip_images = (int32_t)value;
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

GLS_HANDLER(glPixelStorei, CLIENT) { pixel_store(x, st, c); }
GLS_HANDLER(glPixelStoref, CLIENT) { pixel_store(x, st, c); }

/* ---- pixel transfer, sec. 3.6.3 ---- */

static void set_transfer(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	struct gls_pixel *p = &st->a.pixel;
	float value = arg_f(c, 1);

	switch (arg_u(c, 0)) {
	case GL_RED_SCALE:
		p->scale[0] = value;
		break;
	case GL_GREEN_SCALE:
		p->scale[1] = value;
		break;
	case GL_BLUE_SCALE:
		p->scale[2] = value;
		break;
	case GL_ALPHA_SCALE:
		p->scale[3] = value;
		break;
	case GL_RED_BIAS:
		p->bias[0] = value;
		break;
	case GL_GREEN_BIAS:
		p->bias[1] = value;
		break;
	case GL_BLUE_BIAS:
		p->bias[2] = value;
		break;
	case GL_ALPHA_BIAS:
		p->bias[3] = value;
		break;
	case GL_DEPTH_SCALE:
		p->depth_scale = value;
		break;
	case GL_DEPTH_BIAS:
		p->depth_bias = value;
		break;
	case GL_MAP_COLOR:
		p->map_color = value != 0;
		break;
	case GL_MAP_STENCIL:
		p->map_stencil = value != 0;
		break;
	case GL_INDEX_SHIFT:
		p->index_shift = (int32_t)arg_i(c, 1);
		break;
	case GL_INDEX_OFFSET:
		p->index_offset = (int32_t)arg_i(c, 1);
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

GLS_HANDLER(glPixelTransferf, STATE) { set_transfer(x, st, c); }
GLS_HANDLER(glPixelTransferi, STATE) { set_transfer(x, st, c); }
GLS_HANDLER(glPixelZoom, STATE)
{
	st->a.pixel.zoom[0] = arg_f(c, 0);
	st->a.pixel.zoom[1] = arg_f(c, 1);
}

/* ---- pixel maps, sec. 3.6.3 ---- */

/* Numbers in the bound unpack buffer. @return 0, or -1: it is too small */
static int buffered(struct gls_state *st, const struct call *c, uint32_t size, uint32_t type, float *out)
{
	size_t n, bytes = type == GL_UNSIGNED_SHORT ? 2 : 4;
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
