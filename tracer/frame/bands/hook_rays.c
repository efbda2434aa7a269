#include "tracer/frame/bands/hook_rays.h"

#include "kernels/frame/light/sample.h"
#include "tracer/frame/bands/buffers.h"
#include "tracer/frame/bands/segment.h"
#include "tracer/frame/hook/hooks.h"
#include "tracer/frame/light/secondary.h"

int hook_rays_stand_in(const struct frame *frame, const struct segment *segment)
{
	const struct segment *best = hooks_has(frame, HOOK_RAY_GENERATION) || frame->objects.n ? frame->hooked : NULL;

	return best && secondary_space(frame, best->view, 0) && segment->view != SCENE_NONE &&
	       frame->prepared.scene_views[best->view].space == frame->prepared.scene_views[segment->view].space;
}

static int trace(const struct band *band, const struct segment *segment, struct camera_rectangle r)
{
	const struct frame *frame = band->frame;
	const struct pass *pass = band->pass;
	struct device *dev = frame->tr->dev;
	const uint32_t n = (uint32_t)(r.x1 - r.x0) * (uint32_t)(r.y1 - r.y0);
	struct fragment_list list;
	struct path_list paths;
	int err;

	if ((err = band_reserve_list(frame, n, &list)) || (err = secondary_reserve_paths(frame, n, &paths)) ||
	    (err = launch_hook_ray(
		     dev, n,
		     LAUNCH(hook_ray, .views = frame->tr->placed.views, .view_index = segment->view,
	                    .width = frame->width, .height = frame->height, .rectangle = segment_in_buffers(band, r),
	                    .first_pixel = frame_first_pixel(band), .turn = pass->number ? pass->turn : SAMPLE_TURNS,
	                    .sample = pass->number, .frame_number = (uint32_t)frame->scene->frame + 1,
	                    .parameters = hooks_parameters(frame), .row = hooks_row(frame), .n = n,
	                    .pixels = list.pixels, .shaded = list.shaded, .next_rays = paths.next_rays,
	                    .next_paths = paths.next_paths, .counts = paths.counts))) ||
	    (err = secondary_follow(band, secondary_space(frame, segment->view, 0),
	                            secondary_space(frame, segment->view, 1), &list, 1, 1)))
		return err;
	for (uint32_t i = 0; i < pass->n_samples && !err; i++)
		err = launch_hook_store(dev, n,
		                        LAUNCH(hook_store, .shaded = list.shaded, .pixels = list.pixels,
		                               .first_pixel = frame_first_pixel(band), .n = n,
		                               .frame = *frame_sample(pass, i)));
	return err;
}

int hook_rays_run(struct band *band, const struct segment *segment, uint32_t n_cleared)
{
	const struct camera_rectangle r = segment_rectangle(band, band->frame->prepared.views[segment->view].scissor);
	int err = segment_clear(band, segment, n_cleared);

	return err || r.x1 == r.x0 || segment != band->frame->hooked ? err : trace(band, segment, r);
}
