/*
 * Framebuffer objects (EXT_framebuffer_object, EXT_framebuffer_blit; GL 3.0 sec. 4.4): render to texture.
 *
 * What an object is drawn to is a surface of its own (feedback.h), made of what is attached. Attachments hold the truth: its
 * events are rendered and written back to them (settled) when somebody looks at one of them, and what comes after begins
 * from them. A frame that was not built leaves its targets missing, as a screen copy does (copytex.c).
 */
#include "replay/gl/surface/framebuffer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/trace.h"
#include "replay/build/frame.h"
#include "replay/gl/dispatch.h"
#include "replay/gl/surface/feedback.h"
#include "replay/gl/surface/pixels.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"
#include "base/table.h"

#define MANY_EVENTS (1u << 16) /* of an object that nobody looks at: settled, so that they do not pile up */

enum { DEPTH = GLS_ATTACHMENT_DEPTH, STENCIL = GLS_ATTACHMENT_STENCIL };

/* ---- attachments ---- */

struct target {
	uint32_t width, height, format;
	struct gls_renderbuffer *renderbuffer; /* either this */
	struct gls_texture *texture;           /* or this and the next two */
	struct gls_level *level;
	size_t first; /* texel */
	int sample;   /* of a renderbuffer's pixels, from 1 on; 0: their mean */
};

/* @return 0 where there is none, or it has no pixels */
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
		*out = (struct target){ .width = l->width, .height = l->height, .format = l->internal_format, .texture = t, .level = l,
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
		t->level->missing = missing;
	if (missing)
		x->feedback.missing = 1;
}

/* ---- pixels between surfaces and attachments ---- */

static int color_of(uint32_t buffer)
{
	uint32_t i = buffer - GL_COLOR_ATTACHMENT0;

	return i < GLS_ATTACHMENT_DEPTH ? (int)i : -1;
}

static int has_alpha(uint32_t base)
{
	return base == GL_RGBA || base == GL_ALPHA || base == GL_LUMINANCE_ALPHA || base == GL_INTENSITY;
}

/* The colours that a surface's events draw to: 1 << number. */
static uint32_t colors_of(const struct gls_framebuffer *fb)
{
	int color = color_of(fb->drawn_buffer);

	return fb->drawn_too | (color >= 0 ? 1u << color : 0);
}

/* Size and bits of the surface that the attachments make. @return 0: there is nothing to draw to */
static int describe(const struct gls_share *share, struct gls_framebuffer *fb)
{
	struct gls_surface *s = &fb->surface;
	struct target t;
	uint32_t colors = colors_of(fb);
	int any = 0;

	s->depth_bits = s->stencil_bits = s->alpha_bits = s->samples = s->floats = 0;
	s->samples_from_below = 1;
	s->width = s->height = 16384;
	for (int i = 0; i < N_GLS_ATTACHMENTS; i++) {
		if ((i < DEPTH && !(colors >> i & 1)) || !find_target(share, &fb->attached[i], &t))
			continue;
		any = 1;
		s->width = t.width < s->width ? t.width : s->width;
		s->height = t.height < s->height ? t.height : s->height;
		if (t.renderbuffer && t.renderbuffer->samples > s->samples)
			s->samples = t.renderbuffer->samples;
		if (i < DEPTH) {
			s->alpha_bits |= has_alpha(gls_base_format(t.format)) ? 8 : 0;
			s->floats |= gls_format_is_float(t.format);
		}
		else if (i == DEPTH)
			s->depth_bits = gls_format_depth_bits(t.format);
		else
			s->stencil_bits = gls_format_stencil_bits(t.format);
	}
	return any;
}

/* What of a picture a target's sample means; NULL: nothing is known of it. */
static struct scene_picture *sample_of(const struct target *t, struct scene_picture *p)
{
	return !p || !t->sample ? p : p->samples ? &p->samples[t->sample - 1] : NULL;
}

/* What a renderbuffer holds, or NULL. */
static struct scene_picture *held_by(const struct target *t)
{
	return sample_of(t, t->renderbuffer->content ? &t->renderbuffer->content->picture : NULL);
}

static void load_color(const struct target *t, struct scene_picture *p)
{
	const struct gls_level *l = t->level;
	const struct scene_picture *held = l ? NULL : held_by(t);
	const uint8_t *from = l ? l->texels + l->texel_bytes * t->first : held ? held->rgba : NULL;
	float v[4];

	for (uint32_t y = 0; from && y < p->height; y++) {
		size_t at = (size_t)y * t->width, to = (size_t)y * p->width;

		if (!p->colors && (!l || l->texel_bytes == 4)) {
			memcpy(p->rgba + 4 * to, from + 4 * at, 4 * (size_t)p->width);
			continue;
		}
		for (uint32_t x = 0; x < p->width; x++, at++, to++) {
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

static void load_depth(const struct target *t, struct scene_picture *p)
{
	float steps = (float)((1u << p->depth_bits) - 1), value;

	for (uint32_t y = 0; y < p->height; y++)
		for (uint32_t x = 0; x < p->width; x++) {
			uint32_t *to = &p->depth[(size_t)y * p->width + x];
			size_t from = (size_t)y * t->width + x;

			if (t->level) {
				memcpy(&value, t->level->texels + 4 * (t->first + from), 4);
				*to = (uint32_t)rintf(value * steps);
			} else if (held_by(t)) {
				*to = held_by(t)->depth[from];
			}
		}
}

/* Where an attachment keeps its stencil values, or NULL. */
static uint8_t *stencil_of(const struct target *t)
{
	if (t->renderbuffer)
		return held_by(t) ? held_by(t)->stencil : NULL;
	return gls_level_stencil(t->level) ? gls_level_stencil(t->level) + t->first : NULL;
}

static void load_stencil(const struct target *t, struct scene_picture *p)
{
	const uint8_t *from = stencil_of(t);

	for (uint32_t y = 0; from && y < p->height; y++)
		memcpy(p->stencil + (size_t)y * p->width, from + (size_t)y * t->width, p->width);
}

/* What the attachments hold of a sample (see struct target). */
static void load_sample(const struct gls_share *share, const struct gls_framebuffer *fb, int color, int sample,
                        struct scene_picture *p)
{
	const struct gls_surface *s = &fb->surface;
	struct target t;

	/* A larger surface than this buffer's own cannot be: it is the smallest of all. A read buffer may be smaller still. */
	if (color >= 0 && find_target(share, &fb->attached[color], &t) && t.width >= s->width && t.height >= s->height) {
		t.sample = sample;
		load_color(&t, p);
	}
	if (s->depth_bits && find_target(share, &fb->attached[DEPTH], &t)) {
		t.sample = sample;
		load_depth(&t, p);
	}
	if (s->stencil_bits && find_target(share, &fb->attached[STENCIL], &t)) {
		t.sample = sample;
		load_stencil(&t, p);
	}
}

/* What the attachments hold. @return a reference; NULL: out of memory, or missing */
static struct gls_picture *load(struct gls_exec *x, const struct gls_share *share, const struct gls_framebuffer *fb, int color)
{
	const struct gls_surface *s = &fb->surface;
	struct gls_picture *p;
	struct target t;

	for (int i = 0; i < N_GLS_ATTACHMENTS; i++)
		if ((i >= DEPTH || i == color) && find_target(share, &fb->attached[i], &t) && is_missing(&t))
			return NULL;
	p = gls_picture_make(x, s->width, s->height, s->depth_bits, s->alpha_bits, s->samples, s->floats);
	if (!p)
		return NULL;
	load_sample(share, fb, color, 0, &p->picture);
	for (int i = 0; i < SCENE_SAMPLES && p->picture.samples; i++)
		load_sample(share, fb, color, i + 1, &p->picture.samples[i]);
	return p;
}

/* Room for what was drawn to a renderbuffer. NULL: out of memory */
static struct scene_picture *content_of(struct gls_exec *x, const struct target *t)
{
	struct gls_renderbuffer *r = t->renderbuffer;

	if (!r->content)
		r->content = gls_picture_make(x, r->width, r->height, 24, 8, r->samples, gls_format_is_float(r->internal_format));
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
				gls_format_store(format, v, (uint8_t *)(content->colors + 4 * to));
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

/* Attachments (1 << number) become what was drawn to them; without pixels (p NULL) they are missing from now on. */
static void store(struct gls_exec *x, const struct gls_share *share, struct gls_framebuffer *fb, uint32_t attachments,
                  const struct scene_picture *p)
{
	struct target t;

	for (int i = 0; i < N_GLS_ATTACHMENTS; i++) {
		if (!(attachments >> i & 1) || !find_target(share, &fb->attached[i], &t))
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

/*
 * Render what was drawn so far, and write it back. Fixed function gives all colours the same fragments (GL 2.1 sec. 3.11.2): they
 * differ in what was there before, so that where it shows the events are rendered once for each; depth and stencil come out alike.
 */
static void settle_colors(struct gls_exec *x, const struct gls_share *share, struct gls_framebuffer *fb)
{
	struct gls_surface *s = &fb->surface;
	uint32_t left = colors_of(fb), others = 1u << DEPTH | 1u << STENCIL;
	int color = left ? __builtin_ctz(left) : -1, loads = x->want && x->feedback.supply, shows = 1;
	const struct scene_picture *p = NULL;

	if (loads && !(s->picture = load(x, share, fb, color)))
		s->skipped = 1;
	p = gls_surface_read(x, s);
	for (left &= left - 1; left && p; left &= left - 1) {
		struct gls_picture *next;

		store(x, share, fb, 1u << color, p);
		color = __builtin_ctz(left);
		if (!shows)
			continue;
		if (!(next = load(x, share, fb, color)))
			s->skipped = 1;
		if ((shows = gls_surface_restart(x, s, next)))
			p = gls_surface_read(x, s);
	}
	store(x, share, fb, p ? others | (color >= 0 ? 1u << color : 0) : others | colors_of(fb), p);
}

/* The same where anything was drawn at all; begin anew. */
static void settle(struct gls_exec *x, const struct gls_share *share, struct gls_framebuffer *fb)
{
	struct gls_surface *s = &fb->surface;

	if (!s->frame)
		return;
	if (gls_frame_events(s) && describe(share, fb))
		settle_colors(x, share, fb);
	gls_surface_free(s);
	s->skipped = 0;
}

static int same_target(const struct gls_attachment *a, const struct gls_attachment *b)
{
	return (a->texture && a->texture == b->texture) || (a->renderbuffer && a->renderbuffer == b->renderbuffer);
}

/* Settle all objects but one that something given is attached to. */
static void settle_sharing(struct gls_exec *x, const struct gls_share *share, const struct gls_attachment *what,
                           const struct gls_framebuffer *but)
{
	for (size_t i = 0; i < share->framebuffers.room; i++) {
		struct gls_framebuffer *fb = share->framebuffers.entries[i].value;
		int found = 0;

		if (!fb || fb == but || !fb->surface.frame)
			continue;
		for (int k = 0; k < N_GLS_ATTACHMENTS; k++)
			found |= same_target(&fb->attached[k], what);
		if (found)
			settle(x, share, fb);
	}
}

void gls_texture_settle(struct gls_exec *x, const struct gls_state *st, const struct gls_texture *t)
{
	if (t && t->attached)
		settle_sharing(x, st->share, &(struct gls_attachment){ .texture = t->name }, NULL);
}

void gls_units_settle(struct gls_exec *x, struct gls_state *st)
{
	for (unsigned u = 0; st->share->framebuffers.n && u < GLS_MAX_UNITS; u++)
		for (unsigned target = 0; target < N_GLS_TEXTURE_TARGETS; target++)
			if (st->a.texturing.units[u].enabled >> target & 1)
				gls_texture_settle(x, st, gls_texture_bound(x, st, u, target));
}

/* ---- what is drawn to and read ---- */

static struct gls_framebuffer *find(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_framebuffer *fb = table_find(&st->share->framebuffers, name);

	if (fb)
		return fb;
	fb = calloc(1, sizeof(*fb));
	if (!fb || table_set(&st->share->framebuffers, name, fb)) {
		free(fb);
		gls_out_of_memory(x, sizeof(*fb));
		return NULL;
	}
	fb->draw_buffer = fb->read_buffer = name ? GL_COLOR_ATTACHMENT0 : GL_BACK;
	fb->drawn_buffer = fb->draw_buffer;
	return fb;
}

struct gls_surface *gls_framebuffer_surface(struct gls_exec *x, struct gls_state *st)
{
	struct gls_framebuffer *fb = find(x, st, st->draw_framebuffer);

	if (!fb)
		return NULL;
	if (fb->drawn_buffer != st->a.color.draw_buffer || fb->drawn_too != st->a.color.also_drawn ||
	    gls_frame_events(&fb->surface) > MANY_EVENTS)
		settle(x, st->share, fb);
	fb->drawn_buffer = st->a.color.draw_buffer;
	fb->drawn_too = st->a.color.also_drawn;
	if (!describe(st->share, fb))
		return NULL;
	for (int i = 0; !fb->surface.frame && i < N_GLS_ATTACHMENTS; i++)
		settle_sharing(x, st->share, &fb->attached[i], fb);
	return &fb->surface;
}

const struct scene_picture *gls_framebuffer_read(struct gls_exec *x, struct gls_state *st)
{
	struct gls_framebuffer *fb = find(x, st, st->read_framebuffer);
	uint32_t drawn, too;

	if (!fb || !x->want)
		return NULL;
	settle(x, st->share, fb);
	for (int i = 0; i < N_GLS_ATTACHMENTS; i++)
		settle_sharing(x, st->share, &fb->attached[i], fb);
	gls_picture_release(fb->read);
	fb->read = NULL;
	drawn = fb->drawn_buffer;
	too = fb->drawn_too;
	fb->drawn_buffer = st->a.pixel.read_buffer;
	fb->drawn_too = 0;
	if (describe(st->share, fb) && !(fb->read = load(x, st->share, fb, color_of(fb->drawn_buffer))) && !x->failed && x->feedback.supply)
		x->feedback.rewind = 1;
	fb->drawn_buffer = drawn;
	fb->drawn_too = too;
	return fb->read ? &fb->read->picture : NULL;
}

void gls_framebuffer_touch(struct gls_exec *x, struct gls_state *st)
{
	struct gls_framebuffer *fb = find(x, st, st->draw_framebuffer);

	if (!fb || !st->draw_framebuffer)
		return;
	gls_surface_free(&fb->surface);
	fb->drawn_buffer = st->a.color.draw_buffer;
	fb->drawn_too = st->a.color.also_drawn;
	store(x, st->share, fb, 1u << DEPTH | 1u << STENCIL | colors_of(fb), NULL);
}

/* ---- objects ---- */

void gls_framebuffer_free(struct gls_framebuffer *fb)
{
	if (!fb)
		return;
	gls_surface_free(&fb->surface);
	gls_picture_release(fb->read);
	free(fb);
}

void gls_renderbuffer_free(struct gls_renderbuffer *r)
{
	if (r)
		gls_picture_release(r->content);
	free(r);
}

/* Detach a texture or renderbuffer that is deleted. */
static void detach(struct gls_exec *x, struct gls_state *st, const struct gls_attachment *what)
{
	settle_sharing(x, st->share, what, NULL);
	for (size_t i = 0; i < st->share->framebuffers.room; i++) {
		struct gls_framebuffer *fb = st->share->framebuffers.entries[i].value;

		for (int k = 0; fb && k < N_GLS_ATTACHMENTS; k++)
			if (same_target(&fb->attached[k], what))
				memset(&fb->attached[k], 0, sizeof(fb->attached[k]));
	}
}

void gls_texture_detach(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	detach(x, st, &(struct gls_attachment){ .texture = name });
}

static void changes(struct gls_exec *x, struct gls_state *st)
{
	gls_flush(x);
	st->dirty = GLS_DIRTY_ALL;
}

/* Objects have draw and read buffers of their own. */
static void bind_draw(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_framebuffer *old = find(x, st, st->draw_framebuffer), *fb = find(x, st, name);

	if (!old || !fb)
		return;
	if (!x->want)
		gls_framebuffer_touch(x, st);
	old->draw_buffer = st->a.color.draw_buffer;
	old->also_drawn = st->a.color.also_drawn;
	st->draw_framebuffer = name;
	st->a.color.draw_buffer = fb->draw_buffer;
	st->a.color.also_drawn = fb->also_drawn;
}

static void bind_read(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_framebuffer *old = find(x, st, st->read_framebuffer), *fb = find(x, st, name);

	if (!old || !fb)
		return;
	old->read_buffer = st->a.pixel.read_buffer;
	st->read_framebuffer = name;
	st->a.pixel.read_buffer = fb->read_buffer;
}

GLS_HANDLER(glBindFramebuffer, NOW)
{
	uint32_t target = arg_u(c, 0);

	if (target != GL_FRAMEBUFFER && target != GL_DRAW_FRAMEBUFFER && target != GL_READ_FRAMEBUFFER) {
		gls_error(x, st, GL_INVALID_ENUM);
		return;
	}
	changes(x, st);
	if (target != GL_READ_FRAMEBUFFER)
		bind_draw(x, st, arg_u(c, 1));
	if (target != GL_DRAW_FRAMEBUFFER)
		bind_read(x, st, arg_u(c, 1));
}
GLS_HANDLER(glBindFramebufferEXT, NOW) { gls_glBindFramebuffer(x, st, c); }

GLS_HANDLER(glDeleteFramebuffers, NOW)
{
	uint64_t n;
	const struct trace_value *names = arg_items(c, 1, &n);

	changes(x, st);
	for (uint64_t i = 0; i < n; i++) {
		uint32_t name = (uint32_t)gls_value_int(&names[i]);
		struct gls_framebuffer *fb = name ? table_find(&st->share->framebuffers, name) : NULL;

		if (!fb)
			continue;
		settle(x, st->share, fb);
		if (st->draw_framebuffer == name)
			bind_draw(x, st, 0);
		if (st->read_framebuffer == name)
			bind_read(x, st, 0);
		gls_framebuffer_free(table_remove(&st->share->framebuffers, name));
	}
}

static void attach(struct gls_exec *x, struct gls_state *st, const struct call *c, const struct gls_attachment *a)
{
	uint32_t name = arg_u(c, 0) == GL_READ_FRAMEBUFFER ? st->read_framebuffer : st->draw_framebuffer, point = arg_u(c, 1);
	struct gls_texture *t = a->texture ? table_find(&st->share->textures, a->texture) : NULL;
	struct gls_framebuffer *fb = name ? find(x, st, name) : NULL;
	int color = color_of(point);

	if (!fb || (a->texture && (!t || a->level >= GLS_MAX_LEVELS))) {
		gls_error(x, st, GL_INVALID_OPERATION);
		return;
	}
	changes(x, st);
	if (!x->want)
		gls_framebuffer_touch(x, st);
	settle(x, st->share, fb);
	if (t)
		t->attached = 1;
	if (color >= 0)
		fb->attached[color] = *a;
	if (point == GL_DEPTH_ATTACHMENT || point == GL_DEPTH_STENCIL_ATTACHMENT)
		fb->attached[DEPTH] = *a;
	if (point == GL_STENCIL_ATTACHMENT || point == GL_DEPTH_STENCIL_ATTACHMENT)
		fb->attached[STENCIL] = *a;
}

static void attach_texture(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t texture, uint32_t face,
                           uint32_t level, uint32_t layer)
{
	attach(x, st, c, &(struct gls_attachment){ texture, 0, texture ? face : 0, texture ? level : 0, texture ? layer : 0 });
}

static void attach_image(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t layer)
{
	unsigned face = 0;

	if (arg_u(c, 3) && gls_texture_target_of(arg_u(c, 2), &face) < 0)
		gls_error(x, st, GL_INVALID_ENUM);
	else
		attach_texture(x, st, c, arg_u(c, 3), face, arg_u(c, 4), layer);
}

GLS_HANDLER(glFramebufferTexture1D, NOW) { attach_image(x, st, c, 0); }
GLS_HANDLER(glFramebufferTexture2D, NOW) { attach_image(x, st, c, 0); }
GLS_HANDLER(glFramebufferTexture3D, NOW) { attach_image(x, st, c, arg_u(c, 5)); }
GLS_HANDLER(glFramebufferTextureLayer, NOW) { attach_texture(x, st, c, arg_u(c, 2), 0, arg_u(c, 3), arg_u(c, 4)); }
GLS_HANDLER(glFramebufferRenderbuffer, NOW) { attach(x, st, c, &(struct gls_attachment){ .renderbuffer = arg_u(c, 3) }); }

GLS_HANDLER(glBindRenderbuffer, NOW)
{
	uint32_t name = arg_u(c, 1);
	struct gls_renderbuffer *r;

	st->renderbuffer = name;
	if (!name || table_find(&st->share->renderbuffers, name))
		return;
	r = calloc(1, sizeof(*r));
	if (!r || table_set(&st->share->renderbuffers, name, r)) {
		free(r);
		gls_out_of_memory(x, sizeof(*r));
	}
}
GLS_HANDLER(glBindRenderbufferEXT, NOW) { gls_glBindRenderbuffer(x, st, c); }

GLS_HANDLER(glDeleteRenderbuffers, NOW)
{
	uint64_t n;
	const struct trace_value *names = arg_items(c, 1, &n);

	changes(x, st);
	for (uint64_t i = 0; i < n; i++) {
		uint32_t name = (uint32_t)gls_value_int(&names[i]);

		if (!name)
			continue;
		detach(x, st, &(struct gls_attachment){ .renderbuffer = name });
		gls_renderbuffer_free(table_remove(&st->share->renderbuffers, name));
		if (st->renderbuffer == name)
			st->renderbuffer = 0;
	}
}

static void storage(struct gls_exec *x, struct gls_state *st, uint32_t format, int64_t width, int64_t height, int64_t samples)
{
	struct gls_renderbuffer *r = st->renderbuffer ? table_find(&st->share->renderbuffers, st->renderbuffer) : NULL;

	if (!r || width < 0 || height < 0 || width > 16384 || height > 16384 || samples < 0) {
		gls_error(x, st, r ? GL_INVALID_VALUE : GL_INVALID_OPERATION);
		return;
	}
	if (samples > 1 && gls_format_is_float(format))
		gls_unsupported(x, "floats of several samples a pixel: their means are clamped");
	changes(x, st);
	settle_sharing(x, st->share, &(struct gls_attachment){ .renderbuffer = st->renderbuffer }, NULL);
	gls_picture_release(r->content);
	*r = (struct gls_renderbuffer){ .internal_format = format, .width = (uint32_t)width, .height = (uint32_t)height,
	                                .samples = samples > 0 ? SCENE_SAMPLES : 0 }; /* no driver gives fewer than are asked for */
}

GLS_HANDLER(glRenderbufferStorage, NOW) { storage(x, st, arg_u(c, 1), arg_i(c, 2), arg_i(c, 3), 0); }
GLS_HANDLER(glRenderbufferStorageMultisample, NOW)
{
	if (arg_i(c, 1) > SCENE_SAMPLES)
		gls_unsupported(x, "more than four samples a pixel: four are taken");
	storage(x, st, arg_u(c, 2), arg_i(c, 3), arg_i(c, 4), arg_i(c, 1));
}

/* ---- BlitFramebuffer (GL 3.0 sec. 4.3.2): a pixel rectangle that only the scissor touches ---- */

struct blit {
	int64_t from[4]; /* x0 y0 x1 y1, ascending */
	float left, low, zoom[2];
};

static void blit_one(struct gls_exec *x, struct gls_state *st, const struct blit *b, uint32_t kind, const struct scene_picture *p)
{
	uint32_t width = (uint32_t)(b->from[2] - b->from[0]), height = (uint32_t)(b->from[3] - b->from[1]);
	size_t bytes = kind == SCENE_FLOAT_PIXELS ? 16 : 4;
	uint8_t *texels = gls_scratch(x, (size_t)width * height * bytes);

	for (uint32_t i = 0; texels && i < width * height; i++) {
		int64_t px = b->from[0] + i % width, py = b->from[1] + i / width;
		size_t at = (size_t)(py * p->width + px);
		uint32_t stencil;
		float depth, v[4];

		memset(texels + bytes * i, 0, bytes);
		if (px < 0 || py < 0 || px >= p->width || py >= p->height)
			continue;
		stencil = p->stencil[at];
		depth = p->depth_bits ? (float)p->depth[at] / (float)((1u << p->depth_bits) - 1) : 1;
		gls_picture_color(p, at, v);
		memcpy(texels + bytes * i, kind == SCENE_COLOR_PIXELS ? (const void *)(p->rgba + 4 * at) : kind == SCENE_FLOAT_PIXELS ? v :
		                           kind == SCENE_DEPTH_PIXELS ? (const void *)&depth : (const void *)&stencil, bytes);
	}
	if (texels)
		gls_draw_rectangle_plainly(x, st, kind, b->left, b->low, width, height, b->zoom, texels);
}

/* One direction: the source's lower end, the place of it, and how much larger it gets. @return 0 where nothing is left */
static int span(int64_t s0, int64_t s1, int64_t d0, int64_t d1, int64_t *from, int64_t *to, float *start, float *zoom)
{
	*from = s0 < s1 ? s0 : s1;
	*to = s0 < s1 ? s1 : s0;
	*start = (float)(s0 < s1 ? d0 : d1);
	*zoom = s0 == s1 ? 0 : (float)(d1 - d0) / (float)(s1 - s0);
	return s0 != s1 && d0 != d1 && *to - *from <= 16384;
}

GLS_HANDLER(glBlitFramebuffer, NOW)
{
	struct blit b;
	uint32_t mask = arg_u(c, 8), color_mask = st->a.color.mask;
	const struct scene_picture *p;

	changes(x, st);
	if (!span(arg_i32(c, 0), arg_i32(c, 2), arg_i32(c, 4), arg_i32(c, 6), &b.from[0], &b.from[2], &b.left, &b.zoom[0]) ||
	    !span(arg_i32(c, 1), arg_i32(c, 3), arg_i32(c, 5), arg_i32(c, 7), &b.from[1], &b.from[3], &b.low, &b.zoom[1]))
		return;
	if (!x->want)
		return;
	if (arg_u(c, 9) == GL_LINEAR && (fabsf(b.zoom[0]) != 1 || fabsf(b.zoom[1]) != 1))
		gls_unsupported(x, "linear filtering: the nearest pixel is taken");
	p = gls_read_screen(x, st);
	if (!p)
		return;
	st->a.color.mask = 15;
	if (mask & GL_COLOR_BUFFER_BIT)
		blit_one(x, st, &b, gls_color_pixels(x, st), p);
	if (mask & GL_DEPTH_BUFFER_BIT)
		blit_one(x, st, &b, SCENE_DEPTH_PIXELS, p);
	if (mask & GL_STENCIL_BUFFER_BIT)
		blit_one(x, st, &b, SCENE_STENCIL_PIXELS, p);
	st->a.color.mask = color_mask;
}
