/*
 * Pixels that feed back: what was drawn, needed as pixels (screen copies, frames that are not cleared, framebuffer
 * objects). They are rendered by whoever set a supplier (replay.h), from the scene of all events so far, and only when
 * somebody asks.
 *
 * A frame may show what the one before left. What a drawable held at the beginning of a frame is therefore kept: as a
 * picture where one was made, else as the scene that would make it. Where frames were skipped it is not known; the frame
 * that turns out to need it sets x->feedback.rewind, and replay.c starts again and builds every frame.
 */
#include "replay/gl/surface/feedback.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "replay/build/frame.h"
#include "replay/gl/dispatch.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/surface/front.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"
#include "replay/replay.h"

#define MANY_EVENTS (1u << 14) /* of frames that nobody wants: bundled, so that they do not pile up */

/* ---- pictures ---- */

static void free_arrays(struct scene_picture *p)
{
	free(p->rgba);
	free(p->colors);
	free(p->depth);
	free(p->stencil);
}

void gls_picture_release(struct gls_picture *p)
{
	if (!p || atomic_fetch_sub(&p->refs, 1) != 1)
		return;
	for (int i = 0; i < SCENE_SAMPLES && p->picture.samples; i++)
		free_arrays(&p->picture.samples[i]);
	free(p->picture.samples);
	free_arrays(&p->picture);
	free(p);
}

static struct gls_picture *reference(struct gls_picture *p)
{
	if (p)
		atomic_fetch_add(&p->refs, 1);
	return p;
}

/* Black, far and 0. @return 0: out of memory, with whatever was allocated */
static int make_arrays(struct scene_picture *p, uint32_t width, uint32_t height, uint32_t depth_bits, uint32_t alpha_bits,
                       uint32_t floats)
{
	size_t n = (size_t)width * height, room = n + !n;
	uint32_t bits = depth_bits > 24 ? 24 : depth_bits, far = (1u << bits) - 1;

	p->width = width;
	p->height = height;
	p->depth_bits = bits;
	p->rgba = calloc(room, 4);
	p->depth = malloc(room * sizeof(*p->depth));
	p->stencil = calloc(room, 1);
	p->colors = floats ? calloc(room, 4 * sizeof(*p->colors)) : NULL;
	if (!p->rgba || !p->depth || !p->stencil || (floats && !p->colors))
		return 0;
	for (size_t i = 0; i < n; i++) {
		p->depth[i] = far;
		p->rgba[4 * i + 3] = alpha_bits ? 0 : 255;
		if (floats)
			p->colors[4 * i + 3] = alpha_bits ? 0 : 1;
	}
	return 1;
}

struct gls_picture *gls_picture_make(struct gls_exec *x, uint32_t width, uint32_t height, uint32_t depth_bits,
                                     uint32_t alpha_bits, uint32_t samples, uint32_t floats)
{
	struct gls_picture *p = calloc(1, sizeof(*p));
	int good = p != NULL;

	if (p) {
		atomic_init(&p->refs, 1);
		good = make_arrays(&p->picture, width, height, depth_bits, alpha_bits, floats);
		if (samples > 1)
			good &= (p->picture.samples = calloc(SCENE_SAMPLES, sizeof(*p->picture.samples))) != NULL;
		for (int i = 0; i < SCENE_SAMPLES && p->picture.samples; i++)
			good &= make_arrays(&p->picture.samples[i], width, height, depth_bits, alpha_bits, floats);
	}
	if (!good) {
		gls_picture_release(p);
		gls_out_of_memory(x, (size_t)width * height * 9);
		return NULL;
	}
	return p;
}

void gls_picture_color(const struct scene_picture *p, size_t place, float out[4])
{
	for (unsigned i = 0; i < 4; i++)
		out[i] = p->colors ? p->colors[4 * place + i] : (float)p->rgba[4 * place + i] / 255;
}

uint32_t gls_color_pixels(struct gls_exec *x, struct gls_state *st)
{
	const struct gls_surface *s = gls_surface_of(x, st);

	return s && s->floats ? SCENE_FLOAT_PIXELS : SCENE_COLOR_PIXELS;
}

/* What a scene shows. NULL: it cannot be had */
static struct gls_picture *render(struct gls_exec *x, const struct scene *s)
{
	struct gls_picture *p = gls_picture_make(x, s->width, s->height, s->depth_bits, s->alpha_bits, s->samples, s->floats);

	if (!p || !s->width || !s->height)
		return p;
	if (x->feedback.supply(x->feedback.supply_user, s, &p->picture) != 0) {
		if (!x->failed)
			x->failed = ERR_SYSTEM; /* reported by the supplier */
		gls_picture_release(p);
		return NULL;
	}
	return p;
}

/* ---- surfaces ---- */

static void forget(struct gls_surface *surface)
{
	gls_picture_release(surface->picture);
	surface->picture = NULL;
	scene_release(&surface->before);
}

void gls_surface_free(struct gls_surface *surface)
{
	gls_frame_drop(surface);
	forget(surface);
}

void gls_surface_share(struct gls_surface *to, const struct gls_surface *from)
{
	to->picture = reference(from->picture);
	to->before = from->before ? gls_scene_reference(from->before) : NULL;
	to->skipped = from->skipped;
	to->carried = from->carried;
}

static void describe(struct gls_surface *s, const struct gls_drawable *d, const struct gls_state *st)
{
	if (s->carried && (s->width != d->width || s->height != d->height)) {
		gls_surface_free(s); /* a window of another size has nothing of the old one's */
		s->carried = 0;
	}
	s->width = d->width;
	s->height = d->height;
	s->depth_bits = st->depth_bits;
	s->stencil_bits = st->stencil_bits;
	s->alpha_bits = st->alpha_bits;
	s->samples = st->samples;
}

static struct gls_drawable *window(struct gls_exec *x, struct gls_state *st, uint64_t name)
{
	struct gls_drawable *d = gls_drawable_of(x, name);

	if (!d)
		return NULL;
	describe(&d->surface, d, st);
	describe(&d->front, d, st);
	return d;
}

struct gls_surface *gls_surface_of(struct gls_exec *x, struct gls_state *st)
{
	struct gls_drawable *d;

	if (st->draw_framebuffer)
		return gls_framebuffer_surface(x, st);
	d = window(x, st, st->drawable);
	return d ? &d->surface : NULL;
}

static int has_size(const struct scene_picture *p, const struct scene *s)
{
	return p->width == s->width && p->height == s->height;
}

/* A window of another size has nothing of the old one's, even where its size has changed within a frame. */
static void check_size(struct gls_surface *surface, struct scene *s)
{
	if ((surface->picture && !has_size(&surface->picture->picture, s)) ||
	    (surface->before && (surface->before->width != s->width || surface->before->height != s->height)))
		forget(surface);
	if (s->start && !has_size(s->start, s)) {
		gls_picture_release((struct gls_picture *)(uintptr_t)s->start);
		s->start = NULL;
	}
}

/*
 * Give the scene of a surface what was there before it, where that shows through.
 * @param snapshot  receives what the scene makes where that had to be found out, or NULL: a reference for the caller
 * @return 1 the scene is whole; 0 it is not, and cannot be made so now
 */
static int find_start(struct gls_exec *x, struct gls_surface *surface, struct scene *s, struct gls_picture **snapshot)
{
	*snapshot = NULL;
	check_size(surface, s);
	if (!s->needs_previous || s->start || (!surface->picture && !surface->before && !surface->skipped))
		return 1;
	if (!surface->picture) {
		/* It may be that nothing shows through: a sky over all of it. */
		int try = s->n_instances && !(x->feedback.shows_through && surface->before);

		if (try && !(*snapshot = render(x, s)))
			return 0;
		if (*snapshot && !(*snapshot)->picture.unknown) {
			gls_frame_all_known(surface);
			return 1;
		}
		x->feedback.shows_through |= try;
		gls_picture_release(*snapshot);
		*snapshot = NULL;
		if (surface->skipped) {
			x->feedback.rewind = 1;
			x->feedback.fronts |= surface->is_front;
			return 0;
		}
		surface->picture = render(x, surface->before);
		scene_release(&surface->before);
		if (!surface->picture)
			return 0;
	}
	s->start = &reference(surface->picture)->picture;
	return 1;
}

const struct scene_picture *gls_surface_read(struct gls_exec *x, struct gls_surface *surface)
{
	struct gls_picture **kept, *snapshot;
	uint64_t *events;
	struct scene *s;

	if (!x->want || !surface)
		return NULL;
	if (!x->feedback.supply) {
		gls_unsupported(x, "needs pixels that were drawn: only a renderer has them");
		return NULL;
	}
	s = gls_frame_scene(x, surface);
	if (!s)
		return NULL;
	kept = gls_frame_snapshot(surface, &events);
	if (*kept && *events == gls_frame_events(surface) && has_size(&(*kept)->picture, s))
		return &(*kept)->picture;
	if (!find_start(x, surface, s, &snapshot))
		return NULL;
	if (!snapshot)
		snapshot = s->start && !gls_frame_events(surface) ? reference((struct gls_picture *)(uintptr_t)s->start) :
		                                                    render(x, s);
	gls_picture_release(*kept);
	*kept = snapshot;
	*events = gls_frame_events(surface);
	return snapshot ? &snapshot->picture : NULL;
}

int gls_surface_restart(struct gls_exec *x, struct gls_surface *surface, struct gls_picture *picture)
{
	struct scene *s = gls_frame_scene(x, surface);
	struct gls_picture **kept;
	uint64_t *events;

	if (!s || !s->needs_previous) {
		gls_picture_release(picture);
		return 0;
	}
	kept = gls_frame_snapshot(surface, &events);
	gls_picture_release(*kept);
	*kept = NULL;
	if (s->start)
		gls_picture_release((struct gls_picture *)(uintptr_t)s->start);
	s->start = NULL;
	gls_frame_renew(x, surface);
	forget(surface);
	surface->picture = picture;
	return 1;
}

const struct scene_picture *gls_read_screen(struct gls_exec *x, struct gls_state *st)
{
	struct gls_drawable *d;

	gls_flush(x);
	if (st->read_framebuffer)
		return gls_framebuffer_read(x, st);
	d = window(x, st, st->read_drawable);
	return d ? gls_surface_read(x, gls_front_is_read(st) && x->want ? gls_front_part(x, d) : &d->surface) : NULL;
}

/* ---- ends of frames ---- */

/* End a surface's scene: what comes next begins from what it shows. @return a reference, or NULL */
static struct scene *end_scene(struct gls_exec *x, struct gls_surface *surface)
{
	struct gls_picture *snapshot = NULL;
	struct scene *s = gls_frame_scene(x, surface);

	if (!s || (x->feedback.supply && !find_start(x, surface, s, &snapshot)))
		return NULL;
	s = gls_frame_take(x, surface);
	forget(surface);
	surface->skipped = surface->carried = 0;
	if (snapshot)
		surface->picture = snapshot;
	else if (x->feedback.supply)
		surface->before = gls_scene_reference(s);
	return s;
}

static struct gls_drawable *swapped(struct gls_exec *x)
{
	struct gls_state none = { .drawable = x->swapped };

	return window(x, x->st ? x->st : &none, x->swapped);
}

/* What the frame that has ended shows. */
static struct gls_surface *shown(struct gls_exec *x, struct gls_drawable *d)
{
	return x->unswapped && x->st && gls_front_is_drawn(x->st) ? gls_front_part(x, d) : &d->surface;
}

struct scene *gls_frame_finish(struct gls_exec *x)
{
	struct gls_drawable *d = swapped(x);
	struct scene *s = d ? end_scene(x, shown(x, d)) : NULL;

	if (s && !x->unswapped)
		gls_front_swapped(d);
	return s;
}

static void bundle(struct gls_exec *x, struct gls_surface *surface)
{
	struct scene *s = surface->carried ? end_scene(x, surface) : NULL;

	scene_release(&s);
}

void gls_frame_carry(struct gls_exec *x)
{
	struct gls_drawable *d = swapped(x);
	struct gls_surface *surface = d ? shown(x, d) : NULL;

	if (!surface)
		return;
	surface->carried |= surface->frame != NULL;
	if (gls_frame_events(surface) > MANY_EVENTS || (x->feedback.fronts && !x->unswapped))
		bundle(x, surface);
	if (!x->unswapped)
		gls_front_swapped(d);
}

void gls_frame_stop_carrying(struct gls_exec *x)
{
	for (size_t i = 0; i < x->drawables.room; i++) {
		struct gls_drawable *d = x->drawables.entries[i].value;

		if (!d)
			continue;
		bundle(x, &d->surface);
		if (d->parted)
			bundle(x, &d->front);
	}
}

void gls_frame_skip(struct gls_exec *x)
{
	for (size_t i = 0; i < x->n_contexts; i++)
		if (x->contexts[i]->state.draw_framebuffer)
			gls_framebuffer_touch(x, &x->contexts[i]->state);
	for (size_t i = 0; i < x->drawables.room; i++) {
		struct gls_drawable *d = x->drawables.entries[i].value;

		if (!d)
			continue;
		gls_surface_free(&d->surface);
		gls_surface_free(&d->front);
		d->surface.skipped = d->front.skipped = 1;
		d->parted = 0;
	}
}
