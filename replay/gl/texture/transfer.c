/* Pixel transfer. */
#include "replay/gl/texture/transfer.h"

#include "gl_tokens.h"
#include "replay/machine/args.h"
#include "replay/machine/state.h"

/*
 * The entry of a map for a number in [0,1]. For pixels that are drawn, Mesa stores maps as textures of 256 texels
 * (where blue and alpha are undefined).
 */
static uint32_t entry_of(const struct gls_pixel_map *m, float v, int as_texture)
{
	uint32_t texel = v < 1 ? (uint32_t)(v * 256) : 255;

	return as_texture ? texel * m->size / 256 : (uint32_t)(v * (float)(m->size - 1) + 0.5f);
}

void gls_transfer_color(const struct gls_state *st, int is_drawn, float rgba[4])
{
	const struct gls_pixel *p = &st->a.pixel;
	const int as_texture = is_drawn && gls_is_mesa(st);

	for (unsigned i = 0; i < 4; i++) {
		const struct gls_pixel_map *m = &st->pixel_maps[GL_PIXEL_MAP_R_TO_R - GL_PIXEL_MAP_I_TO_I + i];

		rgba[i] = rgba[i] * p->scale[i] + p->bias[i];
		if (p->map_color) {
			float v = rgba[i] > 0 ? rgba[i] < 1 ? rgba[i] : 1 : 0;
			rgba[i] = m->size ? m->values[entry_of(m, v, as_texture)] : 0;
		}
	}
}

int gls_transfer_changes_colors(const struct gls_state *st)
{
	const struct gls_pixel *p = &st->a.pixel;

	for (unsigned i = 0; i < 4; i++)
		if (p->scale[i] != 1 || p->bias[i] != 0)
			return 1;
	return p->map_color != 0;
}

float gls_transfer_depth(const struct gls_state *st, float depth)
{
	float v = st ? depth * st->a.pixel.depth_scale + st->a.pixel.depth_bias : depth;

	return v > 0 ? v < 1 ? v : 1 : 0;
}

uint32_t gls_transfer_index(const struct gls_state *st, uint32_t index)
{
	int32_t shift = st->a.pixel.index_shift;

	return (shift >= 0 ? index << (shift & 31) : index >> (-shift & 31)) + (uint32_t)st->a.pixel.index_offset;
}

static uint8_t map_index(const struct gls_pixel_map *m, uint32_t index)
{
	float v = m->size ? m->values[index & (m->size - 1)] : 0;

	return (uint8_t)(v > 0 ? v < 1 ? v * 255 + 0.5f : 255 : 0);
}

void gls_transfer_color_index(const struct gls_state *st, uint32_t index, uint8_t rgba[4])
{
	for (unsigned i = 0; i < 4; i++)
		rgba[i] = map_index(&st->pixel_maps[GL_PIXEL_MAP_I_TO_R - GL_PIXEL_MAP_I_TO_I + i], index);
}

uint32_t gls_transfer_stencil(const struct gls_state *st, uint32_t value)
{
	const struct gls_pixel_map *m = &st->pixel_maps[GL_PIXEL_MAP_S_TO_S - GL_PIXEL_MAP_I_TO_I];

	return st->a.pixel.map_stencil && m->size ? token_of_float(m->values[value & (m->size - 1)]) : value;
}
