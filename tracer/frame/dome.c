#include "tracer/frame/dome.h"

#include "kernels/frame/dome.h"
#include "tracer/frame/secondary.h"

/* Of options.rays, which are for a pixel on its own: neighbours share theirs. */
#define RAYS_SHARED 8u

/* Where the pixels of a block look. sample: which of their rays, over all passes */
static int upload_directions(struct job *job, uint32_t sample)
{
	float directions[DOME_BLOCK * DOME_BLOCK][4];

	for (uint32_t i = 0; i < DOME_BLOCK * DOME_BLOCK; i++)
		dome_direction(&job->scene->dome, i, sample, directions[i]);
	return frame_upload(job->tr, dome_directions, directions[0], sizeof(directions) / sizeof(directions[0][0]));
}

int dome_is_there(const struct job *job)
{
	return job->scene->dome.reach > 0 && job->options->mode == TRACER_WHITTED;
}

int dome_light_list(struct job *job, const struct accel_space *space, struct camera_rectangle rectangle, uint32_t n)
{
	struct tracer *tr = job->tr;
	const struct frame_buffers *b = &tr->buffers;
	const uint32_t rays = (job->options->rays + RAYS_SHARED - 1) / RAYS_SHARED;
	int err = secondary_reserve_rays(job, n);

	if (!err)
		err = frame_reserve(tr, dome_places, n);
	if (!err)
		err = frame_reserve(tr, dome_sums, 4 * (size_t)n);
	if (!err)
		err = launch_dome_find(tr->dev, n, LAUNCH(dome_find, .tables = frame_tables(tr), .views = b->views, .windows = b->windows,
		                                          .fragments = b->fragments, .pixels = b->pixels, .width = job->width, .shaded = b->shaded,
		                                          .dome = job->scene->dome, .n = n, .places = b->dome_places));
	for (uint32_t i = 0; i < rays && !err; i++) {
		err = upload_directions(job, job->pass * rays + i);
		if (!err)
			err = launch_dome_ray(tr->dev, n, LAUNCH(dome_ray, .places = b->dome_places, .pixels = b->pixels, .directions = b->dome_directions,
			                                         .width = job->width, .n = n, .rays = b->rays));
		if (!err)
			err = secondary_ask(job, space, 0, n);
		if (!err)
			err = launch_dome_sum(tr->dev, n, LAUNCH(dome_sum, .rays = b->rays, .visibility = b->visibility, .dome = job->scene->dome,
			                                         .is_first = i == 0, .n = n, .sums = b->dome_sums));
	}
	if (err)
		return err;
	return launch_dome_light(tr->dev, n, LAUNCH(dome_light, .places = b->dome_places, .sums = b->dome_sums, .pixels = b->pixels, .first = b->first,
	                                            .counts = b->counts, .rectangle = rectangle, .width = job->width,
	                                            .first_pixel = frame_first_pixel(job), .dome = job->scene->dome, .n = n, .shaded = b->shaded));
}
