/* Ends of frames: a frame is shown, deferred or skipped. */
#include "replay/gl/surface/frames.h"

#include "replay/build/frame.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/surface/front.h"
#include "replay/gl/surface/screen.h"
#include "replay/gl/surface/surface.h"
#include "replay/machine/machine.h"
#include "scene/release.h"

/*
 * Most events of deferred frames before their scene ends. Each frame may draw over the previous one, and many fragments
 * per pixel take longer than intermediate pictures: a frame of 4 draws over 800 x 600 pixels takes 67 ms with 2^14, 39
 * with 2^7, 33 with 2^5.
 */
#define MANY_EVENTS 64u

static struct gls_drawable *swapped(struct gls_exec *x)
{
	const struct gls_state none = { 0 };

	return gls_window_of(x, x->st ? x->st : &none, x->swapped);
}

/* The surface that a finished frame shows: the back buffer, unless it ended without a swap and drew to the front. */
static struct gls_surface *shown(struct gls_exec *x, struct gls_drawable *d)
{
	return x->unswapped && x->st && gls_front_is_drawn(x->st) ? gls_front_part(x, d) : &d->surface;
}

struct scene *gls_frame_finish(struct gls_exec *x)
{
	struct gls_drawable *d = swapped(x);
	struct scene *s = d ? gls_surface_end(x, shown(x, d), 1) : NULL;

	if (s)
		s->shows_earlier |= (uint32_t)x->feedback.shows_earlier;
	x->feedback.shows_earlier = 0;
	if (s && !x->unswapped)
		gls_front_swapped(d);
	return s;
}

static void end_deferred(struct gls_exec *x, struct gls_surface *surface)
{
	struct scene *s = surface->deferred ? gls_surface_end(x, surface, 0) : NULL;

	scene_release(&s);
}

void gls_frame_defer(struct gls_exec *x)
{
	struct gls_drawable *d = swapped(x);
	struct gls_surface *surface = d ? shown(x, d) : NULL;

	if (!surface)
		return;
	surface->deferred |= surface->frame != NULL;
	if (gls_frame_events(surface) > MANY_EVENTS || (x->feedback.fronts && !x->unswapped))
		end_deferred(x, surface);
	if (!x->unswapped)
		gls_front_swapped(d);
}

void gls_frame_end_deferred(struct gls_exec *x)
{
	for (size_t i = 0; i < x->drawables.room; i++) {
		struct gls_drawable *d = x->drawables.entries[i].value;

		if (!d)
			continue;
		end_deferred(x, &d->surface);
		if (d->parted)
			end_deferred(x, &d->front);
	}
}

int gls_frame_settle(struct gls_exec *x)
{
	int settled = x->feedback.supply && !x->feedback.fronts;

	for (size_t i = 0; i < x->n_contexts && settled; i++)
		settled = !gls_framebuffers_wait(x->contexts[i]->state.share);
	for (size_t i = 0; i < x->drawables.room && settled; i++) {
		struct gls_drawable *d = x->drawables.entries[i].value;

		if (!d)
			continue;
		settled = !d->parted && !d->accum && !d->accum_missing && !gls_surface_is_unknown(x, &d->surface);
		if (settled)
			end_deferred(x, &d->surface);
		settled = settled && gls_surface_settle(x, &d->surface);
	}
	return settled && !x->failed && !x->feedback.rewind;
}

void gls_frame_skip(struct gls_exec *x)
{
	for (size_t i = 0; i < x->n_contexts; i++)
		if (x->contexts[i]->state.draw_framebuffer)
			gls_framebuffer_skip(x, &x->contexts[i]->state);
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
