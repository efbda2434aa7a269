#include "tracer/frame/common/frame.h"

struct tables_launch frame_tables(const struct tracer *tr)
{
	const struct placed_buffers *b = &tr->placed;

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
	return pass->n_samples == 1 ? &pass->frame->tr->pixels.frame : &pass->frame->tr->pixels.samples[sample];
}

int frame_in_packets(const struct frame *frame)
{
	return device_family(frame->tr->dev) == FAMILY_PACKETS;
}
