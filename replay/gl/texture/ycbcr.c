#include "replay/gl/texture/ycbcr.h"

#include <string.h>

static uint8_t limited(int v)
{
	return (uint8_t)(v < 0 ? 0 : v > 255 ? 255 : v);
}

int gls_ycbcr_texel(const uint8_t *row, size_t n, uint32_t x, unsigned low, uint8_t out[4])
{
	const size_t at = 4 * (size_t)(x / 2);
	int y, cb, cr;

	if (at + 4 > n) {
		memset(out, 0, 4);
		return -2;
	}
	y = 298 * (row[at + 2 * (x & 1) + low] - 16);
	cb = row[at + !low] - 128;
	cr = row[at + 2 + !low] - 128;
	out[0] = limited((y + 409 * cr + 128) >> 8);
	out[1] = limited((y - 100 * cb - 208 * cr + 128) >> 8);
	out[2] = limited((y + 516 * cb + 128) >> 8);
	out[3] = 255;
	return 0;
}
