#include "tracer/frame/frame.h"

struct tables_launch frame_tables(const struct tracer *tr)
{
	const struct frame_buffers *b = &tr->buffers;

	return *LAUNCH(tables, .geometries = b->geometries, .materials = b->materials, .lights = b->lights, .units = b->units,
	               .currents = b->currents, .attributes = tr->attributes.floats, .indices = tr->indices.words,
	               .vertices = b->vertices, .texcoords = b->texcoords, .textures = b->textures, .texels = tr->texels.words,
	               .stipples = b->stipples);
}

uint32_t frame_first_pixel(const struct job *job)
{
	return job->row_first * job->width;
}

union buffer_frame_pixel *frame_sample(const struct job *job, uint32_t sample)
{
	return job->n_samples == 1 ? &job->tr->buffers.frame : &job->tr->buffers.samples[sample];
}
