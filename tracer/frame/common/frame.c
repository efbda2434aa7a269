#include "tracer/frame/common/frame.h"

#include <stdlib.h>

#include "base/err.h"

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

int frame_in_packets(const struct job *job)
{
	return device_family(job->tr->dev) == FAMILY_PACKETS;
}

int frame_reserve_counts(struct job *job)
{
	struct tracer *tr = job->tr;

	if (job->n_pixels <= tr->n_counted)
		return 0;
	free(tr->counts);
	free(tr->first);
	tr->n_counted = 0;
	tr->counts = malloc(job->n_pixels * sizeof(*tr->counts));
	tr->first = malloc(job->n_pixels * sizeof(*tr->first));
	if (!tr->counts || !tr->first)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u pixels", job->n_pixels);
	tr->n_counted = job->n_pixels;
	return 0;
}
