/* Copies from the screen to textures (GL 2.1 sec. 3.8.2): CopyTexImage, CopyTexSubImage. */
#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/pixels/teximage.h"
#include "replay/gl/surface/screen.h"
#include "replay/gl/texture/legal.h"
#include "replay/gl/texture/level.h"
#include "replay/gl/texture/mipmap.h"
#include "replay/gl/texture/texcompress.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/texture.h"
#include "replay/gl/texture/transfer.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/picture.h"

/* A rectangle of the screen, and its destination in a level. */
struct copy {
	int64_t from[2], size[2], to[3];
};

/*
 * Convert pixels to texels through pixel transfer (sec. 4.3.2, 3.6.5). Texels for places off the screen are unchanged.
 */
static void copy_pixels(const struct gls_state *st, const struct scene_picture *p, const struct copy *c,
                        struct gls_level *l)
{
	const struct gls_format *format = gls_format_find(l->internal_format);
	uint8_t *stencil = gls_level_stencil(l);
	float far = (float)((1u << p->depth_bits) - 1), v[4];

	for (int64_t y = 0; y < c->size[1]; y++)
		for (int64_t x = 0; x < c->size[0]; x++) {
			int64_t px = c->from[0] + x, py = c->from[1] + y;
			size_t from = (size_t)(py * p->width + px);
			size_t to = (size_t)((c->to[2] * l->height + c->to[1] + y) * l->width + c->to[0] + x);
			uint8_t *texel = l->texels + l->texel_bytes * to;

			if (px < 0 || py < 0 || px >= p->width || py >= p->height)
				continue;
			if (l->base_format != GL_DEPTH_COMPONENT) {
				gls_picture_color(p, from, v);
				gls_transfer_color(st, 0, v);
				gls_format_store(format, v, 0, texel);
				continue;
			}
			v[0] = gls_transfer_depth(st, far > 0 ? (float)p->depth[from] / far : 0);
			memcpy(texel, v, 4);
			if (stencil)
				stencil[to] = p->stencil[from];
		}
	if (format && format->s3tc)
		gls_recompress(format, (uint32_t)c->size[0], (uint32_t)c->size[1], l->width,
		               l->texels + l->texel_bytes * (size_t)((c->to[2] * l->height + c->to[1]) * l->width + c->to[0]));
}

/* Extend a part (x, y, width, height) to include the destination of a copy. */
static void unite(uint32_t part[4], const struct copy *c, int is_first)
{
	for (int k = 0; k < 2; k++) {
		int64_t from = c->to[k], to = from + c->size[k];

		if (!is_first) {
			from = part[k] < from ? part[k] : from;
			to = (int64_t)part[k] + part[k + 2] > to ? (int64_t)part[k] + part[k + 2] : to;
		}
		part[k] = (uint32_t)from;
		part[k + 2] = (uint32_t)(to - from);
	}
}

/* Mark the destination of a copy as missing, in a level of one layer. */
static void lose_part(struct gls_level *l, const struct copy *c, uint32_t missing)
{
	int is_first = !l->missing;

	if (l->depth != 1 || (!is_first && !l->missing_part[2])) {
		gls_level_lose(l, missing);
		return;
	}
	unite(l->missing_part, c, is_first);
	l->missing = missing;
}

/* 1 if a copy overwrites everything that is missing. */
static int fills_missing(const struct gls_level *l, const struct copy *c)
{
	uint32_t all[4] = { 0, 0, l->width, l->height };
	const uint32_t *part = l->missing_part[2] ? l->missing_part : all;

	return l->depth == 1 && c->to[0] <= part[0] && c->to[1] <= part[1] &&
	       c->to[0] + c->size[0] >= (int64_t)part[0] + part[2] &&
	       c->to[1] + c->size[1] >= (int64_t)part[1] + part[3];
}

/* Copy to a level. If the pixels are not available, the level is missing from now on. */
static void copy_screen(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, unsigned face, int64_t level,
                        const struct copy *c)
{
	struct gls_level *l = &t->levels[face][level];
	const struct gls_area area = { { (int32_t)c->from[0], (int32_t)c->from[1], (int32_t)c->size[0], (int32_t)c->size[1] },
		                       l->base_format == GL_DEPTH_COMPONENT ? gls_level_stencil(l) ? 6u : 2u : 1u };
	const struct scene_picture *p = gls_read_screen(x, st, &area);

	if (p) {
		copy_pixels(st, p, c, l);
	} else if (!x->want || !x->feedback.supply) {
		lose_part(l, c, (uint32_t)x->frame + 1);
		x->feedback.missing = 1;
	}
	gls_texture_changed(t);
	if (p && fills_missing(l, c))
		gls_level_lose(l, 0);
	gls_texture_level_changed(x, t, face, level);
}

GLS_FAMILY(glCopyTexImage, STATE)
{
	unsigned face, n_dims = gls_commands[x->command].suffix.n;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	const struct gls_level_form form = { arg_u(c, 2), arg_i(c, 5), n_dims > 1 ? arg_i(c, 6) : 1, 1,
		                             arg_i(c, n_dims > 1 ? 7 : 6) };
	const uint32_t wrong = gls_image_error(arg_u(c, 0), form.internal_format, arg_i(c, 1),
	                                       (int64_t[2]){ form.width, form.height }, form.border, st->mesa);
	struct gls_level *l;

	/* Numbers of components are valid for TexImage only. */
	if (!t ||
	    gls_refuses(x, st,
	                !gls_takes_target(n_dims, arg_u(c, 0)) ||
	                        (form.internal_format >= 1 && form.internal_format <= 4),
	                GL_INVALID_ENUM) ||
	    gls_refuses_by(x, st, wrong))
		return;
	l = gls_texture_specify(x, st, t, face, arg_i(c, 1), &form);
	if (l) /* the border is copied as well: the given corner is its corner */
		copy_screen(x, st, t, face, arg_i(c, 1),
		            &(struct copy){ { arg_i32(c, 3), arg_i32(c, 4) }, { l->width, l->height }, { 0 } });
}

GLS_FAMILY(glCopyTexSubImage, STATE)
{
	/* destination; then the corner on the screen and the size */
	unsigned face, n_dims = gls_commands[x->command].suffix.n, after = 2 + n_dims;
	struct gls_texture *t = gls_texture_find_level(x, st, arg_u(c, 0), arg_i(c, 1), &face);
	struct gls_level *l = t ? &t->levels[face][arg_i(c, 1)] : NULL;
	struct copy copy = { { arg_i32(c, after), arg_i32(c, after + 1) },
		             { arg_i32(c, after + 2), n_dims > 1 ? arg_i32(c, after + 3) : 1 }, { 0 } };
	int64_t *to = copy.to, *size = copy.size;

	if (!l)
		return;
	if (gls_refuses(x, st, !l->texels, GL_INVALID_OPERATION))
		return;
	for (unsigned i = 0; i < n_dims; i++)
		to[i] = arg_i32(c, 2 + i) + l->border;
	if (to[0] < 0 || to[1] < 0 || to[2] < 0 || size[0] < 0 || size[1] < 0 || to[0] > l->width || to[1] > l->height ||
	    to[2] >= l->depth || size[0] > l->width - to[0] || size[1] > l->height - to[1]) {
		gls_error(x, st, GL_INVALID_VALUE);
		return;
	}
	copy_screen(x, st, t, face, arg_i(c, 1), &copy);
}
