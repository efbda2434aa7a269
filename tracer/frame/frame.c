#include "tracer/frame/frame.h"

#include <stdlib.h>

#include "base/err.h"

int tracer_create(struct tracer **out, struct device *dev)
{
	struct tracer *tr = calloc(1, sizeof(*tr));

	if (!tr)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	tr->dev = dev;
	if (accel_create(&tr->accel) != 0) {
		free(tr);
		return ERR_SYSTEM;
	}
	tr->accel->wide = traverse_families[device_family(dev)].wide;
	*out = tr;
	return 0;
}

void tracer_destroy(struct tracer **tracer)
{
	struct tracer *tr = *tracer;

	if (!tr)
		return;
	accel_destroy(&tr->accel);
	pool_free(&tr->attributes, tr->dev);
	pool_free(&tr->indices, tr->dev);
	pool_free(&tr->texels, tr->dev);
#define RELEASE(element, name) device_release(tr->dev, &tr->buffers.name.buffer);
	FRAME_BUFFERS(RELEASE)
	device_release(tr->dev, &tr->buffers.frame.buffer);
	for (int i = 0; i < SCENE_SAMPLES; i++)
		device_release(tr->dev, &tr->buffers.samples[i].buffer);
	traverse_release(tr->dev, &tr->trees);
	free(tr->counts);
	free(tr->first);
	free(tr);
	*tracer = NULL;
}

struct tables_launch frame_tables(const struct tracer *tr)
{
	const struct frame_buffers *b = &tr->buffers;

	return *LAUNCH(tables, .geometries = b->geometries, .materials = b->materials, .lights = b->lights, .units = b->units,
	               .currents = b->currents, .attributes = tr->attributes.floats, .indices = tr->indices.words,
	               .vertices = b->vertices, .texcoords = b->texcoords, .textures = b->textures, .texels = tr->texels.words,
	               .stipples = b->stipples);
}

void tracer_share(struct tracer *tracer, struct blas_cache *cache)
{
	tracer->accel->shared = cache;
}

const struct tracer_undrawn *tracer_undrawn(const struct tracer *tracer)
{
	return &tracer->undrawn;
}

union buffer_frame_pixel *frame_sample(const struct job *job, uint32_t sample)
{
	return job->n_samples == 1 ? &job->tr->buffers.frame : &job->tr->buffers.samples[sample];
}
