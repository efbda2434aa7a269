/*
 * Framebuffer objects: render to texture.
 *
 * Attachments have the actual contents. An object only collects events; they are rendered and stored in its attachments
 * when something reads one of these. Later events start from the attachments. A frame that is not built leaves them
 * missing, as with a screen copy (copytex.c).
 */
#include "replay/gl/surface/framebuffer.h"

#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "replay/gl/surface/surface.h"
#include "replay/gl/texture/level.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/picture.h"
#include "replay/programs/program.h"
#include "scene/release.h"

#define MANY_EVENTS (1u << 16) /* most events an object collects before they are stored in its attachments */

enum { DEPTH = GLS_ATTACHMENT_DEPTH, STENCIL = GLS_ATTACHMENT_STENCIL };

/* ---- updating attachments ---- */

/* Bit set of colours (1 << number): a draw buffer and others. */
static uint32_t colors_of(uint32_t buffer, uint32_t others)
{
	int color = gls_attachment_color(buffer);

	return (others & ~GLS_OUT_OF_ORDER) | (color >= 0 ? 1u << color : 0);
}

/* The colours that the collected events draw to. */
static uint32_t drawn_colors(const struct gls_framebuffer *fb)
{
	return colors_of(fb->drawn_buffer, fb->drawn_too);
}

/*
 * Render the events, and store the result in the attachments. Fixed function sends the same fragments to all colours
 * (GL 2.1 sec. 3.11.2), shaders may send different ones. If these differ, or earlier contents show through, the events
 * are rendered once for each colour. Depth and stencil are the same each time. Without colour attachments, their
 * earlier contents are not needed.
 */
static void update_colors(struct gls_exec *x, const struct gls_share *share, struct gls_framebuffer *fb)
{
	struct gls_surface *s = &fb->surface;
	uint32_t left = drawn_colors(fb), others = 1u << DEPTH | 1u << STENCIL;
	int color = left ? __builtin_ctz(left) : -1, loads = x->want && x->feedback.supply, shows = 1;
	const struct gls_area depths = { { 0, 0, (int32_t)s->width, (int32_t)s->height },
		                         (s->depth_bits ? 2u : 0) | (s->stencil_bits ? 4u : 0) };
	const struct scene_picture *p = NULL;

	if (loads && !(s->picture = gls_attachments_load(x, share, fb->attached, color, s, NULL)))
		s->skipped = 1;
	p = gls_surface_read(x, s, left ? NULL : &depths);
	for (left &= left - 1; left && p; left &= left - 1) {
		struct gls_picture *next;

		gls_attachments_store(x, share, fb->attached, 1u << color, p);
		color = __builtin_ctz(left);
		if (!shows)
			continue;
		if (!(next = gls_attachments_load(x, share, fb->attached, color, s, NULL)))
			s->skipped = 1;
		if ((shows = gls_surface_restart(x, s, next)))
			p = gls_surface_read(x, s, NULL);
	}
	gls_attachments_store(x, share, fb->attached,
	                      p ? others | (color >= 0 ? 1u << color : 0) : others | drawn_colors(fb), p);
}

/* The only colour attachment that a frame's events drew to, if it has 8 bits per channel; else NULL. */
static const struct gls_attachment *only_color(const struct gls_share *share, const struct gls_framebuffer *fb)
{
	const uint32_t colors = drawn_colors(fb);
	const struct gls_attachment *a = colors && !(colors & (colors - 1)) ? &fb->attached[__builtin_ctz(colors)] : NULL;

	return a && gls_attachment_has_8_bits(share, a) ? a : NULL;
}

struct gls_drawn gls_texture_drawn(const struct gls_texture *t)
{
	if (t && t->drawn)
		return (struct gls_drawn){ .scene = gls_scene_reference(t->drawn) };
	return t && t->drawn_lost ? (struct gls_drawn){ NULL, t->levels[0][0].width, t->levels[0][0].height } :
	                            (struct gls_drawn){ NULL };
}

/* The draws that made an object's only colour attachment; a texture with this as its level 0 keeps them. */
static struct gls_drawn drawn_by(struct gls_exec *x, const struct gls_share *share, struct gls_framebuffer *fb)
{
	const struct gls_attachment *color = only_color(share, fb);
	struct gls_texture *t = color && color->texture && !color->level && !color->face && !color->layer ?
	                                table_find(&share->textures, color->texture) :
	                                NULL;
	struct scene *drawn = color && gls_frame_events(&fb->surface) ? gls_frame_scene(x, &fb->surface) : NULL;

	if (t && drawn) {
		scene_release(&t->drawn);
		t->drawn = gls_scene_reference(drawn);
		t->drawn_lost = 0;
	}
	return drawn ? (struct gls_drawn){ .scene = gls_scene_reference(drawn) } : gls_texture_drawn(t);
}

/* Render an object's events, if any, and start over. @return its draws */
static struct gls_drawn update_drawn(struct gls_exec *x, const struct gls_share *share, struct gls_framebuffer *fb)
{
	struct gls_surface *s = &fb->surface;
	struct gls_drawn drawn;

	if (s->frame && gls_frame_events(s) && gls_attachments_describe(share, fb->attached, drawn_colors(fb), s))
		update_colors(x, share, fb);
	drawn = drawn_by(x, share, fb);
	if (s->frame) {
		gls_surface_free(s);
		s->skipped = 0;
	}
	return drawn;
}

static void update(struct gls_exec *x, const struct gls_share *share, struct gls_framebuffer *fb)
{
	struct gls_drawn drawn = { NULL };

	if (fb->surface.frame)
		drawn = update_drawn(x, share, fb);
	scene_release(&drawn.scene);
}

struct gls_drawn gls_framebuffer_drawn(struct gls_exec *x, const struct gls_state *st, uint32_t name)
{
	struct gls_framebuffer *fb = table_find(&st->share->framebuffers, name);
	const int read = gls_attachment_color(st->a.pixel.read_buffer);

	if (!fb || read < 0 || drawn_colors(fb) != 1u << read)
		return (struct gls_drawn){ NULL };
	return update_drawn(x, st->share, fb);
}

/* Update all objects except one (NULL: all) that share this attachment. */
static void update_sharing(struct gls_exec *x, const struct gls_share *share, const struct gls_attachment *what,
                           const struct gls_framebuffer *but)
{
	for (size_t i = 0; i < share->framebuffers.room; i++) {
		struct gls_framebuffer *fb = share->framebuffers.entries[i].value;
		int found = 0;

		if (!fb || fb == but || !fb->surface.frame)
			continue;
		for (int k = 0; k < N_GLS_ATTACHMENTS; k++)
			found |= gls_attachment_is_same(&fb->attached[k], what);
		if (found)
			update(x, share, fb);
	}
}

void gls_texture_update(struct gls_exec *x, const struct gls_state *st, const struct gls_texture *t)
{
	if (t && t->attached)
		update_sharing(x, st->share, &(struct gls_attachment){ .texture = t->name }, NULL);
}

void gls_units_update(struct gls_exec *x, struct gls_state *st, const struct gls_texturing *texturing)
{
	struct program_stage stage;
	const int runs = gls_program_runs_fragments(st, &stage);

	for (unsigned u = 0; st->share->framebuffers.n && u < GLS_MAX_UNITS; u++)
		for (unsigned target = 0; target < N_GLS_TEXTURE_TARGETS; target++)
			if (texturing->units[u].enabled >> target & 1 || (runs && program_target(&stage, u) == target + 1))
				gls_texture_update(x, st, gls_texture_bound(x, st, u, target));
}

/* ---- drawing and reading ---- */

static struct gls_framebuffer *find(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_framebuffer *fb = table_find(&st->share->framebuffers, name);

	if (fb)
		return fb;
	fb = gls_object_create(x, &st->share->framebuffers, name, sizeof(*fb));
	if (!fb)
		return NULL;
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
		update(x, st->share, fb);
	fb->drawn_buffer = st->a.color.draw_buffer;
	fb->drawn_too = st->a.color.also_drawn;
	if (!gls_attachments_describe(st->share, fb->attached, drawn_colors(fb), &fb->surface))
		return NULL;
	for (int i = 0; !fb->surface.frame && i < N_GLS_ATTACHMENTS; i++)
		update_sharing(x, st->share, &fb->attached[i], fb);
	return &fb->surface;
}

const struct scene_picture *gls_framebuffer_read(struct gls_exec *x, struct gls_state *st, const struct gls_area *area)
{
	struct gls_framebuffer *fb = find(x, st, st->read_framebuffer);
	uint32_t buffer = st->a.pixel.read_buffer;

	if (!fb || !x->want)
		return NULL;
	update(x, st->share, fb);
	for (int i = 0; i < N_GLS_ATTACHMENTS; i++)
		update_sharing(x, st->share, &fb->attached[i], fb);
	gls_picture_release(fb->read);
	fb->read = NULL;
	if (!gls_attachments_describe(st->share, fb->attached, colors_of(buffer, 0), &fb->surface))
		return NULL;
	fb->read = gls_attachments_load(x, st->share, fb->attached, gls_attachment_color(buffer), &fb->surface, area);
	if (!fb->read && !x->failed && x->feedback.supply)
		gls_rewind(x, "a framebuffer object has what they drew");
	return fb->read ? &fb->read->picture : NULL;
}

void gls_framebuffer_skip(struct gls_exec *x, struct gls_state *st)
{
	struct gls_framebuffer *fb = find(x, st, st->draw_framebuffer);

	if (!fb || !st->draw_framebuffer)
		return;
	gls_surface_free(&fb->surface);
	fb->drawn_buffer = st->a.color.draw_buffer;
	fb->drawn_too = st->a.color.also_drawn;
	gls_attachments_store(x, st->share, fb->attached, 1u << DEPTH | 1u << STENCIL | drawn_colors(fb), NULL);
}

int gls_framebuffers_wait(const struct gls_share *share)
{
	for (size_t i = 0; i < share->framebuffers.room; i++) {
		const struct gls_framebuffer *fb = share->framebuffers.entries[i].value;

		if (fb && gls_frame_events(&fb->surface))
			return 1;
	}
	return 0;
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

/* Detach a deleted texture or renderbuffer. */
static void detach(struct gls_exec *x, struct gls_state *st, const struct gls_attachment *what)
{
	update_sharing(x, st->share, what, NULL);
	for (size_t i = 0; i < st->share->framebuffers.room; i++) {
		struct gls_framebuffer *fb = st->share->framebuffers.entries[i].value;

		for (int k = 0; fb && k < N_GLS_ATTACHMENTS; k++)
			if (gls_attachment_is_same(&fb->attached[k], what))
				memset(&fb->attached[k], 0, sizeof(fb->attached[k]));
	}
}

/* Each object has a draw buffer and a read buffer of its own. */
static void bind_draw(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_framebuffer *old = find(x, st, st->draw_framebuffer), *fb = find(x, st, name);

	if (!old || !fb)
		return;
	if (!x->want)
		gls_framebuffer_skip(x, st);
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

static void bind_framebuffer(struct gls_exec *x, struct gls_state *st, uint32_t target, uint32_t name)
{
	if (gls_refuses(x, st,
	                target != GL_FRAMEBUFFER && target != GL_DRAW_FRAMEBUFFER && target != GL_READ_FRAMEBUFFER,
	                GL_INVALID_ENUM))
		return;
	if (target != GL_READ_FRAMEBUFFER)
		bind_draw(x, st, name);
	if (target != GL_DRAW_FRAMEBUFFER)
		bind_read(x, st, name);
}

GLS_HANDLER(glBindFramebuffer, OBJECT) { bind_framebuffer(x, st, arg_u(c, 0), arg_u(c, 1)); }
GLS_HANDLER(glBindFramebufferEXT, OBJECT) { bind_framebuffer(x, st, arg_u(c, 0), arg_u(c, 1)); }

GLS_HANDLER(glDeleteFramebuffers, OBJECT)
{
	uint64_t at = 0;

	for (uint32_t name; (name = arg_next_name(c, 1, &at));) {
		struct gls_framebuffer *fb = table_find(&st->share->framebuffers, name);

		if (!fb)
			continue;
		update(x, st->share, fb);
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
	struct gls_attachment kept = { 0 }; /* texture 0 detaches, whatever the level */
	int color = gls_attachment_color(point);

	if (gls_refuses(x, st,
	                color < 0 && point != GL_DEPTH_ATTACHMENT && point != GL_STENCIL_ATTACHMENT &&
	                        point != GL_DEPTH_STENCIL_ATTACHMENT,
	                GL_INVALID_ENUM))
		return;
	if (gls_refuses(x, st, !fb || (a->texture && (!t || a->level >= GLS_MAX_LEVELS)), GL_INVALID_OPERATION))
		return;
	if (!x->want)
		gls_framebuffer_skip(x, st);
	update(x, st->share, fb);
	if (t)
		t->attached = 1;
	if (a->texture || a->renderbuffer)
		kept = *a;
	if (color >= 0)
		fb->attached[color] = kept;
	if (point == GL_DEPTH_ATTACHMENT || point == GL_DEPTH_STENCIL_ATTACHMENT)
		fb->attached[DEPTH] = kept;
	if (point == GL_STENCIL_ATTACHMENT || point == GL_DEPTH_STENCIL_ATTACHMENT)
		fb->attached[STENCIL] = kept;
}

GLS_FAMILY(glFramebufferTexture, OBJECT)
{
	uint32_t layer = gls_commands[x->command].suffix.n == 3 ? arg_u(c, 5) : 0;
	const struct gls_texture *t = arg_u(c, 3) ? table_find(&st->share->textures, arg_u(c, 3)) : NULL;
	unsigned face = 0;
	const int target = gls_texture_target_of(arg_u(c, 2), &face);

	if (!gls_refuses(x, st, arg_u(c, 3) && target < 0, GL_INVALID_ENUM) &&
	    !gls_refuses(x, st, t && (int)t->target != target, GL_INVALID_OPERATION) &&
	    !gls_refuses(x, st, t && arg_i32(c, 4) < 0, GL_INVALID_VALUE))
		attach(x, st, c, &(struct gls_attachment){ arg_u(c, 3), 0, face, arg_u(c, 4), layer });
}

GLS_HANDLER(glFramebufferTextureLayer, OBJECT)
{
	attach(x, st, c, &(struct gls_attachment){ arg_u(c, 2), 0, 0, arg_u(c, 3), arg_u(c, 4) });
}
GLS_HANDLER(glFramebufferRenderbuffer, OBJECT)
{
	attach(x, st, c, &(struct gls_attachment){ .renderbuffer = arg_u(c, 3) });
}

static void bind_renderbuffer(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	const uint32_t name = arg_u(c, 1);

	if (gls_refuses(x, st, arg_u(c, 0) != GL_RENDERBUFFER, GL_INVALID_ENUM))
		return;
	st->renderbuffer = name;
	if (name && !table_find(&st->share->renderbuffers, name))
		gls_object_create(x, &st->share->renderbuffers, name, sizeof(struct gls_renderbuffer));
}

GLS_HANDLER(glBindRenderbuffer, NOW) { bind_renderbuffer(x, st, c); }
GLS_HANDLER(glBindRenderbufferEXT, NOW) { bind_renderbuffer(x, st, c); }

GLS_HANDLER(glDeleteRenderbuffers, OBJECT)
{
	uint64_t at = 0;

	for (uint32_t name; (name = arg_next_name(c, 1, &at));) {
		detach(x, st, &(struct gls_attachment){ .renderbuffer = name });
		gls_renderbuffer_free(table_remove(&st->share->renderbuffers, name));
		if (st->renderbuffer == name)
			st->renderbuffer = 0;
	}
}

static void storage(struct gls_exec *x, struct gls_state *st, uint32_t format, int64_t width, int64_t height,
                    int64_t samples)
{
	struct gls_renderbuffer *r = st->renderbuffer ? table_find(&st->share->renderbuffers, st->renderbuffer) : NULL;

	if (!r || width < 0 || height < 0 || width > 16384 || height > 16384 || samples < 0) {
		gls_error(x, st, r ? GL_INVALID_VALUE : GL_INVALID_OPERATION);
		return;
	}
	if (samples > 1 && gls_format_floats(format))
		gls_unsupported(x, "multisampled floats: their means are clamped");
	update_sharing(x, st->share, &(struct gls_attachment){ .renderbuffer = st->renderbuffer }, NULL);
	gls_picture_release(r->content);
	*r = (struct gls_renderbuffer){ .internal_format = format, .width = (uint32_t)width, .height = (uint32_t)height,
	/* drivers provide at least as many as requested */
	                                .samples = samples > 0 ? SCENE_SAMPLES : 0 };
}

GLS_HANDLER(glRenderbufferStorage, OBJECT) { storage(x, st, arg_u(c, 1), arg_i(c, 2), arg_i(c, 3), 0); }
GLS_HANDLER(glRenderbufferStorageMultisample, OBJECT)
{
	if (arg_i(c, 1) > SCENE_SAMPLES)
		gls_unsupported(x, "more than four samples per pixel: four are taken");
	storage(x, st, arg_u(c, 2), arg_i(c, 3), arg_i(c, 4), arg_i(c, 1));
}

/* ---- deletion of textures, which may be attached ---- */

GLS_HANDLER(glDeleteTextures, OBJECT)
{
	struct gls_texture *t;
	uint64_t at = 0;

	for (uint32_t name; (name = arg_next_name(c, 1, &at));) {
		detach(x, st, &(struct gls_attachment){ .texture = name });
		t = table_remove(&st->share->textures, name);
		st->share->epoch += t != NULL;
		gls_texture_free(t);
		for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
			for (unsigned target = 0; target < N_GLS_TEXTURE_TARGETS; target++)
				if (st->a.texturing.units[u].bound[target] == name)
					st->a.texturing.units[u].bound[target] = 0;
	}
}
