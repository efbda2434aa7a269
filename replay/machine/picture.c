/* Pictures: rendered pixels. */
#include "replay/machine/picture.h"

#include <stdlib.h>

#include "replay/machine/errors.h"

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

struct gls_picture *gls_picture_reference(struct gls_picture *p)
{
	if (p)
		atomic_fetch_add(&p->refs, 1);
	return p;
}

/*
 * All 0, except that alpha is 1 if the surface has none. Mesa's memory starts this way; GL leaves it undefined.
 * @return 0: out of memory, with some arrays possibly allocated
 */
static int make_arrays(struct scene_picture *p, const struct gls_picture_form *form)
{
	size_t n = (size_t)form->width * form->height, room = n + !n;

	p->width = form->width;
	p->height = form->height;
	p->depth_bits = form->depth_bits > 24 ? 24 : form->depth_bits;
	p->rgba = calloc(room, 4);
	p->depth = calloc(room, sizeof(*p->depth));
	p->stencil = calloc(room, 1);
	p->colors = form->floats ? calloc(room, 4 * sizeof(*p->colors)) : NULL;
	if (!p->rgba || !p->depth || !p->stencil || (form->floats && !p->colors))
		return 0;
	for (size_t i = 0; i < n && !form->alpha_bits; i++) {
		p->rgba[4 * i + 3] = 255;
		if (form->floats)
			p->colors[4 * i + 3] = 1;
	}
	return 1;
}

struct gls_picture *gls_picture_make(struct gls_exec *x, const struct gls_picture_form *form)
{
	struct gls_picture *p = calloc(1, sizeof(*p));
	int good = p != NULL;

	if (p) {
		atomic_init(&p->refs, 1);
		good = make_arrays(&p->picture, form);
		if (form->samples > 1)
			good &= (p->picture.samples = calloc(SCENE_SAMPLES, sizeof(*p->picture.samples))) != NULL;
		for (int i = 0; i < SCENE_SAMPLES && p->picture.samples; i++)
			good &= make_arrays(&p->picture.samples[i], form);
	}
	if (!good) {
		gls_picture_release(p);
		gls_out_of_memory(x, (size_t)form->width * form->height * 9);
		return NULL;
	}
	return p;
}

void gls_picture_color(const struct scene_picture *p, size_t place, float out[4])
{
	for (unsigned i = 0; i < 4; i++)
		out[i] = p->colors ? p->colors[4 * place + i] : (float)p->rgba[4 * place + i] / 255;
}
