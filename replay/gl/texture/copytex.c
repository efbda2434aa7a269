/* Textures out of the screen (GL 2.1 sec. 3.8.2): CopyTexImage, CopyTexSubImage. */
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/trace.h"
#include "replay/gl/surface/feedback.h"
#include "replay/gl/texture/teximage.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"

/* Rows of a picture into texels of a level, through pixel transfer (sec. 4.3.2, 3.6.5). Places off the screen stay. */
static void copy_pixels(const struct gls_state *st, const struct scene_picture *p, int64_t x0, int64_t y0, int64_t width,
                        int64_t height, struct gls_level *l, size_t at)
{
	float far = (float)((1u << p->depth_bits) - 1);

	for (int64_t y = 0; y < height; y++)
		for (int64_t x = 0; x < width; x++) {
			size_t from = (size_t)((y0 + y) * p->width + x0 + x);
			uint8_t *texel = l->texels + l->texel_bytes * (at + (size_t)y * l->width + (size_t)x);
			float v[4];

			if (x0 + x < 0 || y0 + y < 0 || x0 + x >= p->width || y0 + y >= p->height)
				continue;
			if (l->base_format == GL_DEPTH_COMPONENT) {
				v[0] = (far > 0 ? (float)p->depth[from] / far : 0) * st->a.pixel.depth_scale + st->a.pixel.depth_bias;
				v[0] = v[0] > 0 ? v[0] < 1 ? v[0] : 1 : 0;
				memcpy(texel, v, 4);
				if (gls_level_stencil(l))
					gls_level_stencil(l)[(size_t)(texel - l->texels) / l->texel_bytes] = p->stencil[from];
				continue;
			}
			gls_picture_color(p, from, v);
			gls_store_pixel(st, l->internal_format, v, texel);
		}
}

/* Copy a rectangle of the screen to a place in a level; without pixels the level is missing from now on. */
static void copy(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, unsigned face, int64_t level,
                 const int64_t from[2], const int64_t size[2], const int64_t to[3])
{
	const struct scene_picture *p = gls_read_screen(x, st);
	struct gls_level *l = &t->levels[face][level];

	if (p)
		copy_pixels(st, p, from[0], from[1], size[0], size[1], l,
		            (size_t)((to[2] * l->height + to[1]) * l->width + to[0]));
	else if (!x->want || !x->feedback.supply) {
		l->missing = (uint32_t)x->frame + 1;
		x->feedback.missing = 1;
	}
	gls_texture_changed(t);
	if (p && to[0] == 0 && to[1] == 0 && size[0] == l->width && size[1] == l->height && l->depth == 1)
		l->missing = 0;
	if (t->parameters.generate_mipmap && level == (int64_t)t->parameters.base_level)
		gls_texture_generate_mipmaps(x, t, face);
}

static void copy_tex_image(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n_dims)
{
	unsigned face;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	const int64_t from[2] = { arg_i32(c, 3), arg_i32(c, 4) }, zero[3] = { 0 };
	struct gls_level *l;

	if (!t)
		return;
	l = gls_texture_specify(x, st, t, face, arg_i(c, 1), arg_u(c, 2), arg_i(c, 5), n_dims > 1 ? arg_i(c, 6) : 1, 1,
	                        arg_i(c, n_dims > 1 ? 7 : 6));
	if (l) /* the border is read, too: the given corner is its corner */
		copy(x, st, t, face, arg_i(c, 1), from, (int64_t[2]){ l->width, l->height }, zero);
}

static void copy_tex_sub_image(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n_dims)
{
	unsigned face, after = 2 + n_dims; /* place; then the corner on the screen and the size */
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	struct gls_level *l = t ? &t->levels[face][arg_i(c, 1)] : NULL;
	int64_t to[3] = { 0 }, size[2] = { arg_i32(c, after + 2), n_dims > 1 ? arg_i32(c, after + 3) : 1 };
	const int64_t from[2] = { arg_i32(c, after), arg_i32(c, after + 1) };

	if (!l)
		return;
	if (!l->texels) {
		gls_error(x, st, GL_INVALID_OPERATION);
		return;
	}
	for (unsigned i = 0; i < n_dims; i++)
		to[i] = arg_i32(c, 2 + i) + l->border;
	if (to[0] < 0 || to[1] < 0 || to[2] < 0 || size[0] < 0 || size[1] < 0 || to[0] > l->width || to[1] > l->height ||
	    to[2] >= l->depth || size[0] > l->width - to[0] || size[1] > l->height - to[1]) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	copy(x, st, t, face, arg_i(c, 1), from, size, to);
}

GLS_HANDLER(glCopyTexImage1D, STATE) { copy_tex_image(x, st, c, 1); }
GLS_HANDLER(glCopyTexImage2D, STATE) { copy_tex_image(x, st, c, 2); }
GLS_HANDLER(glCopyTexSubImage1D, STATE) { copy_tex_sub_image(x, st, c, 1); }
GLS_HANDLER(glCopyTexSubImage2D, STATE) { copy_tex_sub_image(x, st, c, 2); }
GLS_HANDLER(glCopyTexSubImage3D, STATE) { copy_tex_sub_image(x, st, c, 3); }
