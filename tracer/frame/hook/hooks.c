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

union buffer_float hooks_parameters(const struct frame *frame)
{
	return frame->tr->hook->parameters;
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
	err = launch_upload(frame->tr->dev, frame->tr->hook->parameters, rows, hooks_row(frame) + hook->words + 1);
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

int hooks_shade(const struct frame *frame, const struct accel_space *space, uint32_t transport,
                const struct fragment_list *from, union buffer_float visibility)
{
	struct tracer *tr = frame->tr;
	const struct hook_buffers *b = frame->tr->hook;
	int err = launch_reserve(tr->dev, tr->hook->answers, from->n);

	if (err)
		return err;
	return launch_hook_shade(
		tr->dev, from->n,
		LAUNCH(hook_shade, .tables = frame_tables(tr), .views = frame->tr->placed.views,
	               .windows = frame->tr->placed.windows, .fragments = from->fragments, .pixels = from->pixels,
	               .width = frame->width, .visibility = visibility, .n_slots = frame->prepared.n_light_slots,
	               .transport = transport, .parameters = b->parameters, .words = frame->options->hook->words,
	               .trees = trees_of(frame, space), .n = from->n, .shaded = from->shaded, .answers = b->answers));
}

int hooks_ways(const struct frame *frame, uint32_t transport, const struct fragment_list *from,
               const struct path_list *paths)
{
	struct tracer *tr = frame->tr;
	const struct hook_buffers *b = frame->tr->hook;

	return launch_hook_ways(tr->dev, from->n,
	                        LAUNCH(hook_ways, .tables = frame_tables(tr), .views = frame->tr->placed.views,
	                               .windows = frame->tr->placed.windows, .fragments = from->fragments,
	                               .pixels = from->pixels, .width = frame->width, .answers = b->answers,
	                               .transport = transport, .n = from->n, .shaded = from->shaded,
	                               .next_rays = paths->next_rays, .next_paths = paths->next_paths,
	                               .counts = paths->counts));
}

int hooks_hit(const struct frame *frame, const struct accel_space *space, uint32_t transport,
              const struct path_list *paths, union buffer_float visibility, union buffer_float radiance)
{
	struct tracer *tr = frame->tr;
	const struct hook_buffers *b = frame->tr->hook;

	return launch_hook_hit(
		tr->dev, paths->n,
		LAUNCH(hook_hit, .tables = frame_tables(tr), .hits = paths->hits, .rays = paths->rays,
	               .paths = paths->paths, .visibility = visibility, .n_slots = frame->prepared.n_light_slots,
	               .transport = transport, .depth = frame->options->depth, .parameters = b->parameters,
	               .words = frame->options->hook->words, .row = hooks_row(frame), .trees = trees_of(frame, space),
	               .n = paths->n, .radiance = radiance, .next_rays = paths->next_rays,
	               .next_paths = paths->next_paths, .counts = paths->counts));
}

int hooks_walk(const struct frame *frame, uint32_t transport, const struct path_list *walks)
{
	const struct hook_buffers *b = frame->tr->hook;

	return launch_hook_walk(frame->tr->dev, walks->n,
	                        LAUNCH(hook_walk, .tables = frame_tables(frame->tr), .hits = walks->hits,
	                               .rays = walks->rays, .paths = walks->paths, .transport = transport,
	                               .parameters = b->parameters, .words = frame->options->hook->words, .n = walks->n,
	                               .next_rays = walks->next_rays, .next_paths = walks->next_paths,
	                               .counts = walks->counts));
}

/* --- Light ------------------------------------------------------------------------------------------------------- */

int hooks_light(const struct frame *frame, uint32_t transport, const struct fragment_list *from,
                const struct light_rays *rays)
{
	const struct hook_buffers *b = frame->tr->hook;
	const uint32_t n_rays = frame->prepared.n_light_slots * from->n;

	return launch_hook_light(frame->tr->dev, n_rays,
	                         LAUNCH(hook_light, .tables = frame_tables(frame->tr),
	                                .windows = frame->tr->placed.windows, .fragments = from->fragments,
	                                .rays = rays->rays, .transport = transport, .parameters = b->parameters,
	                                .words = frame->options->hook->words, .n = from->n, .n_rays = n_rays,
	                                .visibility = rays->visibility));
}

int hooks_light_hits(const struct frame *frame, uint32_t transport, const struct path_list *paths,
                     const struct light_rays *rays)
{
	const struct hook_buffers *b = frame->tr->hook;
	const uint32_t n_rays = frame->prepared.n_light_slots * paths->n;

	return launch_hook_light_hit(frame->tr->dev, n_rays,
	                             LAUNCH(hook_light_hit, .tables = frame_tables(frame->tr), .hits = paths->hits,
	                                    .path_rays = paths->rays, .rays = rays->rays, .transport = transport,
	                                    .parameters = b->parameters, .words = frame->options->hook->words,
	                                    .n = paths->n, .n_rays = n_rays, .visibility = rays->visibility));
}

/* --- Rays that replace a camera's -------------------------------------------------------------------------------- */

int hooks_see(const struct band *band, const struct path_list *paths, union buffer_uint pixels)
{
	const struct frame *frame = band->frame;
	int err = 0;

	for (uint32_t i = 0; i < band->pass->n_samples && !err; i++)
		err = launch_hook_see(frame->tr->dev, paths->n,
		                      LAUNCH(hook_see, .tables = frame_tables(frame->tr), .hits = paths->hits,
		                             .rays = paths->rays, .paths = paths->paths, .pixels = pixels,
		                             .first_pixel = frame_first_pixel(band), .n = paths->n,
		                             .frame = *frame_sample(band->pass, i)));
	return err;
}
