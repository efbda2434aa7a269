/* The surfaces that a context draws to and reads from: a framebuffer object, or a window's back or front buffer. */
#include "replay/gl/surface/screen.h"

#include "gl_tokens.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/surface/front.h"
#include "replay/gl/surface/surface.h"
#include "replay/machine/machine.h"

static void describe(struct gls_surface *s, const struct gls_drawable *d, const struct gls_state *st)
{
	if (s->deferred && (s->width != d->width || s->height != d->height)) {
		gls_surface_free(s); /* contents are lost if the window's size changes */
		s->deferred = 0;
	}
	s->width = d->width;
	s->height = d->height;
	s->depth_bits = st->depth_bits;
	s->stencil_bits = st->stencil_bits;
	s->alpha_bits = st->alpha_bits;
	s->srgb = st->srgb;
	s->samples = st->samples;
}

struct gls_drawable *gls_window_of(struct gls_exec *x, const struct gls_state *st, uint64_t name)
{
	struct gls_drawable *d = gls_drawable_of(x, name);

	if (!d)
		return NULL;
	describe(&d->surface, d, st);
	describe(&d->front, d, st);
	return d;
}

/* The surface that the context draws to; NULL: out of memory, or an incomplete framebuffer object. */
static struct gls_surface *surface_of(struct gls_exec *x, struct gls_state *st)
{
	struct gls_drawable *d;

	if (st->draw_framebuffer)
		return gls_framebuffer_surface(x, st);
	d = gls_window_of(x, st, st->drawable);
	return d ? &d->surface : NULL;
}

unsigned gls_targets_of(struct gls_exec *x, struct gls_state *st, struct gls_target out[2])
{
	struct gls_surface *surface = surface_of(x, st);
	int is_colored = st->a.color.draw_buffer != GL_NONE;
	struct gls_drawable *d;

	if (!surface)
		return 0;
	out[0] = (struct gls_target){ surface, is_colored };
	if (st->draw_framebuffer || !st->double_buffered)
		return 1;
	d = gls_drawable_of(x, st->drawable);
	if (!d->parted && !gls_front_is_drawn(st))
		return 1;
	out[0].colored = is_colored && !gls_front_alone_is_drawn(st);
	out[1] = (struct gls_target){ gls_front_part(x, d), gls_front_is_drawn(st) };
	return 2;
}

const struct scene_picture *gls_read_screen(struct gls_exec *x, struct gls_state *st, const struct gls_area *area)
{
	struct gls_drawable *d;

	if (st->read_framebuffer)
		return gls_framebuffer_read(x, st, area);
	d = gls_window_of(x, st, st->read_drawable);
	return d ? gls_surface_read(x, gls_front_is_read(st) && x->want ? gls_front_part(x, d) : &d->surface, area) : NULL;
}

uint32_t gls_color_pixels(struct gls_exec *x, struct gls_state *st)
{
	const struct gls_surface *s = surface_of(x, st);

	return s && s->floats ? SCENE_FLOAT_PIXELS : SCENE_COLOR_PIXELS;
}
