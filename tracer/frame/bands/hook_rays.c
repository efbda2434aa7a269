#include "tracer/frame/bands/hook_rays.h"

#include "kernels/frame/light/sample.h"
#include "tracer/frame/bands/segment.h"
#include "tracer/frame/hook/hooks.h"
#include "tracer/frame/light/secondary.h"

int hook_rays_stand_in(const struct frame *frame, const struct segment *segment)
{
	const struct segment *best = hooks_has(frame, HOOK_RAY_GENERATION) || frame->objects.n ? frame->hooked : NULL;

	return best && secondary_space(frame, best->view, 0) && segment->view != SCENE_NONE &&
	       frame->prepared.scene_views[best->view].space == frame->prepared.scene_views[segment->view].space;
}

static int reserve(const struct band *band, uint32_t n)
{
	struct tracer *tr = band->frame->tr;
	int err = frame_reserve(tr, pixels, n);

	if (!err)
		err = frame_reserve(tr, shaded, n);
	if (!err)
		err = frame_reserve(tr, next_path_rays, n);
	if (!err)
		err = frame_reserve(tr, next_paths, n);
	return err ? err : frame_reserve(tr, next_counts, n);
}

static int trace(const struct band *band, const struct segment *segment, struct camera_rectangle r)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	const struct frame_buffers *b = &tr->buffers;
	const uint32_t n = (uint32_t)(r.x1 - r.x0) * (uint32_t)(r.y1 - r.y0);
	int err;

	if ((err = reserve(band, n)) ||
	    (err = launch_hook_ray(
		     tr->dev, n,
		     LAUNCH(hook_ray, .views = b->views, .view_index = segment->view, .width = frame->width,
	                    .height = frame->height, .rectangle = segment_in_buffers(band, r),
	                    .first_pixel = frame_first_pixel(band),
	                    .turn = band->pass->number ? band->pass->turn : SAMPLE_TURNS, .sample = band->pass->number,
	                    .frame_number = (uint32_t)frame->scene->frame + 1, .parameters = b->parameters,
	                    .row = hooks_row(frame), .n = n, .pixels = b->pixels, .shaded = b->shaded,
	                    .next_rays = b->next_path_rays, .next_paths = b->next_paths, .counts = b->next_counts))) ||
	    (err = secondary_follow(band, secondary_space(frame, segment->view, 0),
	                            secondary_space(frame, segment->view, 1), 1, n, 1)))
		return err;
	for (uint32_t i = 0; i < band->pass->n_samples && !err; i++)
		err = launch_hook_store(tr->dev, n,
		                        LAUNCH(hook_store, .shaded = b->shaded, .pixels = b->pixels,
		                               .first_pixel = frame_first_pixel(band), .n = n,
		                               .frame = *frame_sample(band->pass, i)));
	return err;
}

int hook_rays_run(struct band *band, const struct segment *segment, uint32_t n_cleared)
{
	const struct camera_rectangle r = segment_rectangle(band, band->frame->prepared.views[segment->view].scissor);
	int err = segment_clear(band, segment, n_cleared);

	return err || r.x1 == r.x0 || segment != band->frame->hooked ? err : trace(band, segment, r);
}
