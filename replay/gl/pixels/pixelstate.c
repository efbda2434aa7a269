/* Pixel storage modes, pixel transfer, pixel maps and PixelZoom (GL 2.1 sec. 3.6.1, 3.6.3, 3.6.4). */
#include <stddef.h>
#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/texture/unpack.h"
#include "replay/machine/args.h"
#include "replay/machine/buffer.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

/* ---- storage, sec. 3.6.1 ---- */

/*
 * The largest value of a storage mode. GL has no such limit; here it keeps offsets computed from the modes within 64
 * bits (replay/gl/texture/unpack.c).
 */
enum { MOST_STORED = 1 << 24 };

GLS_FAMILY(glPixelStore, CLIENT)
{
#define AT(field) offsetof(struct gls_pixel_store, field)
	static const struct { uint32_t pack, unpack; size_t place; } modes[] = {
		{ GL_PACK_SWAP_BYTES, GL_UNPACK_SWAP_BYTES, AT(swap_bytes) },
		{ GL_PACK_LSB_FIRST, GL_UNPACK_LSB_FIRST, AT(lsb_first) },
		{ GL_PACK_ROW_LENGTH, GL_UNPACK_ROW_LENGTH, AT(row_length) },
		{ GL_PACK_SKIP_ROWS, GL_UNPACK_SKIP_ROWS, AT(skip_rows) },
		{ GL_PACK_SKIP_PIXELS, GL_UNPACK_SKIP_PIXELS, AT(skip_pixels) },
		{ GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT, AT(alignment) },
		{ GL_PACK_IMAGE_HEIGHT, GL_UNPACK_IMAGE_HEIGHT, AT(image_height) },
		{ GL_PACK_SKIP_IMAGES, GL_UNPACK_SKIP_IMAGES, AT(skip_images) },
	};
	uint32_t name = arg_u(c, 0);
	int64_t value = arg_i(c, 1);

	if (gls_refuses(x, st, value < 0 || value > MOST_STORED, GL_INVALID_VALUE))
		return;
	for (size_t i = 0; i < sizeof(modes) / sizeof(modes[0]); i++) {
		struct gls_pixel_store *s = name == modes[i].pack ? &st->client.pack : &st->client.unpack;
		int boolean = modes[i].place == AT(swap_bytes) || modes[i].place == AT(lsb_first);
		int32_t word = boolean ? value != 0 : (int32_t)value;

		if (name != modes[i].pack && name != modes[i].unpack)
			continue;
		if (modes[i].place == AT(alignment) && value != 1 && value != 2 && value != 4 && value != 8)
			gls_error(x, st, GL_INVALID_VALUE);
		else
			memcpy((uint8_t *)s + modes[i].place, &word, sizeof(word));
		return;
	}
	gls_error(x, st, GL_INVALID_ENUM);
#undef AT
}

/* ---- pixel transfer, sec. 3.6.3 ---- */

GLS_FAMILY(glPixelTransfer, STATE)
{
#define AT(field) offsetof(struct gls_pixel, field)
	static const struct { uint32_t name; enum { FLOAT, INTEGER, BOOLEAN } kind; size_t place; } parameters[] = {
		{ GL_RED_SCALE, FLOAT, AT(scale[0]) }, { GL_RED_BIAS, FLOAT, AT(bias[0]) },
		{ GL_GREEN_SCALE, FLOAT, AT(scale[1]) }, { GL_GREEN_BIAS, FLOAT, AT(bias[1]) },
		{ GL_BLUE_SCALE, FLOAT, AT(scale[2]) }, { GL_BLUE_BIAS, FLOAT, AT(bias[2]) },
		{ GL_ALPHA_SCALE, FLOAT, AT(scale[3]) }, { GL_ALPHA_BIAS, FLOAT, AT(bias[3]) },
		{ GL_DEPTH_SCALE, FLOAT, AT(depth_scale) }, { GL_DEPTH_BIAS, FLOAT, AT(depth_bias) },
		{ GL_INDEX_SHIFT, INTEGER, AT(index_shift) }, { GL_INDEX_OFFSET, INTEGER, AT(index_offset) },
		{ GL_MAP_COLOR, BOOLEAN, AT(map_color) }, { GL_MAP_STENCIL, BOOLEAN, AT(map_stencil) },
	};
#undef AT
	float value = arg_f(c, 1);

	for (size_t i = 0; i < sizeof(parameters) / sizeof(parameters[0]); i++) {
		int32_t word = parameters[i].kind == BOOLEAN ? value != 0 : (int32_t)arg_i(c, 1);

		if (parameters[i].name != arg_u(c, 0))
			continue;
		memcpy((uint8_t *)&st->a.pixel + parameters[i].place,
		       parameters[i].kind == FLOAT ? (const void *)&value : &word, sizeof(word));
		return;
	}
	gls_error(x, st, GL_INVALID_ENUM);
}

GLS_HANDLER(glPixelZoom, STATE)
{
	st->a.pixel.zoom[0] = arg_f(c, 0);
	st->a.pixel.zoom[1] = arg_f(c, 1);
}

/* ---- pixel maps, sec. 3.6.3 ---- */

/*
 * Read the values of a pixel map that are stored as bytes: in the bound unpack buffer, or in a blob of the recording.
 * Integers are not normalized yet.
 * @return 0, or -1: there are too few bytes
 */
static int read_from_bytes(struct gls_state *st, const struct call *c, uint32_t size, enum gls_suffix_type type,
                           float *out)
{
	size_t n, bytes = type == GLS_SUFFIX_US ? 2 : 4;
	const uint8_t *data = gls_pixel_source(st, c, 2, &n);
	uint32_t value;

	if (!data || n < size * bytes)
		return -1;
	for (uint32_t i = 0; i < size; i++) {
		value = 0;
		memcpy(&value, data + i * bytes, bytes);
		if (type == GLS_SUFFIX_F)
			memcpy(&out[i], &value, 4);
		else
			out[i] = (float)value;
	}
	return 0;
}

GLS_FAMILY(glPixelMap, STATE)
{
	const enum gls_suffix_type type = gls_commands[x->command].suffix.type;
	uint32_t which = arg_u(c, 0) - GL_PIXEL_MAP_I_TO_I, size = arg_u(c, 1);
	struct gls_pixel_map *m = &st->pixel_maps[which < N_GLS_PIXEL_MAPS ? which : 0];
	int from_index = which < 6; /* I_TO_I, S_TO_S and I_TO_R .. I_TO_A map indices: their size is a power of two */
	int to_index = which < 2; /* I_TO_I and S_TO_S map to indices, the others to colours */
	const uint32_t buffer = gls_client_store(x, st)->buffer;
	int in_bytes, is_missing;

	if (gls_refuses(x, st, which >= N_GLS_PIXEL_MAPS, GL_INVALID_ENUM))
		return;
	if (gls_refuses(x, st, !size || size > GLS_MAX_PIXEL_MAP || (from_index && size & (size - 1)), GL_INVALID_VALUE))
		return;
	memset(m, 0, sizeof(*m));
	m->size = size;
	if (buffer)
		gls_buffer_keep(x, gls_buffer_find(st, buffer));
	in_bytes = buffer || arg(c, 2)->type == TRACE_BLOB;
	is_missing = in_bytes ? read_from_bytes(st, c, size, type, m->values) != 0 : arg_floats(c, 2, m->values, size) < size;
	if (is_missing)
		gls_unsupported(x, "pixel maps that are not in the recording");
	for (uint32_t i = 0; i < size && !to_index && type != GLS_SUFFIX_F; i++)
		m->values[i] /= type == GLS_SUFFIX_US ? 65535.0f : 4294967295.0f;
}
