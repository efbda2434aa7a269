#include "tracer/frame/bands/hook_rays.h"

#include "kernels/frame/light/sample.h"
#include "tracer/frame/bands/segment.h"
#include "tracer/frame/hook/hooks.h"
#include "tracer/frame/light/secondary.h"

int hook_rays_stand_in(const struct job *job, const struct segment *segment)
{
	const struct segment *best = hooks_has(job, HOOK_RAY_GENERATION) || job->objects.n ? job->hooked : NULL;

	return best && secondary_space(job, best->view, 0) && segment->view != SCENE_NONE &&
	       job->prepared.scene_views[best->view].space == job->prepared.scene_views[segment->view].space;
}

static int reserve(struct job *job, uint32_t n)
{
	struct tracer *tr = job->tr;
	int err = frame_reserve(tr, pixels, n);

	if (!err)
		err = frame_reserve(tr, shaded, n);
	if (!err)
		err = frame_reserve(tr, next_path_rays, n);
	if (!err)
		err = frame_reserve(tr, next_paths, n);
	return err ? err : frame_reserve(tr, next_counts, n);
}

static int trace(struct job *job, const struct segment *segment, struct camera_rectangle r)
{
	struct tracer *tr = job->tr;
	const struct frame_buffers *b = &tr->buffers;
	const uint32_t n = (uint32_t)(r.x1 - r.x0) * (uint32_t)(r.y1 - r.y0);
	int err;

	if ((err = reserve(job, n)) ||
	    (err = launch_hook_ray(tr->dev, n,
	                           LAUNCH(hook_ray, .views = b->views, .view_index = segment->view, .width = job->width,
	                                  .height = job->height, .rectangle = segment_in_buffers(job, r),
	                                  .first_pixel = frame_first_pixel(job),
	                                  .turn = job->pass ? job->turn : SAMPLE_TURNS, .sample = job->pass,
	                                  .frame_number = (uint32_t)job->scene->frame + 1, .parameters = b->parameters,
	                                  .row = hooks_row(job), .n = n, .pixels = b->pixels, .shaded = b->shaded,
	                                  .next_rays = b->next_path_rays, .next_paths = b->next_paths,
	                                  .counts = b->next_counts))) ||
	    (err = secondary_follow(job, secondary_space(job, segment->view, 0), secondary_space(job, segment->view, 1),
	                            1, n, 1)))
		return err;
	for (uint32_t i = 0; i < job->n_samples && !err; i++)
		err = launch_hook_store(tr->dev, n,
		                        LAUNCH(hook_store, .shaded = b->shaded, .pixels = b->pixels,
		                               .first_pixel = frame_first_pixel(job), .n = n,
		                               .frame = *frame_sample(job, i)));
	return err;
}

int hook_rays_run(struct job *job, const struct segment *segment, uint32_t n_cleared)
{
	const struct camera_rectangle r = segment_rectangle(job, job->prepared.views[segment->view].scissor);
	int err = segment_clear(job, segment, n_cleared);

	return err || r.x1 == r.x0 || segment != job->hooked ? err : trace(job, segment, r);
}
