/*
 * The front buffer of a double-buffered window (GL 2.1 sec. 4.2.1, 4.3.2; GLX 1.4 sec. 3.3.10). A frame that ends with
 * a swap shows the back buffer, which is then also in the front buffer, as GL requires (Mesa's software rasterizers
 * leave the old contents there, 22.3.6). A frame that ends without a swap shows the buffer that is drawn to at its end,
 * even if it is the front buffer.
 *
 * The buffers have separate colours, and share depth and stencil. While nothing draws to the front buffer or reads it,
 * it is just a reference to the result of the last swap. Afterwards the two are separate: until the next swap both
 * surfaces get every event, its colours according to DrawBuffer, its depth and stencil always. Earlier contents of the
 * front buffer are available only after the replay has started again for them (x->feedback.fronts, surface.c).
 */
#include "replay/gl/surface/front.h"

#include <string.h>

#include "gl_tokens.h"
#include "replay/build/frame.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/surface/surface.h"
#include "replay/machine/machine.h"
#include "replay/machine/picture.h"

static int is_front(uint32_t buffer)
{
	return buffer == GL_FRONT || buffer == GL_FRONT_LEFT || buffer == GL_LEFT || buffer == GL_FRONT_AND_BACK;
}

static int is_front_alone(uint32_t buffer)
{
	return buffer == GL_FRONT || buffer == GL_FRONT_LEFT;
}

static uint32_t drawn_in_window(const struct gls_state *st)
{
	const struct gls_framebuffer *window = st->draw_framebuffer ? table_find(&st->share->framebuffers, 0) : NULL;

	return window ? window->draw_buffer : st->a.color.draw_buffer;
}

int gls_front_is_drawn(const struct gls_state *st)
{
	return st->double_buffered && is_front(drawn_in_window(st));
}

int gls_front_alone_is_drawn(const struct gls_state *st)
{
	return st->double_buffered && is_front_alone(drawn_in_window(st));
}

int gls_front_is_read(const struct gls_state *st)
{
	return st->double_buffered && !st->read_framebuffer &&
	       (is_front_alone(st->a.pixel.read_buffer) || st->a.pixel.read_buffer == GL_LEFT);
}

static int has_same_start(const struct gls_surface *a, const struct gls_surface *b)
{
	return a->picture == b->picture && a->before == b->before && a->skipped == b->skipped && !a->deferred && !b->deferred;
}

static void merge(struct scene_picture *to, const struct scene_picture *colors, const struct scene_picture *rest)
{
	size_t n = (size_t)to->width * to->height;

	memcpy(to->rgba, colors->rgba, 4 * n);
	memcpy(to->depth, rest->depth, n * sizeof(*to->depth));
	memcpy(to->stencil, rest->stencil, n);
}

/* The front buffer's colours, with depth and stencil as left by the back buffer's events. */
static struct gls_picture *start_of(struct gls_exec *x, struct gls_surface *front, struct gls_surface *back)
{
	const struct scene_picture *colors = gls_surface_read(x, front, NULL),
				   *rest = colors ? gls_surface_read(x, back, NULL) : NULL;
	struct gls_picture *p;

	if (!rest)
		return NULL;
	p = gls_picture_make(x, &(struct gls_picture_form){ back->width, back->height, back->depth_bits,
	                                                    back->alpha_bits, back->samples, 0 });
	if (!p)
		return NULL;
	merge(&p->picture, colors, rest);
	for (int i = 0; i < SCENE_SAMPLES && p->picture.samples; i++)
		merge(&p->picture.samples[i], colors->samples ? &colors->samples[i] : colors,
		      rest->samples ? &rest->samples[i] : rest);
	return p;
}

struct gls_surface *gls_front_part(struct gls_exec *x, struct gls_drawable *d)
{
	struct gls_surface *back = &d->surface, *front = &d->front;
	struct gls_picture *start = NULL;
	int known;

	if (d->parted)
		return front;
	known = has_same_start(front, back) && !gls_frame_events(back);
	d->parted = 1;
	if (known)
		return front;
	if (x->feedback.fronts && !(start = start_of(x, front, back)))
		return front; /* x->feedback.rewind or x->failed is set */
	gls_surface_free(front);
	front->picture = start;
	front->skipped = !start && x->feedback.supply;
	front->deferred = 0;
	return front;
}

void gls_front_swapped(struct gls_drawable *d)
{
	gls_surface_free(&d->front);
	d->parted = 0;
	gls_surface_share(&d->front, &d->surface);
}
