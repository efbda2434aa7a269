#include "tracer/frame/bands/buffers.h"

#include <stdlib.h>

#include "base/err.h"

int band_reserve_counts(const struct band *band)
{
	struct band_buffers *b = band->frame->tr->band;

	if (band->n_pixels <= b->n_counted)
		return 0;
	free(b->host_counts);
	free(b->host_first);
	b->n_counted = 0;
	b->host_counts = malloc(band->n_pixels * sizeof(*b->host_counts));
	b->host_first = malloc(band->n_pixels * sizeof(*b->host_first));
	if (!b->host_counts || !b->host_first)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u pixels", band->n_pixels);
	b->n_counted = band->n_pixels;
	return 0;
}

int band_reserve_list(const struct frame *frame, uint32_t n, struct fragment_list *out)
{
	struct tracer *tr = frame->tr;
	struct band_buffers *b = tr->band;
	int err = launch_reserve(tr->dev, b->fragments, n);

	if (!err)
		err = launch_reserve(tr->dev, b->pixels, n);
	if (!err)
		err = launch_reserve(tr->dev, b->shaded, n);
	*out = (struct fragment_list){ b->fragments, b->pixels, b->shaded, n };
	return err;
}
