#include "tracer/frame/place/opacity_cells.h"

#include <math.h>
#include <stdlib.h>

#include "gl_tokens.h"
#include "kernels/gl/combine.h"
#include "kernels/rays/opacity.h"

/* How far coordinates on a device may be from those computed here: in texels, and as a share of them. */
#define MARGIN (1.0f / 64)
#define MARGIN_SHARE 4e-6f

/* An alpha from here on transmits less than OPACITY_LEAST, with room for rounding. */
#define FULL (1 - OPACITY_LEAST / 4)

static const struct opacity_range anything = { 0, 1 };

/* --- Texels ------------------------------------------------------------------------------------------------------ */

static void join(uint8_t to[2], const uint8_t from[2])
{
	to[0] = from[0] < to[0] ? from[0] : to[0];
	to[1] = from[1] > to[1] ? from[1] : to[1];
}

void opacity_blocks_make(const struct scene_texture *texture, struct opacity_blocks *out)
{
	uint32_t w = texture->width, h = texture->height;
	size_t n = 0;

	*out = (struct opacity_blocks){ 0 };
	for (;;) {
		out->first[out->n_levels] = n;
		out->width[out->n_levels] = w;
		out->height[out->n_levels++] = h;
		n += (size_t)w * h;
		if ((w == 1 && h == 1) || out->n_levels == OPACITY_BLOCK_LEVELS)
			break;
		w = (w + 1) / 2;
		h = (h + 1) / 2;
	}
	out->alpha = malloc(n * sizeof(*out->alpha));
	if (!out->alpha)
		return;
	for (size_t i = 0; i < (size_t)texture->width * texture->height; i++)
		out->alpha[i][0] = out->alpha[i][1] = texture->texels[4 * i + 3];
	for (uint32_t level = 1; level < out->n_levels; level++)
		for (uint32_t y = 0; y < out->height[level]; y++)
			for (uint32_t x = 0; x < out->width[level]; x++) {
				uint8_t *to = out->alpha[out->first[level] + (size_t)y * out->width[level] + x];

				to[0] = 255;
				to[1] = 0;
				for (uint32_t k = 0; k < 4; k++) {
					const uint32_t u = 2 * x + k % 2, v = 2 * y + k / 2;

					if (u < out->width[level - 1] && v < out->height[level - 1])
						join(to, out->alpha[out->first[level - 1] + (size_t)v * out->width[level - 1] + u]);
				}
			}
}

void opacity_blocks_free(struct opacity_blocks *blocks)
{
	free(blocks->alpha);
	blocks->alpha = NULL;
}

/* Texels of a row of `size`, as at most two ranges. @return the number of ranges; 0: the border's colour counts, too */
static int wrap_texels(uint32_t wrap, int64_t lo, int64_t hi, int64_t size, uint32_t range[2][2])
{
	if (wrap == GL_REPEAT && hi - lo + 1 < size) {
		const int64_t a = (lo % size + size) % size, b = (hi % size + size) % size;

		range[0][0] = (uint32_t)a;
		range[0][1] = (uint32_t)(a <= b ? b : size - 1);
		range[1][0] = 0;
		range[1][1] = (uint32_t)b;
		return a <= b ? 1 : 2;
	}
	if (wrap == GL_CLAMP_TO_EDGE) {
		lo = lo < 0 ? 0 : lo < size ? lo : size - 1;
		hi = hi < 0 ? 0 : hi < size ? hi : size - 1;
	} else if (wrap == GL_REPEAT || (wrap == GL_MIRRORED_REPEAT && (lo < 0 || hi >= size))) {
		lo = 0;
		hi = size - 1;
	}
	range[0][0] = (uint32_t)lo;
	range[0][1] = (uint32_t)hi;
	return lo >= 0 && hi < size;
}

/* Texels that coordinates from lo to hi reach. @return 0: they are unknown */
static int texels_between(float lo, float hi, uint32_t size, uint32_t linear, int64_t out[2])
{
	const float a = lo * (float)size - (linear ? 0.5f : 0), b = hi * (float)size - (linear ? 0.5f : 0);
	const float margin = MARGIN + MARGIN_SHARE * fmaxf(fabsf(a), fabsf(b));

	if (!(a >= -1e6f && b <= 1e6f))
		return 0;
	out[0] = (int64_t)floorf(a - margin);
	out[1] = (int64_t)floorf(b + margin) + linear;
	return 1;
}

/* Bounds of the alpha of texels x[0] to x[1], y[0] to y[1]. */
static void bound_texels(const struct opacity_blocks *b, const uint32_t x[2], const uint32_t y[2], uint8_t to[2])
{
	const uint32_t size = x[1] - x[0] > y[1] - y[0] ? x[1] - x[0] : y[1] - y[0];
	uint32_t level = 0;

	while (size >> level > 4 && level + 1 < b->n_levels)
		level++;
	for (uint32_t v = y[0] >> level; v <= y[1] >> level; v++)
		for (uint32_t u = x[0] >> level; u <= x[1] >> level; u++)
			join(to, b->alpha[b->first[level] + (size_t)v * b->width[level] + u]);
}

static struct opacity_range sample_range(const struct opacity_cells *c, uint32_t i, uint32_t j)
{
	const struct scene_unit *unit = &c->surface->scene->units[c->surface->unit];
	const struct scene_texture *texture = c->surface->scene->textures[unit->texture];
	const uint32_t size[2] = { texture->width, texture->height }, wrap[2] = { unit->wrap_s, unit->wrap_t };
	uint32_t range[2][2][2];
	uint8_t bounds[2] = { 255, 0 };
	int n[2];

	if (!c->surface->blocks->alpha)
		return anything;
	for (int a = 0; a < 2; a++) {
		const float at = c->first[a] + (float)i * c->right[a] + (float)j * c->up[a];
		int64_t texels[2];

		if (c->anywhere)
			texels[0] = INT32_MIN, texels[1] = INT32_MAX;
		else if (!texels_between(at + fminf(c->right[a], 0) + fminf(c->up[a], 0),
		                         at + fmaxf(c->right[a], 0) + fmaxf(c->up[a], 0), size[a],
		                         unit->mag_filter == GL_LINEAR, texels))
			return anything;
		n[a] = wrap_texels(wrap[a], texels[0], texels[1], size[a], range[a]);
	}
	if (!n[0] || !n[1])
		return anything;
	for (int y = 0; y < n[1]; y++)
		for (int x = 0; x < n[0]; x++)
			bound_texels(c->surface->blocks, range[0][x], range[1][y], bounds);
	return (struct opacity_range){ (float)bounds[0] / 255, (float)bounds[1] / 255 };
}

/* --- Alpha ------------------------------------------------------------------------------------------------------- */

static struct opacity_range clamped(struct opacity_range r)
{
	return (struct opacity_range){ fminf(fmaxf(r.lo, 0), 1), fminf(fmaxf(r.hi, 0), 1) };
}

static struct opacity_range times(struct opacity_range a, struct opacity_range b)
{
	return (struct opacity_range){ a.lo * b.lo, a.hi * b.hi };
}

static struct opacity_range argument(const struct scene_unit *unit, int i, struct opacity_range previous,
                                     struct opacity_range sample, struct opacity_range primary)
{
	struct opacity_range r;

	switch (unit->source_alpha[i]) {
	case GL_TEXTURE: r = sample; break;
	case GL_PREVIOUS: r = previous; break;
	case GL_PRIMARY_COLOR: r = primary; break;
	case GL_CONSTANT: r = clamped((struct opacity_range){ unit->env_color[3], unit->env_color[3] }); break;
	default: return anything;
	}
	if (unit->operand_alpha[i] == GL_ONE_MINUS_SRC_ALPHA)
		r = (struct opacity_range){ 1 - r.hi, 1 - r.lo };
	return r;
}

/* Alpha behind a texture unit (sec. 3.8.13), as in combine_plain and combine_full. */
static struct opacity_range through_unit(const struct scene_unit *unit, uint32_t format, struct opacity_range previous,
                                         struct opacity_range sample, struct opacity_range primary)
{
	struct opacity_range r;

	if (unit->env_mode == GL_COMBINE) {
		if (unit->combine_rgb == GL_DOT3_RGBA || unit->combine_rgb == GL_DOT3_RGBA_EXT ||
		    (unit->combine_alpha != GL_REPLACE && unit->combine_alpha != GL_MODULATE))
			return anything;
		r = argument(unit, 0, previous, sample, primary);
		if (unit->combine_alpha == GL_MODULATE)
			r = times(r, argument(unit, 1, previous, sample, primary));
		return clamped((struct opacity_range){ r.lo * unit->scale_alpha, r.hi * unit->scale_alpha });
	}
	if (unit->env_mode == GL_COMBINE4_NV)
		return anything;
	if (unit->env_mode == GL_DECAL || !combine_has_alpha(format))
		return previous;
	if (unit->env_mode == GL_REPLACE)
		return sample;
	if ((unit->env_mode == GL_BLEND || unit->env_mode == GL_ADD) && format == GL_INTENSITY)
		return anything;
	return times(previous, sample);
}

/* The opacity that follows from alpha on a surface without transmission, as in transparency_of_hit. */
static uint32_t does(const struct scene_material *m, struct opacity_range alpha)
{
	/* Alphas are compared in 8 bits; a step more on both sides covers rounding. Products with 0 are exact. */
	const float ref = roundf(fminf(fmaxf(m->alpha_ref, 0), 1) * 255);
	const float lo = floorf(alpha.lo * 255) - 1, hi = alpha.hi > 0 ? ceilf(alpha.hi * 255) + 1 : 0;
	int fails = 0, passes = 1;

	if (m->alpha_test)
		switch (m->alpha_func) {
		case GL_GREATER: fails = hi <= ref, passes = lo > ref; break;
		case GL_GEQUAL: fails = hi < ref, passes = lo >= ref; break;
		case GL_LESS: fails = lo >= ref, passes = hi < ref; break;
		case GL_LEQUAL: fails = lo > ref, passes = hi <= ref; break;
		case GL_NOTEQUAL: fails = hi <= 0 && ref <= 0, passes = lo > ref || hi < ref; break;
		case GL_NEVER: fails = 1; break;
		case GL_ALWAYS: break;
		default: passes = 0; break;
		}
	if (fails)
		return OPACITY_PASSES;
	if (!passes)
		return OPACITY_ASK;
	if (!m->blend || m->surface.hidden & SCENE_SOLID)
		return OPACITY_STOPS;
	if (m->blend_equation_rgb != GL_FUNC_ADD || m->blend_src_rgb != GL_SRC_ALPHA ||
	    m->blend_dst_rgb != GL_ONE_MINUS_SRC_ALPHA)
		return OPACITY_ASK;
	return alpha.lo >= FULL ? OPACITY_STOPS : alpha.hi > 0 ? OPACITY_ASK : OPACITY_PASSES;
}

uint32_t opacity_cells_at(const struct opacity_cells *c, uint32_t i, uint32_t j)
{
	const struct scene *scene = c->surface->scene;
	const struct scene_material *m = c->surface->material;
	struct opacity_range alpha = c->primary;

	for (uint32_t k = m->unit_first; k < m->unit_first + m->unit_count; k++) {
		const struct scene_unit *unit = &scene->units[k];
		const uint32_t format = scene->textures[unit->texture]->base_format;

		if (format == GL_DEPTH_COMPONENT || unit->swizzle)
			alpha = anything;
		else
			alpha = through_unit(unit, format, alpha,
			                     k == c->surface->unit ? sample_range(c, i, j) : anything, c->primary);
	}
	return does(m, clamped(alpha));
}

/* --- Triangles --------------------------------------------------------------------------------------------------- */

uint32_t opacity_unit(const struct scene *scene, const struct scene_material *m)
{
	for (uint32_t k = m->unit_first; k < m->unit_first + m->unit_count; k++) {
		const struct scene_unit *unit = &scene->units[k];
		const struct scene_texture *t = scene->textures[unit->texture];

		if (t->target == GL_TEXTURE_2D && combine_has_alpha(t->base_format) && !t->floats && !t->border &&
		    t->n_levels && t->n_bytes / 4 >= (size_t)t->width * t->height && !unit->swizzle &&
		    (unit->mag_filter == GL_LINEAR || unit->mag_filter == GL_NEAREST))
			return k;
	}
	return SCENE_NONE;
}

static struct opacity_range primary_alpha(const struct opacity_surface *s, const uint32_t index[3])
{
	const struct scene_material *m = s->material;
	const int tracks = m->color_material &&
	                   (m->color_material_mode == GL_DIFFUSE || m->color_material_mode == GL_AMBIENT_AND_DIFFUSE);
	struct opacity_range r = { 1, 0 };

	if (m->lighting && (s->mesh->face || (tracks && m->two_side)))
		return anything;
	for (int i = 0; i < 3; i++) {
		float alpha = s->mesh->color ? s->mesh->color[4 * (size_t)index[i] + 3] : s->current->color[3];

		if (m->lighting && !tracks)
			alpha = (i && m->two_side ? m->back : m->front).diffuse[3];
		if (!(alpha >= 0 && alpha <= 1))
			return anything;
		r.lo = fminf(r.lo, alpha);
		r.hi = fmaxf(r.hi, alpha);
	}
	return r;
}

/* Texture coordinates of a vertex (sec. 2.11.4). @return 0 if they are generated, or divided by a q other than 1 */
static int coordinates(const struct opacity_surface *s, uint32_t vertex, float out[2])
{
	const struct scene_unit *unit = &s->scene->units[s->unit];
	const float *c = s->mesh->texcoord[unit->unit] ? s->mesh->texcoord[unit->unit] + 4 * (size_t)vertex :
	                                                 s->current->texcoord[unit->unit];
	float to[4];

	for (int row = 0; row < 4; row++)
		to[row] = unit->matrix[row] * c[0] + unit->matrix[4 + row] * c[1] + unit->matrix[8 + row] * c[2] +
		          unit->matrix[12 + row] * c[3];
	out[0] = to[0];
	out[1] = to[1];
	return to[3] == 1 && !unit->gen_mode[0] && !unit->gen_mode[1] && !unit->gen_mode[2] && !unit->gen_mode[3];
}

void opacity_cells_start(const struct opacity_surface *s, const uint32_t index[3], uint32_t n,
                         struct opacity_cells *out)
{
	float corner[3][2] = { { 0 } };

	out->surface = s;
	out->anywhere = 0;
	for (int i = 0; i < 3 && s->unit != SCENE_NONE; i++) /* w other than 1 would distort the weights of hits */
		out->anywhere |= !coordinates(s, index[i], corner[i]) || s->mesh->position[4 * (size_t)index[i] + 3] != 1;
	out->primary = primary_alpha(s, index);
	for (int a = 0; a < 2; a++) {
		out->first[a] = corner[0][a];
		out->right[a] = (corner[1][a] - corner[0][a]) / (float)n;
		out->up[a] = (corner[2][a] - corner[0][a]) / (float)n;
	}
}
