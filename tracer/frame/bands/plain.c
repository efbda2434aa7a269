#include "tracer/frame/bands/plain.h"

#include <string.h>

#include "kernels/camera/camera.h"
#include "kernels/frame/plain/plain.h"
#include "packs.h"
#include "tracer/frame/bands/buffers.h"
#include "tracer/frame/bands/segment.h"
#include "tracer/frame/light/dome.h"
#include "tracer/frame/light/secondary.h"
#include "tracer/frame/picture/compose.h"

/* 1 if only shadows, of lights without a size, and mirrors are traced. */
static int is_lit_simply(const struct frame *frame)
{
	const struct scene *scene = frame->scene;

	if (frame->options->mode == TRACER_GL)
		return 1;
	if (frame->options->mode != TRACER_WHITTED || secondary_transport(frame->options) != TRANSPORT_GL)
		return 0;
	for (uint32_t i = 0; i < scene->n_lights; i++)
		if (pack_refuses_rays_light(&scene->lights[i]))
			return 0;
	return 1;
}

/* 1 if the whole picture is cleared once and not again. */
static int is_cleared_once(const struct frame *frame)
{
	struct scene_clear clear;
	uint32_t n = 0;

	for (uint32_t i = 0; i < frame->prepared.n_segments; i++)
		n += frame->prepared.segments[i].clear_count;
	return segment_whole_clear(frame, &clear) == n;
}

int plain_is_simple(const struct pass *pass)
{
	return !pass->frame->options->hook && pass->count == 1 && pass->n_samples == 1 && is_lit_simply(pass->frame);
}

/* Kernels with one pixel per work item support neither dome light nor programs. */
static int is_known(const struct frame *frame)
{
	if (frame_in_packets(frame))
		return dome_suits_plain(frame);
	return !dome_is_there(frame) && !frame->prepared.has_fragment_programs && !frame->prepared.has_vertex_programs;
}

int plain_has_mirrors(const struct frame *frame)
{
	return frame->options->mode == TRACER_WHITTED && frame->prepared.has_mirrors && frame->options->depth;
}

int plain_suits(const struct pass *pass)
{
	const struct frame *frame = pass->frame;
	const struct prepared *p = &frame->prepared;
	const struct segment *segment = p->segments;

	if (!pass->image || !plain_is_simple(pass) || frame->scene->start || frame->scene->needs_previous ||
	    !is_cleared_once(frame) || plain_has_mirrors(frame) || !is_known(frame) || p->n_segments != 1 ||
	    segment->view == SCENE_NONE || segment->mode == CAMERA_COLUMN)
		return 0;
	for (uint32_t i = 0; i < segment->instance_count; i++)
		if (pack_refuses_plain(&frame->scene->materials[p->instances[segment->instance_first + i].material]))
			return 0;
	return 1;
}

/* 1 if a pixel of a block has a fragment. x, y: the block's first pixel */
static int has_fragment(const struct band *band, struct camera_rectangle r, uint32_t x, uint32_t y)
{
	const int32_t x1 = r.x1 < (int32_t)(x + PLAIN_WIDTH) ? r.x1 : (int32_t)(x + PLAIN_WIDTH);
	const int32_t y1 = r.y1 < (int32_t)(y + PLAIN_ROWS) ? r.y1 : (int32_t)(y + PLAIN_ROWS);
	uint32_t n = 0;

	for (int32_t row = r.y0 > (int32_t)y ? r.y0 : (int32_t)y; row < y1 && !n; row++)
		for (int32_t i = r.x0 > (int32_t)x ? r.x0 : (int32_t)x; i < x1; i++)
			n |= band->frame->tr->band->host_counts[(uint32_t)row * band->frame->width + (uint32_t)i];
	return n != 0;
}

/* Give each block with fragments its place. r: area that fragments may be in, counted from the band's first row; n:
 * receives the number of pixels of these blocks */
static int place_blocks(const struct band *band, struct camera_rectangle r, uint32_t *n)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	const uint32_t columns = plain_columns(frame->width), blocks = plain_blocks(frame->width, band->n_rows);
	int err = band_reserve_counts(band);
	uint32_t next = 0;

	if (!err && r.x0 < r.x1)
		err = device_read(tr->dev, tr->band->counts.buffer, 0, tr->band->host_counts,
		                  band->n_pixels * sizeof(*tr->band->host_counts));
	for (uint32_t i = 0; i < blocks && !err; i++)
		tr->band->host_first[i] = has_fragment(band, r, i % columns * PLAIN_WIDTH, i / columns * PLAIN_ROWS) ?
		                                  next++ :
		                                  SCENE_NONE;
	*n = (next ? next : 1) * PLAIN_WIDTH * PLAIN_ROWS;
	return err ? err : launch_upload(tr->dev, tr->band->blocks, tr->band->host_first, blocks);
}

struct compose_request plain_shadow_request(struct compose_request r)
{
	for (uint32_t i = 0; i < N_COMPOSE_HALVES; i++)
		if (!(i < COMPOSE_BEAUTY + 3 || (i >= COMPOSE_SHADOW && i < COMPOSE_REFLECT)))
			r.half_plane[i] = SCENE_NONE;
	memset(r.float_plane, 0xff, sizeof(r.float_plane));
	return r;
}

int plain_trace_rays(const struct frame *frame, const struct accel_space *space, const struct plain_launch *a)
{
	return secondary_ask(frame, space, &(const struct light_rays){ a->rays, a->visibility, a->n * a->n_slots, 1 });
}

int plain_reserve_unused(const struct frame *frame)
{
	struct device *dev = frame->tr->dev;
	struct band_buffers *b = frame->tr->band;
	int err;

	if ((err = launch_reserve(dev, b->layer_clears, 1)) || (err = launch_reserve(dev, b->kept_pixels, 1)) ||
	    (err = launch_reserve(dev, b->next_pixels, 1)) || (err = launch_reserve(dev, b->unknown, 1)) ||
	    (err = launch_reserve(dev, b->leaving, 1)) || (err = launch_reserve(dev, b->leaving_first, 1)) ||
	    (err = launch_reserve(dev, b->alone_fragments, 1)) || (err = launch_reserve(dev, b->alone_pixels, 1)))
		return err;
	return launch_reserve(dev, b->alone_shaded, 1);
}

struct plain_launch plain_launch_of(const struct band *band, const struct fragment_list *list,
                                    const struct light_rays *rays, uint32_t n_slots, const struct dome_plain *dome,
                                    const struct compose_planes *to)
{
	static const struct camera_rectangle nowhere;
	const struct frame *frame = band->frame;
	const struct placed_buffers *p = &frame->tr->placed;
	const struct band_buffers *b = frame->tr->band;
	const struct scene_dome none = { .reach = 0 };
	const struct layers_launch *one =
		LAUNCH(layers, .counts = b->counts, .n_looks = 0, .columns = 0, .asking = 0, .round = 0,
	               .clears = b->layer_clears, .n_clears = 0, .before = b->kept_pixels, .after = b->next_pixels,
	               .unknown = b->unknown, .mirrors = 0, .leaving = b->leaving, .list_first = b->leaving_first,
	               .list = b->alone_fragments, .list_pixels = b->alone_pixels, .list_shaded = b->alone_shaded);

	return *LAUNCH(plain, .tables = frame_tables(frame->tr), .views = p->views, .windows = p->windows,
	               .sparse = b->sparse, .rectangle = nowhere, .width = frame->width, .height = frame->height,
	               .first_pixel = frame_first_pixel(band), .bits = frame->bits, .cleared = b->cleared,
	               .request = to->request, .visibility = rays->visibility, .n_slots = n_slots, .blocks = b->blocks,
	               .n = list->n, .fragments = list->fragments, .pixels = list->pixels, .shaded = list->shaded,
	               .rays = rays->rays, .programs = p->programs, .dome = dome->samples ? frame->scene->dome : none,
	               .directions = dome->directions, .samples = dome->samples, .places = dome->places,
	               .looks = dome->looks, .factors = dome->factors, .layers = *one, .halves = to->halves,
	               .floats = to->floats);
}

/* Compute colours by programs, for plain, before rays to lights are traced (0), or for plain_shadow. */
static int run_programs(const struct frame *frame, struct plain_launch a, uint32_t blocks, uint32_t n_slots)
{
	if (!(frame->prepared.has_fragment_programs || (n_slots && frame->prepared.has_vertex_programs)))
		return 0;
	a.n_slots = n_slots;
	return launch_plain_program(frame->tr->dev, blocks, &a);
}

/* Run plain and plain_shadow, or their steps. */
static int run_plain(const struct frame *frame, const struct plain_launch *a, uint32_t blocks)
{
	struct device *dev = frame->tr->dev;
	int err;

	if (frame_in_packets(frame))
		return launch_plain(dev, blocks, a);
	err = launch_plain_color(dev, a->n, a);
	if (!err)
		err = launch_plain_ask(dev, (size_t)a->n * a->n_slots, a);
	return err ? err : launch_plain_show(dev, a->n, a);
}

static int run_plain_shadow(const struct frame *frame, const struct plain_launch *a, uint32_t blocks)
{
	struct device *dev = frame->tr->dev;
	int err;

	if (frame_in_packets(frame))
		return launch_plain_shadow(dev, blocks, a);
	err = launch_plain_color_dimmed(dev, a->n, a);
	return err ? err : launch_plain_show_dimmed(dev, a->n, a);
}

/* Draw everything except the effect of other surfaces on light, trace rays to lights, then draw that effect. */
static int draw_lit(const struct frame *frame, const struct accel_space *space, struct plain_launch a, uint32_t blocks)
{
	const uint32_t n_slots = a.n_slots;
	int err = run_programs(frame, a, blocks, 0);

	if (!err)
		err = run_plain(frame, &a, blocks);
	if (!err && n_slots)
		err = plain_trace_rays(frame, space, &a);
	if (!err && n_slots)
		err = run_programs(frame, a, blocks, n_slots);
	if (err || !n_slots)
		return err;
	a.request = plain_shadow_request(a.request);
	return run_plain_shadow(frame, &a, blocks);
}

/* The same with dome light: all planes are drawn at the end. */
static int draw_in_dome(const struct band *band, const struct accel_space *space, struct plain_launch a,
                        uint32_t blocks)
{
	const struct frame *frame = band->frame;
	int err = launch_plain_dome(frame->tr->dev, blocks, &a);

	if (!err)
		err = dome_light_plain(band, space, &a);
	if (!err && a.n_slots)
		err = plain_trace_rays(frame, space, &a);
	return err ? err : launch_plain_shadow(frame->tr->dev, blocks, &a);
}

/* 1 if one kernel draws a plain frame entirely: there are only camera rays, and no fragment programs. */
static int is_whole(const struct frame *frame)
{
	return frame_in_packets(frame) && !frame->prepared.has_fragment_programs &&
	       (frame->options->mode == TRACER_GL || !(frame->prepared.n_light_slots || dome_is_there(frame)));
}

/* Draw without secondary rays: the fragments found by the camera go directly into the planes. r: area of the view */
static int draw_whole(const struct band *band, struct camera_rectangle r, const struct compose_planes *to)
{
	const struct frame *frame = band->frame;
	const struct traverse_trees *t = &frame->tr->trees;
	const struct camera_rectangle whole = { 0, (int32_t)band->row_first, (int32_t)frame->width,
		                                (int32_t)(band->row_first + band->n_rows) };
	struct fragment_list alone;
	int err = band_reserve_list(frame, band->n_pixels, &alone);

	if (err)
		return err;
	return launch_plain_whole(frame->tr->dev, camera_packet_items(whole),
	                          LAUNCH(plain_whole, .pass = segment_camera_pass(band, frame->prepared.segments, r, 0),
	                                 .instances = t->instances, .top = t->top2, .instance_list = t->instance_list,
	                                 .nodes = t->nodes8, .triangles = t->faces8, .tables = frame_tables(frame->tr),
	                                 .bits = frame->bits, .cleared = frame->tr->band->cleared,
	                                 .request = to->request, .alone = alone.fragments, .pixels = alone.pixels,
	                                 .shaded = alone.shaded, .halves = to->halves, .floats = to->floats));
}

/* Make room for n places and their rays, and collect the arguments. */
static int reserve_launch(const struct band *band, const struct accel_space *space, uint32_t n,
                          const struct compose_planes *to, struct plain_launch *out)
{
	const struct frame *frame = band->frame;
	const uint32_t n_slots = space ? frame->prepared.n_light_slots : 0;
	struct fragment_list list;
	struct dome_plain dome;
	struct light_rays rays;
	int err = band_reserve_list(frame, n, &list);

	if (!err)
		err = plain_reserve_unused(frame);
	if (!err)
		err = space && dome_is_there(frame) ? dome_prepare_plain(frame, n, &dome) :
		                                      dome_prepare_none(frame, &dome);
	if (!err) /* last: the dome's rays are among these */
		err = secondary_reserve_rays(frame, n_slots ? (size_t)n * n_slots : 1, NULL, &rays);
	if (!err)
		*out = plain_launch_of(band, &list, &rays, n_slots, &dome, to);
	return err;
}

/* Draw in steps: camera rays, then everything that depends on secondary rays and programs. */
static int draw_in_steps(const struct band *band, const struct accel_space *space, struct camera_rectangle r,
                         const struct compose_planes *to)
{
	const struct frame *frame = band->frame;
	const uint32_t blocks = plain_blocks(frame->width, band->n_rows);
	uint32_t n = blocks * PLAIN_WIDTH * PLAIN_ROWS; /* places of pixels */
	struct plain_launch a;
	int err = r.x0 < r.x1 ? segment_trace_camera(band, frame->prepared.segments, r, 0) : 0;

	/* Kernels with one pixel per work item have places for all pixels, so there is no wait for the camera pass. */
	if (!err)
		err = frame_in_packets(frame) ? place_blocks(band, segment_in_buffers(band, r), &n) :
		                                launch_reserve(frame->tr->dev, frame->tr->band->blocks, 1);
	if (!err)
		err = reserve_launch(band, space, n, to, &a);
	if (err)
		return err;
	a.rectangle = segment_in_buffers(band, r);
	return a.samples ? draw_in_dome(band, space, a, blocks) : draw_lit(frame, space, a, blocks);
}

int plain_band(struct band *band)
{
	const struct frame *frame = band->frame;
	const struct segment *segment = frame->prepared.segments;
	const struct accel_space *space = frame->options->mode == TRACER_GL ? NULL :
	                                                                      secondary_space(frame, segment->view, 0);
	const struct camera_rectangle r = segment_rectangle(band, frame->prepared.views[segment->view].scissor);
	struct compose_planes planes;
	int err = segment_clear_first(band);

	if (!err)
		err = segment_reserve(band, 1);
	if (!err)
		err = compose_reserve(band, &planes);
	if (!err)
		err = is_whole(frame) ? draw_whole(band, r, &planes) : draw_in_steps(band, space, r, &planes);
	return err ? err : compose_fetch(band, &planes);
}
