#include "tracer/frame/common/frame.h"

#include <stdlib.h>

#include "base/err.h"

struct tables_launch frame_tables(const struct tracer *tr)
{
	const struct frame_buffers *b = &tr->buffers;

	return *LAUNCH(tables, .geometries = b->geometries, .materials = b->materials, .lights = b->lights,
	               .units = b->units, .currents = b->currents, .attributes = tr->attributes.floats,
	               .indices = tr->indices.words, .vertices = b->vertices, .texcoords = b->texcoords,
	               .textures = b->textures, .texels = tr->texels.words, .stipples = b->stipples);
}

uint32_t frame_first_pixel(const struct band *band)
{
	return band->row_first * band->frame->width;
}

union buffer_frame_pixel *frame_sample(const struct pass *pass, uint32_t sample)
{
	return pass->n_samples == 1 ? &pass->frame->tr->buffers.frame : &pass->frame->tr->buffers.samples[sample];
}

int frame_in_packets(const struct frame *frame)
{
	return device_family(frame->tr->dev) == FAMILY_PACKETS;
}

int frame_reserve_counts(const struct band *band)
{
	struct tracer *tr = band->frame->tr;

	if (band->n_pixels <= tr->n_counted)
		return 0;
	free(tr->counts);
	free(tr->first);
	tr->n_counted = 0;
	tr->counts = malloc(band->n_pixels * sizeof(*tr->counts));
	tr->first = malloc(band->n_pixels * sizeof(*tr->first));
	if (!tr->counts || !tr->first)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u pixels", band->n_pixels);
	tr->n_counted = band->n_pixels;
	return 0;
}
