#include "replay/gl/texture/palette.h"

#include <string.h>

#include "gl_tokens.h"

int gls_palette_of(uint32_t internal_format, struct gls_palette *out)
{
	/* In the order of the tokens: first those with 4-bit indices, then those with 8 bits. */
	static const struct { uint32_t format, type; size_t bytes; } kinds[] = {
		{ GL_RGB, GL_UNSIGNED_BYTE, 3 }, { GL_RGBA, GL_UNSIGNED_BYTE, 4 }, { GL_RGB, GL_UNSIGNED_SHORT_5_6_5, 2 },
		{ GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4, 2 }, { GL_RGBA, GL_UNSIGNED_SHORT_5_5_5_1, 2 },
	};
	const uint32_t number = internal_format - GL_PALETTE4_RGB8_OES, kind = number % 5;

	if (number >= 10)
		return 0;
	out->internal_format = out->format = kinds[kind].format;
	out->type = kinds[kind].type;
	out->entry_bytes = kinds[kind].bytes;
	out->index_bits = number < 5 ? 4 : 8;
	out->entries = (size_t)1 << out->index_bits;
	return 1;
}

int gls_palette_expand(const struct gls_palette *p, const uint8_t *data, size_t n, size_t first, size_t count,
                       uint8_t *out)
{
	const size_t palette = p->entries * p->entry_bytes, begin = first * p->index_bits / 8,
		     bytes = (count * p->index_bits + 7) / 8;

	if (palette > n || begin > n - palette || bytes > n - palette - begin)
		return -1;
	for (size_t i = 0; i < count; i++) {
		const uint8_t *at = data + palette + begin + i * p->index_bits / 8;
		const size_t entry = p->index_bits == 8 ? *at : i % 2 ? *at & 15 : *at >> 4; /* the left texel is the high half */

		memcpy(out + i * p->entry_bytes, data + entry * p->entry_bytes, p->entry_bytes);
	}
	return 0;
}
