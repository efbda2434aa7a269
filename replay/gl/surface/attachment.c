/* Transfers pixels between attachments and pictures. */
#include "replay/gl/surface/attachment.h"

#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "replay/build/frame.h"
#include "replay/gl/texture/level.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/machine.h"

enum { DEPTH = GLS_ATTACHMENT_DEPTH, STENCIL = GLS_ATTACHMENT_STENCIL };

/* The object behind an attachment. */
struct target {
	uint32_t width, height, format;
	struct gls_renderbuffer *renderbuffer; /* either this, */
	struct gls_texture *texture;           /* or these three */
	struct gls_level *level;
	size_t first; /* index of the first texel in the level */
	int sample;   /* number of a renderbuffer's sample, from 1 on; 0: the mean of all */
};

/* @return 0: nothing is attached, or it has no pixels */
static int find_target(const struct gls_share *share, const struct gls_attachment *a, struct target *out)
{
	memset(out, 0, sizeof(*out));
	if (a->renderbuffer) {
		struct gls_renderbuffer *r = table_find(&share->renderbuffers, a->renderbuffer);

		if (!r)
			return 0;
		*out = (struct target){ .width = r->width, .height = r->height, .format = r->internal_format, .renderbuffer = r };
	} else if (a->texture) {
		struct gls_texture *t = table_find(&share->textures, a->texture);
		struct gls_level *l = t ? &t->levels[a->face][a->level] : NULL;

		if (!l || !l->texels || l->border || a->layer >= l->depth)
			return 0;
		*out = (struct target){ .width = l->width,
			                .height = l->height,
			                .format = l->internal_format,
			                .texture = t,
			                .level = l,
			                .first = (size_t)a->layer * l->width * l->height };
	}
	return out->width && out->height;
}

static int is_missing(const struct target *t)
{
	return t->renderbuffer ? t->renderbuffer->missing : t->level ? t->level->missing : 0;
}

static void set_missing(struct gls_exec *x, const struct target *t, uint32_t missing)
{
	if (t->renderbuffer)
		t->renderbuffer->missing = missing;
	else if (t->level)
		gls_level_lose(t->level, missing);
	if (missing)
		x->feedback.missing = 1;
}

int gls_attachment_color(uint32_t buffer)
{
	uint32_t i = buffer - GL_COLOR_ATTACHMENT0;

	return i < GLS_ATTACHMENT_DEPTH ? (int)i : -1;
}

int gls_attachment_is_same(const struct gls_attachment *a, const struct gls_attachment *b)
{
	return (a->texture && a->texture == b->texture) || (a->renderbuffer && a->renderbuffer == b->renderbuffer);
}

static int has_alpha(uint32_t base)
{
	return base == GL_RGBA || base == GL_ALPHA || base == GL_LUMINANCE_ALPHA || base == GL_INTENSITY;
}

int gls_attachment_has_8_bits(const struct gls_share *share, const struct gls_attachment *a)
{
	struct target t;

	if (!find_target(share, a, &t))
		return 0;
	switch (t.format) {
	case 3: case 4: case GL_RGB: case GL_RGBA: case GL_RGB8: case GL_RGBA8:
		return 1;
	default:
		return 0;
	}
}

int gls_attachments_describe(const struct gls_share *share, const struct gls_attachment attached[N_GLS_ATTACHMENTS],
                             uint32_t colors, struct gls_surface *s)
{
	struct target t;
	int any = 0;

	s->depth_bits = s->stencil_bits = s->alpha_bits = s->samples = s->floats = s->srgb = 0;
	s->samples_from_below = 1;
	s->width = s->height = 16384;
	for (int i = 0; i < N_GLS_ATTACHMENTS; i++) {
		if ((i < DEPTH && !(colors >> i & 1)) || !find_target(share, &attached[i], &t))
			continue;
		any = 1;
		s->width = t.width < s->width ? t.width : s->width;
		s->height = t.height < s->height ? t.height : s->height;
		if (t.renderbuffer && t.renderbuffer->samples > s->samples)
			s->samples = t.renderbuffer->samples;
		if (i < DEPTH) {
			s->alpha_bits |= has_alpha(gls_base_format(t.format)) ? 8 : 0;
			s->floats |= gls_format_floats(t.format);
			s->srgb |= gls_format_is_srgb(t.format);
		}
		else if (i == DEPTH)
			s->depth_bits = gls_format_depth_bits(t.format);
		else
			s->stencil_bits = gls_format_stencil_bits(t.format);
	}
	return any;
}

/* The picture of a target's sample; NULL: none. */
static struct scene_picture *sample_of(const struct target *t, struct scene_picture *p)
{
	return !p || !t->sample ? p : p->samples ? &p->samples[t->sample - 1] : NULL;
}

/* The contents of a renderbuffer, or NULL. */
static struct scene_picture *held_by(const struct target *t)
{
	return sample_of(t, t->renderbuffer->content ? &t->renderbuffer->content->picture : NULL);
}

/* A part of a picture: from x0 and y0 on, before x1 and y1. */
struct part {
	uint32_t x0, y0, x1, y1;
};

static uint32_t within(int64_t at, uint32_t size)
{
	return at < 0 ? 0 : at < size ? (uint32_t)at : size;
}

/* area: NULL: everything */
static struct part part_of(const struct gls_surface *s, const struct gls_area *area)
{
	const int32_t *r = area ? area->rect : NULL;

	if (!area)
		return (struct part){ 0, 0, s->width, s->height };
	return (struct part){ within(r[0], s->width), within(r[1], s->height), within((int64_t)r[0] + r[2], s->width),
		              within((int64_t)r[1] + r[3], s->height) };
}

static void load_color(const struct target *t, const struct part *part, struct scene_picture *p)
{
	const struct gls_level *l = t->level;
	const struct scene_picture *held = l ? NULL : held_by(t);
	const uint8_t *from = l ? l->texels + l->texel_bytes * t->first : held ? held->rgba : NULL;
	float v[4];

	for (uint32_t y = part->y0; from && y < part->y1; y++) {
		size_t at = (size_t)y * t->width + part->x0, to = (size_t)y * p->width + part->x0;

		if (!p->colors && (!l || l->texel_bytes == 4)) {
			memcpy(p->rgba + 4 * to, from + 4 * at, 4 * (size_t)(part->x1 - part->x0));
			continue;
		}
		for (uint32_t x = part->x0; x < part->x1; x++, at++, to++) {
			if (l)
				gls_texel_load(l->texel_bytes, from + l->texel_bytes * at, v);
			else
				gls_picture_color(held, at, v);
			for (unsigned i = 0; i < 4; i++)
				p->rgba[4 * to + i] = gls_byte(v[i]);
			if (p->colors)
				memcpy(p->colors + 4 * to, v, sizeof(v));
		}
	}
}

static void load_depth(const struct target *t, const struct part *part, struct scene_picture *p)
{
	float steps = (float)((1u << p->depth_bits) - 1), value;

	for (uint32_t y = part->y0; y < part->y1; y++)
		for (uint32_t x = part->x0; x < part->x1; x++) {
			uint32_t *to = &p->depth[(size_t)y * p->width + x];
			size_t from = (size_t)y * t->width + x;

			if (t->level) {
				memcpy(&value, t->level->texels + 4 * (t->first + from), 4);
				*to = (uint32_t)rintf(fminf(fmaxf(value, 0), 1) * steps); /* float depths may have any
				                                                             value */
			} else if (held_by(t)) {
				*to = held_by(t)->depth[from];
			}
		}
}

/* The stencil values of an attachment, or NULL. */
static uint8_t *stencil_of(const struct target *t)
{
	if (t->renderbuffer)
		return held_by(t) ? held_by(t)->stencil : NULL;
	return gls_level_stencil(t->level) ? gls_level_stencil(t->level) + t->first : NULL;
}

static void load_stencil(const struct target *t, const struct part *part, struct scene_picture *p)
{
	const uint8_t *from = stencil_of(t);

	for (uint32_t y = part->y0; from && y < part->y1; y++)
		memcpy(p->stencil + (size_t)y * p->width + part->x0, from + (size_t)y * t->width + part->x0,
		       part->x1 - part->x0);
}

/* Load one sample from the attachments, or the mean (struct target). */
static void load_sample(const struct gls_share *share, const struct gls_attachment attached[N_GLS_ATTACHMENTS],
                        int color, int sample, const struct gls_surface *s, const struct part *part,
                        struct scene_picture *p)
{
	struct target t;

	for (uint32_t y = part->y0; !s->alpha_bits && y < part->y1; y++)
		for (uint32_t x = part->x0; x < part->x1; x++) {
			p->rgba[4 * ((size_t)y * p->width + x) + 3] = 255;
			if (p->colors)
				p->colors[4 * ((size_t)y * p->width + x) + 3] = 1;
		}

	/*
	 * A surface is as small as the smallest attachment it draws to. A read buffer may be even smaller: then nothing
	 * is loaded.
	 */
	if (color >= 0 && find_target(share, &attached[color], &t) && t.width >= s->width && t.height >= s->height) {
		t.sample = sample;
		load_color(&t, part, p);
	}
	if (s->depth_bits && find_target(share, &attached[DEPTH], &t)) {
		t.sample = sample;
		load_depth(&t, part, p);
	}
	if (s->stencil_bits && find_target(share, &attached[STENCIL], &t)) {
		t.sample = sample;
		load_stencil(&t, part, p);
	}
}

struct gls_picture *gls_attachments_load(struct gls_exec *x, const struct gls_share *share,
                                         const struct gls_attachment attached[N_GLS_ATTACHMENTS], int color,
                                         const struct gls_surface *s, const struct gls_area *area)
{
	const struct part part = part_of(s, area);
	struct gls_picture *p;
	struct target t;

	for (int i = 0; i < N_GLS_ATTACHMENTS; i++)
		if ((i >= DEPTH || i == color) && find_target(share, &attached[i], &t) && is_missing(&t))
			return NULL;
	/* If only a part is read, the rest is not even touched: alpha, too, is set in that part only. */
	p = gls_picture_make(x, &(struct gls_picture_form){ s->width, s->height, s->depth_bits, 8, s->samples,
	                                                    s->floats });
	if (!p)
		return NULL;
	load_sample(share, attached, color, 0, s, &part, &p->picture);
	for (int i = 0; i < SCENE_SAMPLES && p->picture.samples; i++)
		load_sample(share, attached, color, i + 1, s, &part, &p->picture.samples[i]);
	return p;
}

/* The picture of a renderbuffer, created if necessary. NULL: out of memory */
static struct scene_picture *content_of(struct gls_exec *x, const struct target *t)
{
	struct gls_renderbuffer *r = t->renderbuffer;

	if (!r->content)
		r->content = gls_picture_make(x, &(struct gls_picture_form){ r->width, r->height, 24, 8, r->samples,
		                                                             gls_format_floats(r->internal_format) });
	return held_by(t);
}

static void store_color(struct gls_exec *x, const struct target *t, const struct scene_picture *p)
{
	struct scene_picture *content = t->renderbuffer ? content_of(x, t) : NULL;
	const struct gls_format *format = gls_format_find(t->format);

	for (uint32_t y = 0; format && y < p->height; y++)
		for (uint32_t i = 0; i < p->width; i++) {
			size_t to = (size_t)y * t->width + i;
			float v[4];

			gls_picture_color(p, (size_t)y * p->width + i, v);
			if (t->level)
				gls_format_draw(format, v, t->level->texels + t->level->texel_bytes * (t->first + to));
			else if (content)
				(format->numbers ? gls_format_store_bytes : gls_format_draw)(format, v, content->rgba + 4 * to);
			if (content && content->colors)
				gls_format_store(format, v, 0, (uint8_t *)(content->colors + 4 * to));
		}
}

static void store_depth(struct gls_exec *x, const struct target *t, const struct scene_picture *p)
{
	struct scene_picture *content = t->renderbuffer ? content_of(x, t) : NULL;
	float steps = (float)((1u << p->depth_bits) - 1), value;

	for (uint32_t y = 0; y < p->height; y++)
		for (uint32_t i = 0; i < p->width; i++) {
			uint32_t from = p->depth[(size_t)y * p->width + i];
			size_t to = (size_t)y * t->width + i;

			value = (float)from / steps;
			if (t->level)
				memcpy(t->level->texels + 4 * (t->first + to), &value, 4);
			else if (content)
				content->depth[to] = from;
		}
}

static void store_stencil(struct gls_exec *x, const struct target *t, const struct scene_picture *p)
{
	uint8_t *to;

	if (t->renderbuffer)
		content_of(x, t);
	to = stencil_of(t);
	for (uint32_t y = 0; to && y < p->height; y++)
		memcpy(to + (size_t)y * t->width, p->stencil + (size_t)y * p->width, p->width);
}

static void store_sample(struct gls_exec *x, const struct target *t, int attachment, const struct scene_picture *p)
{
	if (attachment < DEPTH)
		store_color(x, t, p);
	else if (attachment == DEPTH && p->depth_bits)
		store_depth(x, t, p);
	else if (attachment == STENCIL)
		store_stencil(x, t, p);
}

void gls_attachments_store(struct gls_exec *x, const struct gls_share *share,
                           const struct gls_attachment attached[N_GLS_ATTACHMENTS], uint32_t which,
                           const struct scene_picture *p)
{
	struct target t;

	for (int i = 0; i < N_GLS_ATTACHMENTS; i++) {
		if (!(which >> i & 1) || !find_target(share, &attached[i], &t))
			continue;
		if (t.texture)
			gls_texture_changed(t.texture);
		if (!p) {
			if (!x->want)
				set_missing(x, &t, 1);
			continue;
		}
		for (t.sample = 0; t.sample <= SCENE_SAMPLES && (!t.sample || (p->samples && t.renderbuffer)); t.sample++)
			store_sample(x, &t, i, t.sample ? &p->samples[t.sample - 1] : p);
		if (t.width == p->width && t.height == p->height)
			set_missing(x, &t, 0);
	}
}
