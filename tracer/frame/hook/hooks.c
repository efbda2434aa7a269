#include "tracer/frame/hook/hooks.h"

#include <stdlib.h>

#include "base/err.h"

int hooks_has(const struct frame *frame, unsigned stages)
{
	return frame->options->hook && frame->options->hook->stages & stages;
}

uint32_t hooks_row(const struct frame *frame)
{
	return frame->scene->n_materials * frame->options->hook->words;
}

int hooks_place(struct frame *frame)
{
	const struct hook *hook = frame->options->hook;
	const struct scene *scene = frame->scene;
	float *rows;
	int err;

	frame->hooked = hooks_has(frame, HOOK_RAY_GENERATION | HOOK_INTERSECTION) ?
	                        prepare_main_segment(&frame->prepared) :
	                        NULL;
	if (!hook)
		return 0;
	if ((err = hook_check_parameters(hook, scene->parameters, scene->n_parameters)))
		return err;
	rows = calloc((scene->n_materials + (size_t)1) * hook->words + 1, sizeof(*rows));
	if (!rows)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i <= scene->n_materials; i++) {
		float *row = rows + (size_t)i * hook->words;

		hook_start_row(hook, row);
		hook_fill_row(hook, scene->parameters, scene->n_shared_parameters, row);
		if (i < scene->n_materials)
			hook_fill_row(hook, scene->parameters + scene->materials[i].surface.parameter_first,
			              scene->materials[i].surface.parameter_count, row);
	}
	err = frame_upload(frame->tr, parameters, rows, hooks_row(frame) + hook->words + 1);
	free(rows);
	return err;
}

/* --- Closest hit and miss ---------------------------------------------------------------------------------------- */

static struct hook_trees_launch trees_of(const struct frame *frame, const struct accel_space *space)
{
	const struct traverse_trees *t = &frame->tr->trees;

	return (struct hook_trees_launch){ .top_first = space->n_nodes ? space->top2_first : SCENE_NONE,
		                           .top = t->top2,
		                           .instance_list = t->instance_list,
		                           .instances = t->instances,
		                           .nodes = frame->options->hook->asks_boxes ? t->nodes2 : t->top2 };
}

int hooks_shade(const struct frame *frame, const struct accel_space *space, uint32_t transport, uint32_t n)
{
	struct tracer *tr = frame->tr;
	const struct frame_buffers *b = &tr->buffers;
	int err = frame_reserve(tr, answers, n);

	if (err)
		return err;
	return launch_hook_shade(
		tr->dev, n,
		LAUNCH(hook_shade, .tables = frame_tables(tr), .views = b->views, .windows = b->windows,
	               .fragments = b->fragments, .pixels = b->pixels, .width = frame->width,
	               .visibility = b->visibility, .n_slots = frame->prepared.n_light_slots, .transport = transport,
	               .parameters = b->parameters, .words = frame->options->hook->words,
	               .trees = trees_of(frame, space), .n = n, .shaded = b->shaded, .answers = b->answers));
}

int hooks_ways(const struct frame *frame, uint32_t transport, uint32_t n)
{
	struct tracer *tr = frame->tr;
	const struct frame_buffers *b = &tr->buffers;

	return launch_hook_ways(tr->dev, n,
	                        LAUNCH(hook_ways, .tables = frame_tables(tr), .views = b->views, .windows = b->windows,
	                               .fragments = b->fragments, .pixels = b->pixels, .width = frame->width,
	                               .answers = b->answers, .transport = transport, .n = n, .shaded = b->shaded,
	                               .next_rays = b->next_path_rays, .next_paths = b->next_paths,
	                               .counts = b->next_counts));
}

int hooks_hit(const struct frame *frame, const struct accel_space *space, uint32_t transport, uint32_t n)
{
	struct tracer *tr = frame->tr;
	const struct frame_buffers *b = &tr->buffers;

	return launch_hook_hit(
		tr->dev, n,
		LAUNCH(hook_hit, .tables = frame_tables(tr), .hits = b->path_hits, .rays = b->path_rays,
	               .paths = b->paths, .visibility = b->visibility, .n_slots = frame->prepared.n_light_slots,
	               .transport = transport, .depth = frame->options->depth, .parameters = b->parameters,
	               .words = frame->options->hook->words, .row = hooks_row(frame), .trees = trees_of(frame, space),
	               .n = n, .radiance = b->radiance, .next_rays = b->next_path_rays, .next_paths = b->next_paths,
	               .counts = b->next_counts));
}

int hooks_walk(const struct frame *frame, uint32_t transport, uint32_t n)
{
	const struct frame_buffers *b = &frame->tr->buffers;

	return launch_hook_walk(frame->tr->dev, n,
	                        LAUNCH(hook_walk, .tables = frame_tables(frame->tr), .hits = b->shadow_hits,
	                               .rays = b->shadow_rays, .paths = b->shadow_paths, .transport = transport,
	                               .parameters = b->parameters, .words = frame->options->hook->words, .n = n,
	                               .next_rays = b->next_shadow_rays, .next_paths = b->next_shadow_paths,
	                               .counts = b->next_counts));
}

/* --- Light ------------------------------------------------------------------------------------------------------- */

int hooks_light(const struct frame *frame, uint32_t transport, uint32_t n)
{
	const struct frame_buffers *b = &frame->tr->buffers;
	const uint32_t n_rays = frame->prepared.n_light_slots * n;

	return launch_hook_light(frame->tr->dev, n_rays,
	                         LAUNCH(hook_light, .tables = frame_tables(frame->tr), .windows = b->windows,
	                                .fragments = b->fragments, .rays = b->rays, .transport = transport,
	                                .parameters = b->parameters, .words = frame->options->hook->words, .n = n,
	                                .n_rays = n_rays, .visibility = b->visibility));
}

int hooks_light_hits(const struct frame *frame, uint32_t transport, uint32_t n)
{
	const struct frame_buffers *b = &frame->tr->buffers;
	const uint32_t n_rays = frame->prepared.n_light_slots * n;

	return launch_hook_light_hit(frame->tr->dev, n_rays,
	                             LAUNCH(hook_light_hit, .tables = frame_tables(frame->tr), .hits = b->path_hits,
	                                    .path_rays = b->path_rays, .rays = b->rays, .transport = transport,
	                                    .parameters = b->parameters, .words = frame->options->hook->words, .n = n,
	                                    .n_rays = n_rays, .visibility = b->visibility));
}

/* --- Rays that replace a camera's -------------------------------------------------------------------------------- */

int hooks_see(const struct band *band, uint32_t n)
{
	const struct frame *frame = band->frame;
	const struct frame_buffers *b = &frame->tr->buffers;
	int err = 0;

	for (uint32_t i = 0; i < band->pass->n_samples && !err; i++)
		err = launch_hook_see(frame->tr->dev, n,
		                      LAUNCH(hook_see, .tables = frame_tables(frame->tr), .hits = b->path_hits,
		                             .paths = b->paths, .pixels = b->pixels,
		                             .first_pixel = frame_first_pixel(band), .n = n,
		                             .frame = *frame_sample(band->pass, i)));
	return err;
}
