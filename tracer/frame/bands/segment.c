#include "tracer/frame/bands/segment.h"

#include <string.h>

#include "kernels/camera/camera.h"
#include "kernels/frame/light/sample.h"
#include "kernels/gl/pixel.h"
#include "tracer/frame/bands/buffers.h"
#include "tracer/frame/hook/hooks.h"
#include "tracer/frame/light/dome.h"
#include "tracer/frame/light/scan.h"
#include "tracer/frame/light/secondary.h"
#include "tracer/frame/picture/compose.h"

struct camera_rectangle segment_rectangle(const struct band *band, const int32_t scissor[4])
{
	const int32_t first = (int32_t)band->row_first, end = first + (int32_t)band->n_rows;
	struct camera_rectangle r = camera_rectangle(scissor[0], scissor[1], scissor[2], scissor[3], band->frame->width,
	                                             band->frame->height);

	r.y0 = r.y0 > first ? r.y0 : first;
	r.y1 = r.y1 < end ? r.y1 : end;
	if (r.y1 <= r.y0)
		r.x1 = r.x0, r.y1 = r.y0;
	return r;
}

struct camera_rectangle segment_in_buffers(const struct band *band, struct camera_rectangle r)
{
	r.y0 -= (int32_t)band->row_first;
	r.y1 -= (int32_t)band->row_first;
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

static struct target target_of(const struct pass *pass, uint32_t sample, uint32_t note)
{
	return (struct target){ *frame_sample(pass, sample), pass->frame->bits | note };
}

static int clear_sample(const struct band *band, const struct scene_clear *clear, uint32_t sample)
{
	const struct frame *frame = band->frame;
	struct camera_rectangle r = segment_rectangle(band, clear->scissor);
	uint32_t n = rectangle_area(r);

	return launch_clear(frame->tr->dev, n,
	                    LAUNCH(clear, .clear = *clear, .rectangle = segment_in_buffers(band, r),
	                           .width = frame->width, .bits = frame->bits, .n = n,
	                           .frame = *frame_sample(band->pass, sample)));
}

static int run_clear(struct band *band, const struct scene_clear *clear)
{
	int err = 0;

	if (clear->target != 0)
		return 0;
	if (clear->buffers & 1)
		memcpy(band->background, clear->color, sizeof(band->background));
	for (uint32_t i = 0; i < band->pass->n_samples && !err; i++)
		err = clear_sample(band, clear, i);
	return err;
}

/* 1 if a clear erases the complete contents of the buffers that it clears. */
static int clears_whole(const struct frame *frame, const struct scene_clear *clear)
{
	const int32_t *s = clear->scissor;
	const uint32_t stencil = pixel_bits_mask(pixel_stencil_bits(frame->bits));

	return clear->target == 0 && s[0] <= 0 && s[1] <= 0 && s[0] + s[2] >= (int32_t)frame->width &&
	       s[1] + s[3] >= (int32_t)frame->height && (!(clear->buffers & 1) || (clear->color_mask & 15) == 15) &&
	       (!(clear->buffers & 4) || (clear->stencil_mask & stencil) == stencil);
}

uint32_t segment_whole_clear(const struct frame *frame, struct scene_clear *out)
{
	const struct segment *segment = frame->prepared.segments;
	uint32_t n = 0;

	/* Depth that nothing cleared is 0, as Mesa's is; GL does not say (GL 2.1 sec. 4.2.3). */
	*out = (struct scene_clear){ .buffers = 7,
		                     .scissor = { 0, 0, (int32_t)frame->width, (int32_t)frame->height },
		                     .color_mask = 15,
		                     .stencil_mask = 0xffffffffu,
		                     .floats = frame->scene->floats };
	for (; frame->prepared.n_segments && n < segment->clear_count; n++) {
		const struct scene_clear *next = &frame->scene->clears[segment->clear_first + n];

		if (!clears_whole(frame, next))
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

int segment_clear_one(const struct frame *frame)
{
	static const struct frame_pixel nothing;
	const struct camera_rectangle one = { 0, 0, 1, 1 };
	struct scene_clear clear;
	int err = launch_upload(frame->tr->dev, frame->tr->band->cleared, &nothing, 1);

	segment_whole_clear(frame, &clear);
	return err ? err :
	             launch_clear(frame->tr->dev, 1,
	                          LAUNCH(clear, .clear = clear, .rectangle = one, .width = 1, .bits = frame->bits,
	                                 .n = 1, .frame = frame->tr->band->cleared));
}

int segment_clear_first(const struct band *band)
{
	const struct frame *frame = band->frame;

	/* The top band is drawn first. A device that ran out of memory may have released the buffer since. */
	if (band->row_first + band->n_rows < frame->height && frame->tr->band->cleared.buffer)
		return 0;
	return segment_clear_one(frame);
}

/* 1 if all pixels begin with the same value, are drawn to only by resolve_packet (not by a hook's rays), and go into
 * one picture. n_cleared: number of clears of the whole picture */
static int clears_late(const struct pass *pass, uint32_t n_cleared)
{
	const struct frame *frame = pass->frame;
	uint32_t n = 0;

	for (uint32_t i = 0; i < frame->prepared.n_segments; i++)
		n += frame->prepared.segments[i].clear_count;
	return frame_in_packets(frame) && pass->image && pass->count == 1 && pass->n_samples == 1 &&
	       secondary_transport(frame->options) != TRANSPORT_LINEAR && n == n_cleared &&
	       !hooks_has(frame, HOOK_RAY_GENERATION | HOOK_INTERSECTION);
}

int segment_say_drawn(const struct band *band, int drawn)
{
	const struct frame *frame = band->frame;
	const uint32_t rows = frame_columns(frame->width) * band->n_rows;

	if (!frame_in_packets(frame))
		return 0;
	memset(frame->tr->band->host_counts, drawn ? 0xff : 0, rows * sizeof(*frame->tr->band->host_counts));
	return launch_upload(frame->tr->dev, frame->tr->band->drawn, frame->tr->band->host_counts, rows);
}

int segment_clear_all(struct band *band, uint32_t *n_done)
{
	struct scene_clear clear;
	int late, err;

	*n_done = segment_whole_clear(band->frame, &clear);
	late = clears_late(band->pass, *n_done);
	memcpy(band->background, clear.color, sizeof(band->background));
	err = segment_say_drawn(band, !late);
	if (err)
		return err;
	return late ? segment_clear_one(band->frame) : run_clear(band, &clear);
}

struct camera_pass_launch segment_camera_pass(const struct band *band, const struct segment *segment,
                                              struct camera_rectangle r, uint32_t first)
{
	const struct frame *frame = band->frame;
	struct band_buffers *b = frame->tr->band;

	return *LAUNCH(camera_pass, .view_index = segment->view, .views = frame->tr->placed.views,
	               .width = frame->width, .height = frame->height, .rectangle = r,
	               .first_pixel = frame_first_pixel(band) - first, .mode = segment->mode,
	               .window = frame->tr->placed.windows, .clip = frame->tr->placed.clips, .after = b->after,
	               .fragments = b->sparse, .counts = b->counts);
}

int segment_trace_camera(const struct band *band, const struct segment *segment, struct camera_rectangle r,
                         uint32_t first)
{
	const struct frame *frame = band->frame;
	const struct camera_pass_launch pass = segment_camera_pass(band, segment, r, first);

	return traverse_camera(frame->tr->dev, traverse_families[device_family(frame->tr->dev)].camera,
	                       &frame->tr->trees, r, &pass);
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
 * Compute the position of each pixel's fragments in the dense list, block by block, into the buffer `first`.
 * @param n_list  receives the number of fragments
 * @param more    receives 1 if all slots of a pixel were filled: its column may continue
 */
static int place_fragments(const struct band *band, struct camera_rectangle r, uint32_t slots, uint32_t *n_list,
                           int *more)
{
	struct tracer *tr = band->frame->tr;
	uint32_t next = 0;
	int err = device_read(tr->dev, tr->band->counts.buffer, 0, tr->band->host_counts,
	                      band->n_pixels * sizeof(*tr->band->host_counts));

	*more = 0;
	for (int32_t y0 = r.y0; y0 < r.y1 && !err; y0 = block_end(y0, r.y1))
		for (int32_t x0 = r.x0; x0 < r.x1; x0 = block_end(x0, r.x1))
			for (int32_t y = y0; y < block_end(y0, r.y1); y++)
				for (int32_t x = x0; x < block_end(x0, r.x1); x++) {
					uint32_t number = (uint32_t)y * band->frame->width + (uint32_t)x,
						 pixel = number - frame_first_pixel(band);

					if (band->pass->number && !sample_takes_part(number, band->pass->turn))
						tr->band->host_counts[pixel] = 0;
					tr->band->host_first[pixel] = next;
					next += tr->band->host_counts[pixel];
					*more |= slots > 1 && tr->band->host_counts[pixel] == slots;
				}
	*n_list = next;
	if (!err && band->pass->number)
		err = launch_upload(tr->dev, tr->band->counts, tr->band->host_counts, band->n_pixels);
	return err ? err : launch_upload(tr->dev, tr->band->first, tr->band->host_first, band->n_pixels);
}

/*
 * The same in the order of pixels, computed on the device, if a work item takes one fragment and all pixels are
 * included. Neither counts nor positions are then copied to the host.
 */
static int place_on_device(const struct band *band, uint32_t slots, uint32_t *n_list, int *more)
{
	struct band_buffers *b = band->frame->tr->band;
	const struct scan_list list = { b->counts, band->n_pixels, slots > 1 ? slots : SCENE_NONE, &b->first,
		                        &b->scan };

	return scan_counts(band->frame->tr->dev, &list, n_list, more);
}

/* 1 if a rectangle covers the whole band. */
static int is_band(const struct band *band, struct camera_rectangle r)
{
	r = segment_in_buffers(band, r);
	return r.x0 == 0 && r.y0 == 0 && r.x1 == (int32_t)band->frame->width && r.y1 == (int32_t)band->n_rows;
}

/* Make the list of n_list fragments. */
static int run_gather(const struct band *band, struct camera_rectangle r, uint32_t slots, uint32_t n_list,
                      struct fragment_list *out)
{
	const struct frame *frame = band->frame;
	const struct band_buffers *b = frame->tr->band;
	const uint32_t n = rectangle_area(r);
	int err = band_reserve_list(frame, n_list, out);

	if (err)
		return err;
	return launch_gather(frame->tr->dev, n,
	                     LAUNCH(gather, .sparse = b->sparse, .counts = b->counts, .slots = slots, .first = b->first,
	                            .list = out->fragments, .pixels = out->pixels, .after = b->after,
	                            .rectangle = segment_in_buffers(band, r), .width = frame->width,
	                            .first_pixel = frame_first_pixel(band), .n = n));
}

/* visibility: of `slots` lights */
static int run_shade(const struct band *band, uint32_t bits, const struct fragment_list *list, uint32_t slots,
                     union buffer_float visibility)
{
	const struct frame *frame = band->frame;
	const struct placed_buffers *p = &frame->tr->placed;
	struct device *dev = frame->tr->dev;
	const uint32_t n = list->n, transport = secondary_transport(frame->options);
	const uint32_t albedo = transport >= TRANSPORT_DIFFUSE ||
	                        (band->pass->image && compose_asks(frame->options, "albedo"));
	const struct shade_launch *a = LAUNCH(
		shade, .tables = frame_tables(frame->tr), .views = p->views, .windows = p->windows,
		.fragments = list->fragments, .pixels = list->pixels, .width = frame->width, .height = frame->height,
		.bits = bits, .visibility = visibility, .n_slots = slots, .transport = transport, .albedo = albedo,
		.n = n, .programs = p->programs, .output = frame->scene->output, .shaded = list->shaded);
	const int in_packets = frame_in_packets(frame);
	const uint32_t packets = (n + SHADE_PACKET - 1) / SHADE_PACKET;
	int err = in_packets ? launch_shade_packet(dev, packets, a) : launch_shade(dev, n, a);

	if (err || !(frame->prepared.has_fragment_programs || (slots && frame->prepared.has_vertex_programs)))
		return err;
	return in_packets ? launch_program_packet(dev, packets, a) : launch_program(dev, n, a);
}

static int run_resolve(const struct band *band, const struct target *to, struct camera_rectangle r)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	const struct band_buffers *b = tr->band;
	const int packets = frame_in_packets(frame);
	const uint32_t n = packets ? frame_columns(frame->width) * (uint32_t)(r.y1 - r.y0) : rectangle_area(r);
	const struct resolve_launch *a = LAUNCH(
		resolve, .tables = frame_tables(tr), .fragments = b->fragments, .shaded = b->shaded, .first = b->first,
		.counts = b->counts, .rectangle = segment_in_buffers(band, r), .width = frame->width, .bits = to->bits,
		.n = n, .cleared = b->cleared, .drawn = b->drawn, .frame = to->frame);

	return packets ? launch_resolve_packet(tr->dev, n, a) : launch_resolve(tr->dev, n, a);
}

/* Trace the rays of shaded fragments, in the modes that add light to GL's. visibility: of no lights */
static int trace_list(const struct band *band, uint32_t bits, uint32_t view, const struct fragment_list *list,
                      union buffer_float visibility)
{
	const struct frame *frame = band->frame;
	const struct accel_space *space = secondary_space(frame, view, 0);
	const uint32_t transport = secondary_transport(frame->options);
	const int is_hooked = hooks_has(frame, HOOK_ANY_HIT | HOOK_CLOSEST_HIT);
	int err = 0;

	if (frame->prepared.n_light_slots)
		err = secondary_shadows(band->pass, space, list, &visibility);
	if (!err && frame->prepared.n_light_slots)
		err = run_shade(band, bits, list, frame->prepared.n_light_slots, visibility);
	if (!err && is_hooked)
		err = hooks_shade(frame, space, transport, list, visibility);
	if (!err && frame->options->depth &&
	    (frame->prepared.has_mirrors || transport >= TRANSPORT_DIFFUSE || is_hooked))
		err = secondary_paths(band, space, secondary_space(frame, view, 1), list);
	return err;
}

/* Shade the fragments of the list: GL's colours, then the results of rays from them. bits: of their target */
static int shade_list(const struct band *band, uint32_t bits, uint32_t view, struct camera_rectangle r,
                      const struct fragment_list *list)
{
	const struct frame *frame = band->frame;
	const struct accel_space *space = secondary_space(frame, view, 0);
	const struct dome_area area = { segment_in_buffers(band, r), frame->tr->band->counts, frame->tr->band->first };
	enum tracer_mode mode = frame->options->mode;
	struct light_rays none; /* no lights yet */
	int err = secondary_reserve_rays(frame, 1, NULL, &none);

	if (!err)
		err = run_shade(band, bits, list, 0, none.visibility);
	if (err || !space || mode == TRACER_GL || mode == TRACER_NORMALS)
		return err;
	if (mode == TRACER_AO || mode == TRACER_AO_PHONG)
		return secondary_openness(band->pass, space, list);
	err = trace_list(band, bits, view, list, none.visibility);
	return err || !dome_is_there(frame) ? err : dome_light_list(band, space, list, &area);
}

int segment_reserve(const struct band *band, uint32_t slots)
{
	struct tracer *tr = band->frame->tr;
	int err = launch_reserve(tr->dev, tr->band->counts, band->n_pixels);

	if (!err)
		err = launch_reserve(tr->dev, tr->band->after, band->n_pixels);
	return err ? err : launch_reserve(tr->dev, tr->band->sparse, (size_t)slots * band->n_pixels);
}

/* Resolve the fragments of a segment without multisampling, which affect all samples alike. */
static int resolve_all(const struct band *band, struct camera_rectangle r)
{
	int err = 0;

	for (uint32_t i = 0; i < band->pass->n_samples && !err; i++) {
		const struct target to = target_of(band->pass, i, i ? PIXEL_FOLLOWS : 0);

		err = run_resolve(band, &to, r);
	}
	return err;
}

/* Draw a segment to a sample; without multisampling, to all samples. view: as on the device */
static int run_draws(const struct band *band, const struct segment *segment, const struct view *view,
                     const struct target *to)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	struct camera_rectangle r = segment_rectangle(band, view->scissor);
	uint32_t slots = segment->mode == CAMERA_COLUMN ? CAMERA_COLUMN_MAX : 1, n_list;
	struct fragment_list list;
	int more = rectangle_area(r) != 0, err;

	if (!more)
		return 0;
	err = segment_reserve(band, slots);
	if (!err && slots > 1) { /* columns start at the first fragment */
		memset(tr->band->host_counts, 0, band->n_pixels * sizeof(*tr->band->host_counts));
		err = launch_upload(tr->dev, tr->band->after, tr->band->host_counts, band->n_pixels);
	}
	while (more && !err) {
		err = segment_trace_camera(band, segment, r, 0);
		if (!err)
			err = frame_in_packets(frame) || band->pass->number || !is_band(band, r) ?
			              place_fragments(band, r, slots, &n_list, &more) :
			              place_on_device(band, slots, &n_list, &more);
		if (err || n_list == 0)
			break;
		err = run_gather(band, r, slots, n_list, &list);
		if (!err)
			err = shade_list(band, to->bits, segment->view, r, &list);
		if (!err)
			err = segment->multisample ? run_resolve(band, to, r) : resolve_all(band, r);
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

/* Set a segment's view on the device to a sample's positions. view: receives it */
static int look_at_sample(const struct frame *frame, const struct segment *segment, uint32_t sample, struct view *view)
{
	const int32_t *place = sample_places[sample], *scissor = frame->prepared.scene_views[segment->view].scissor;
	int32_t from_below = frame->scene->samples_from_below != 0, left = leaks(scissor[0], place[0]);
	int32_t row = leaks(from_below ? scissor[1] : (int32_t)frame->height - scissor[1] - scissor[3], place[1]);

	*view = frame->prepared.views[segment->view];
	view->sample[0] = place[0];
	view->sample[1] = from_below ? place[1] : -place[1];
	view->scissor[0] = scissor[0] - left;
	view->scissor[1] = scissor[1] - (from_below ? row : 0);
	view->scissor[2] = scissor[2] + left;
	view->scissor[3] = scissor[3] + row;
	return device_write(frame->tr->dev, frame->tr->placed.views.buffer, segment->view * sizeof(*view), view,
	                    sizeof(*view));
}

int segment_clear(struct band *band, const struct segment *segment, uint32_t n_cleared)
{
	int err = 0;

	for (uint32_t i = n_cleared; i < segment->clear_count && !err; i++)
		err = run_clear(band, &band->frame->scene->clears[segment->clear_first + i]);
	return err;
}

int segment_run(struct band *band, const struct segment *segment, uint32_t n_cleared)
{
	const struct frame *frame = band->frame;
	const struct pass *pass = band->pass;
	const int32_t *scissor;
	struct target to;
	struct view view;
	int err = segment_clear(band, segment, n_cleared);

	if (err || segment->view == SCENE_NONE || segment->instance_count == 0)
		return err;
	scissor = frame->prepared.scene_views[segment->view].scissor;
	if (rectangle_area(
		    camera_rectangle(scissor[0], scissor[1], scissor[2], scissor[3], frame->width, frame->height)) == 0)
		return 0;
	to = target_of(pass, 0, segment->multisample && pass->number ? (pass->number % SCENE_SAMPLES + 1) << 24 : 0);
	if (!segment->multisample || pass->n_samples == 1)
		return run_draws(band, segment, &frame->prepared.views[segment->view], &to);
	for (uint32_t i = 0; i < pass->n_samples && !err; i++) {
		to = target_of(pass, i, (i + 1) << 24);
		err = look_at_sample(frame, segment, i, &view);
		if (!err)
			err = run_draws(band, segment, &view, &to);
	}
	return err;
}

int segment_merge_samples(const struct band *band)
{
	const struct pixel_buffers *p = &band->frame->tr->pixels;

	return launch_merge_samples(band->frame->tr->dev, band->n_pixels,
	                            LAUNCH(merge_samples, .first = p->samples[0], .second = p->samples[1],
	                                   .third = p->samples[2], .fourth = p->samples[3], .n = band->n_pixels,
	                                   .frame = p->frame));
}
