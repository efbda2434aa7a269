#include "tracer/frame/bands/segment.h"

#include <string.h>

#include "kernels/camera/camera.h"
#include "kernels/frame/light/sample.h"
#include "kernels/gl/pixel.h"
#include "tracer/frame/hook/hooks.h"
#include "tracer/frame/light/dome.h"
#include "tracer/frame/light/scan.h"
#include "tracer/frame/light/secondary.h"
#include "tracer/frame/picture/compose.h"

struct camera_rectangle segment_rectangle(const struct job *job, const int32_t scissor[4])
{
	const int32_t first = (int32_t)job->row_first, end = first + (int32_t)job->n_rows;
	struct camera_rectangle r = camera_rectangle(scissor[0], scissor[1], scissor[2], scissor[3], job->width, job->height);

	r.y0 = r.y0 > first ? r.y0 : first;
	r.y1 = r.y1 < end ? r.y1 : end;
	if (r.y1 <= r.y0)
		r.x1 = r.x0, r.y1 = r.y0;
	return r;
}

struct camera_rectangle segment_in_buffers(const struct job *job, struct camera_rectangle r)
{
	r.y0 -= (int32_t)job->row_first;
	r.y1 -= (int32_t)job->row_first;
	return r;
}

static uint32_t rectangle_area(struct camera_rectangle r)
{
	return (uint32_t)(r.x1 - r.x0) * (uint32_t)(r.y1 - r.y0);
}

/* The sample that draws write to. bits: as the kernels take them, with its number (pixel_sample) */
struct target {
	union buffer_frame_pixel frame;
	uint32_t bits;
};

static struct target target_of(const struct job *job, uint32_t sample, uint32_t note)
{
	return (struct target){ *frame_sample(job, sample), job->bits | note };
}

static int clear_sample(struct job *job, const struct scene_clear *clear, uint32_t sample)
{
	struct camera_rectangle r = segment_rectangle(job, clear->scissor);
	uint32_t n = rectangle_area(r);

	return launch_clear(job->tr->dev, n,
	                    LAUNCH(clear, .clear = *clear, .rectangle = segment_in_buffers(job, r), .width = job->width,
	                           .bits = job->bits, .n = n, .frame = *frame_sample(job, sample)));
}

static int run_clear(struct job *job, const struct scene_clear *clear)
{
	int err = 0;

	if (clear->target != 0)
		return 0;
	if (clear->buffers & 1)
		memcpy(job->background, clear->color, sizeof(job->background));
	for (uint32_t i = 0; i < job->n_samples && !err; i++)
		err = clear_sample(job, clear, i);
	return err;
}

/* 1 if a clear erases the complete contents of the buffers that it clears. */
static int clears_whole(const struct job *job, const struct scene_clear *clear)
{
	const int32_t *s = clear->scissor;
	const uint32_t stencil = pixel_bits_mask(pixel_stencil_bits(job->bits));

	return clear->target == 0 && s[0] <= 0 && s[1] <= 0 && s[0] + s[2] >= (int32_t)job->width &&
	       s[1] + s[3] >= (int32_t)job->height && (!(clear->buffers & 1) || (clear->color_mask & 15) == 15) &&
	       (!(clear->buffers & 4) || (clear->stencil_mask & stencil) == stencil);
}

uint32_t segment_whole_clear(const struct job *job, struct scene_clear *out)
{
	const struct segment *segment = job->prepared.segments;
	uint32_t n = 0;

	/* Depth that nothing cleared is 0, as Mesa's is; GL does not say (GL 2.1 sec. 4.2.3). */
	*out = (struct scene_clear){ .buffers = 7,
		                     .scissor = { 0, 0, (int32_t)job->width, (int32_t)job->height },
		                     .color_mask = 15,
		                     .stencil_mask = 0xffffffffu,
		                     .floats = job->scene->floats };
	for (; job->prepared.n_segments && n < segment->clear_count; n++) {
		const struct scene_clear *next = &job->scene->clears[segment->clear_first + n];

		if (!clears_whole(job, next))
			break;
		if (next->buffers & 1)
			memcpy(out->color, next->color, sizeof(out->color));
		if (next->buffers & 2)
			out->depth = next->depth;
		if (next->buffers & 4)
			out->stencil = next->stencil;
	}
	return n;
}

int segment_clear_one(struct job *job)
{
	static const struct frame_pixel nothing;
	const struct camera_rectangle one = { 0, 0, 1, 1 };
	struct scene_clear clear;
	int err = frame_upload(job->tr, cleared, &nothing, 1);

	segment_whole_clear(job, &clear);
	return err ? err :
	             launch_clear(job->tr->dev, 1,
	                          LAUNCH(clear, .clear = clear, .rectangle = one, .width = 1, .bits = job->bits, .n = 1,
	                                 .frame = job->tr->buffers.cleared));
}

/* 1 if all pixels begin with the same value, are drawn to only by resolve_packet (not by a hook's rays), and go into
 * one picture. n_cleared: number of clears of the whole picture */
static int clears_late(const struct job *job, uint32_t n_cleared)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < job->prepared.n_segments; i++)
		n += job->prepared.segments[i].clear_count;
	return frame_in_packets(job) && job->image && job->n_passes == 1 && job->n_samples == 1 &&
	       secondary_transport(job->options) != TRANSPORT_LINEAR && n == n_cleared &&
	       !hooks_has(job, HOOK_RAY_GENERATION | HOOK_INTERSECTION);
}

int segment_say_drawn(struct job *job, int drawn)
{
	const uint32_t rows = frame_columns(job->width) * job->n_rows;

	if (!frame_in_packets(job))
		return 0;
	memset(job->tr->counts, drawn ? 0xff : 0, rows * sizeof(*job->tr->counts));
	return frame_upload(job->tr, drawn, job->tr->counts, rows);
}

int segment_clear_all(struct job *job, uint32_t *n_done)
{
	struct scene_clear clear;
	int late, err;

	*n_done = segment_whole_clear(job, &clear);
	late = clears_late(job, *n_done);
	memcpy(job->background, clear.color, sizeof(job->background));
	err = segment_say_drawn(job, !late);
	if (err)
		return err;
	return late ? segment_clear_one(job) : run_clear(job, &clear);
}

struct camera_pass_launch segment_camera_pass(const struct job *job, const struct segment *segment,
                                              struct camera_rectangle r, uint32_t first)
{
	const struct frame_buffers *b = &job->tr->buffers;

	return *LAUNCH(camera_pass, .view_index = segment->view, .views = b->views, .width = job->width,
	               .height = job->height, .rectangle = r, .first_pixel = frame_first_pixel(job) - first,
	               .mode = segment->mode, .window = b->windows, .clip = b->clips, .after = b->after,
	               .fragments = b->sparse, .counts = b->counts);
}

int segment_trace_camera(struct job *job, const struct segment *segment, struct camera_rectangle r, uint32_t first)
{
	const struct camera_pass_launch pass = segment_camera_pass(job, segment, r, first);

	return traverse_camera(job->tr->dev, traverse_families[device_family(job->tr->dev)].camera, &job->tr->trees, r, &pass);
}

/* Width in pixels of the blocks that order the list: rays that share a work item (RAYS_PER_ITEM) should stay
 * together. */
#define LIST_BLOCK 8

/* End of the block that starts at `at`, at most `limit`; blocks end at multiples of LIST_BLOCK. */
static int32_t block_end(int32_t at, int32_t limit)
{
	const int32_t end = at - at % LIST_BLOCK + LIST_BLOCK;

	return end < limit ? end : limit;
}

/*
 * Compute the position of each pixel's fragments in the dense list, block by block, into buffers.first.
 * @param n_list  receives the number of fragments
 * @param more    receives 1 if all slots of a pixel were filled: its column may continue
 */
static int place_fragments(struct job *job, struct camera_rectangle r, uint32_t slots, uint32_t *n_list, int *more)
{
	struct tracer *tr = job->tr;
	uint32_t next = 0;
	int err = device_read(tr->dev, tr->buffers.counts.buffer, 0, tr->counts, job->n_pixels * sizeof(*tr->counts));

	*more = 0;
	for (int32_t y0 = r.y0; y0 < r.y1 && !err; y0 = block_end(y0, r.y1))
		for (int32_t x0 = r.x0; x0 < r.x1; x0 = block_end(x0, r.x1))
			for (int32_t y = y0; y < block_end(y0, r.y1); y++)
				for (int32_t x = x0; x < block_end(x0, r.x1); x++) {
					uint32_t number = (uint32_t)y * job->width + (uint32_t)x, pixel = number - frame_first_pixel(job);

					if (job->pass && !sample_takes_part(number, job->turn))
						tr->counts[pixel] = 0;
					tr->first[pixel] = next;
					next += tr->counts[pixel];
					*more |= slots > 1 && tr->counts[pixel] == slots;
				}
	*n_list = next;
	if (!err && job->pass)
		err = frame_upload(tr, counts, tr->counts, job->n_pixels);
	return err ? err : frame_upload(tr, first, tr->first, job->n_pixels);
}

/*
 * The same in the order of pixels, computed on the device, if a work item takes one fragment and all pixels are
 * included. Neither counts nor positions are then copied to the host.
 */
static int place_on_device(struct job *job, uint32_t slots, uint32_t *n_list, int *more)
{
	struct frame_buffers *b = &job->tr->buffers;
	const struct scan_list list = { b->counts, job->n_pixels, slots > 1 ? slots : SCENE_NONE, &b->first, &b->scan };

	return scan_counts(job->tr->dev, &list, n_list, more);
}

/* 1 if a rectangle covers the whole band. */
static int is_band(const struct job *job, struct camera_rectangle r)
{
	r = segment_in_buffers(job, r);
	return r.x0 == 0 && r.y0 == 0 && r.x1 == (int32_t)job->width && r.y1 == (int32_t)job->n_rows;
}

static int run_gather(struct job *job, struct camera_rectangle r, uint32_t slots, uint32_t n_list)
{
	struct tracer *tr = job->tr;
	uint32_t n = rectangle_area(r);
	const struct frame_buffers *b = &tr->buffers;
	int err = frame_reserve(tr, fragments, n_list);

	if (!err)
		err = frame_reserve(tr, pixels, n_list);
	if (!err)
		err = frame_reserve(tr, shaded, n_list);
	if (err)
		return err;
	return launch_gather(tr->dev, n,
	                     LAUNCH(gather, .sparse = b->sparse, .counts = b->counts, .slots = slots, .first = b->first,
	                            .list = b->fragments, .pixels = b->pixels, .after = b->after,
	                            .rectangle = segment_in_buffers(job, r), .width = job->width,
	                            .first_pixel = frame_first_pixel(job), .n = n));
}

static int run_shade(struct job *job, uint32_t bits, uint32_t slots, uint32_t n)
{
	struct tracer *tr = job->tr;
	const struct frame_buffers *b = &tr->buffers;
	const uint32_t transport = secondary_transport(job->options);
	const uint32_t albedo = transport >= TRANSPORT_DIFFUSE || (job->image && compose_asks(job->options, "albedo"));
	const struct shade_launch *a =
		LAUNCH(shade, .tables = frame_tables(tr), .views = b->views, .windows = b->windows, .fragments = b->fragments,
		       .pixels = b->pixels, .width = job->width, .height = job->height, .bits = bits,
		       .visibility = b->visibility, .n_slots = slots, .transport = transport, .albedo = albedo, .n = n,
		       .programs = b->programs, .output = job->scene->output,
		       .shaded = b->shaded);
	const int in_packets = frame_in_packets(job);
	const uint32_t packets = (n + SHADE_PACKET - 1) / SHADE_PACKET;
	int err = in_packets ? launch_shade_packet(tr->dev, packets, a) : launch_shade(tr->dev, n, a);

	if (err || !(job->prepared.has_fragment_programs || (slots && job->prepared.has_vertex_programs)))
		return err;
	return in_packets ? launch_program_packet(tr->dev, packets, a) : launch_program(tr->dev, n, a);
}

static int run_resolve(struct job *job, const struct target *to, struct camera_rectangle r)
{
	struct tracer *tr = job->tr;
	const struct frame_buffers *b = &tr->buffers;
	const int packets = frame_in_packets(job);
	const uint32_t n = packets ? frame_columns(job->width) * (uint32_t)(r.y1 - r.y0) : rectangle_area(r);
	const struct resolve_launch *a = LAUNCH(
		resolve, .tables = frame_tables(tr), .fragments = b->fragments, .shaded = b->shaded, .first = b->first,
		.counts = b->counts, .rectangle = segment_in_buffers(job, r), .width = job->width, .bits = to->bits,
		.n = n, .cleared = b->cleared, .drawn = b->drawn, .frame = to->frame);

	return packets ? launch_resolve_packet(tr->dev, n, a) : launch_resolve(tr->dev, n, a);
}

/* Shade the fragments of the list: GL's colours, then the results of rays from them. bits: of their target */
static int shade_list(struct job *job, uint32_t bits, uint32_t view, struct camera_rectangle r, uint32_t n)
{
	const struct accel_space *space = secondary_space(job, view, 0);
	enum tracer_mode mode = job->options->mode;
	int err = run_shade(job, bits, 0, n);

	if (err || !space || mode == TRACER_GL || mode == TRACER_NORMALS)
		return err;
	if (mode == TRACER_AO || mode == TRACER_AO_PHONG)
		return secondary_openness(job, space, n);
	if (job->prepared.n_light_slots) {
		err = secondary_shadows(job, space, n);
		if (!err)
			err = run_shade(job, bits, job->prepared.n_light_slots, n);
	}
	if (!err && hooks_has(job, HOOK_ANY_HIT | HOOK_CLOSEST_HIT))
		err = hooks_shade(job, space, secondary_transport(job->options), n);
	if (!err && job->options->depth &&
	    (job->prepared.has_mirrors || secondary_transport(job->options) >= TRANSPORT_DIFFUSE ||
	     hooks_has(job, HOOK_ANY_HIT | HOOK_CLOSEST_HIT)))
		err = secondary_paths(job, space, secondary_space(job, view, 1), n);
	return err || !dome_is_there(job) ? err : dome_light_list(job, space, segment_in_buffers(job, r), n);
}

int segment_reserve(struct job *job, uint32_t slots)
{
	struct tracer *tr = job->tr;
	int err = frame_reserve(tr, counts, job->n_pixels);

	if (!err)
		err = frame_reserve(tr, after, job->n_pixels);
	return err ? err : frame_reserve(tr, sparse, (size_t)slots * job->n_pixels);
}

/* Resolve the fragments of a segment without multisampling, which affect all samples alike. */
static int resolve_all(struct job *job, struct camera_rectangle r)
{
	int err = 0;

	for (uint32_t i = 0; i < job->n_samples && !err; i++) {
		const struct target to = target_of(job, i, i ? PIXEL_FOLLOWS : 0);

		err = run_resolve(job, &to, r);
	}
	return err;
}

/* Draw a segment to a sample; without multisampling, to all samples. */
static int run_draws(struct job *job, const struct segment *segment, const struct target *to)
{
	struct tracer *tr = job->tr;
	struct camera_rectangle r = segment_rectangle(job, job->prepared.views[segment->view].scissor);
	uint32_t slots = segment->mode == CAMERA_COLUMN ? CAMERA_COLUMN_MAX : 1, n_list;
	int more = rectangle_area(r) != 0, err;

	if (!more)
		return 0;
	err = segment_reserve(job, slots);
	if (!err && slots > 1) { /* columns start at the first fragment */
		memset(tr->counts, 0, job->n_pixels * sizeof(*tr->counts));
		err = frame_upload(tr, after, tr->counts, job->n_pixels);
	}
	while (more && !err) {
		err = segment_trace_camera(job, segment, r, 0);
		if (!err)
			err = frame_in_packets(job) || job->pass || !is_band(job, r) ? place_fragments(job, r, slots, &n_list, &more) :
			                                                               place_on_device(job, slots, &n_list, &more);
		if (err || n_list == 0)
			break;
		err = run_gather(job, r, slots, n_list);
		if (!err)
			err = shade_list(job, to->bits, segment->view, r, n_list);
		if (!err)
			err = segment->multisample ? run_resolve(job, to, r) : resolve_all(job, r);
	}
	return err;
}

/*
 * Positions of four samples in llvmpipe (Mesa 22.3.6, lp_sample_pos_4x) and Direct3D, in 1/256 pixel right of and below
 * a pixel's centre. Rows count from the top of windows and from the bottom of framebuffer objects.
 */
static const int32_t sample_places[SCENE_SAMPLES][2] = { { -32, -96 }, { 96, -32 }, { -96, 32 }, { 32, 96 } };

/*
 * With multisampling, llvmpipe (22.3.6, lp_setup_add_scissor_planes) lets samples in the second half of the pixels
 * before a scissor rectangle pass if they lie in the same tile. Columns and rows are counted from llvmpipe's origin.
 */
static int32_t leaks(int32_t first, int32_t place)
{
	return first > 0 && first % 64 != 0 && place > 0;
}

/* Set a segment's view to a sample's positions. */
static int look_at_sample(struct job *job, const struct segment *segment, uint32_t sample)
{
	struct view *view = &job->prepared.views[segment->view];
	const int32_t *place = sample_places[sample], *scissor = job->prepared.scene_views[segment->view].scissor;
	int32_t from_below = job->scene->samples_from_below != 0, left = leaks(scissor[0], place[0]);
	int32_t row = leaks(from_below ? scissor[1] : (int32_t)job->height - scissor[1] - scissor[3], place[1]);

	view->sample[0] = place[0];
	view->sample[1] = from_below ? place[1] : -place[1];
	view->scissor[0] = scissor[0] - left;
	view->scissor[1] = scissor[1] - (from_below ? row : 0);
	view->scissor[2] = scissor[2] + left;
	view->scissor[3] = scissor[3] + row;
	return device_write(job->tr->dev, job->tr->buffers.views.buffer, segment->view * sizeof(*view), view, sizeof(*view));
}

int segment_clear(struct job *job, const struct segment *segment, uint32_t n_cleared)
{
	int err = 0;

	for (uint32_t i = n_cleared; i < segment->clear_count && !err; i++)
		err = run_clear(job, &job->scene->clears[segment->clear_first + i]);
	return err;
}

int segment_run(struct job *job, const struct segment *segment, uint32_t n_cleared)
{
	const int32_t *scissor;
	struct target to;
	int err = segment_clear(job, segment, n_cleared);

	if (err || segment->view == SCENE_NONE || segment->instance_count == 0)
		return err;
	scissor = job->prepared.scene_views[segment->view].scissor;
	if (rectangle_area(camera_rectangle(scissor[0], scissor[1], scissor[2], scissor[3], job->width, job->height)) == 0)
		return 0;
	to = target_of(job, 0, segment->multisample && job->pass ? (job->pass % SCENE_SAMPLES + 1) << 24 : 0);
	if (!segment->multisample || job->n_samples == 1)
		return run_draws(job, segment, &to);
	for (uint32_t i = 0; i < job->n_samples && !err; i++) {
		to = target_of(job, i, (i + 1) << 24);
		err = look_at_sample(job, segment, i);
		if (!err)
			err = run_draws(job, segment, &to);
	}
	return err;
}

int segment_merge_samples(struct job *job)
{
	const struct frame_buffers *b = &job->tr->buffers;

	return launch_merge_samples(job->tr->dev, job->n_pixels,
	                            LAUNCH(merge_samples, .first = b->samples[0], .second = b->samples[1],
	                                   .third = b->samples[2], .fourth = b->samples[3], .n = job->n_pixels,
	                                   .frame = b->frame));
}

int segment_add_pass(struct job *job, uint32_t first)
{
	const struct frame_buffers *b = &job->tr->buffers;

	return launch_add_pass(job->tr->dev, job->n_pixels,
	                       LAUNCH(add_pass, .frame = b->frame, .turn = job->turn, .first = first,
	                              .first_pixel = frame_first_pixel(job),
	                              .radiant = secondary_transport(job->options) == TRANSPORT_LINEAR,
	                              .n = job->n_pixels, .sums = b->sums));
}
