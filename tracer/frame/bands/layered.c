#include "tracer/frame/bands/layered.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "kernels/camera/camera.h"
#include "kernels/frame/plain/plain.h"
#include "kernels/gl/pixel.h"
#include "packs.h"
#include "tracer/frame/bands/buffers.h"
#include "tracer/frame/bands/plain.h"
#include "tracer/frame/bands/segment.h"
#include "tracer/frame/light/dome.h"
#include "tracer/frame/light/secondary.h"
#include "tracer/frame/picture/compose.h"
#include "tracer/frame/picture/picture.h"

/* A round of looks at a band, each a camera pass over a segment. columns, asking: as in layers_launch. */
struct looks {
	uint32_t n, most; /* most: looks that there is room for */
	uint32_t layers;  /* layers of the block with the most */
	uint32_t columns, asking;
	union buffer_float *before, *after; /* pixels passed from round to round; exchanged at the end of each */
	const struct compose_planes *planes;
	const struct accel_space *space, *sky; /* space: for rays to lights; sky: for rays that hit nothing */
	uint32_t next; /* segment to look at next: the same one if goes_on, from the positions in host_counts */
	int goes_on;
	struct layer_clear *clears; /* room for all clears of the frame */
	uint32_t n_clears, cleared; /* n_clears: of this round; clears of segments before `cleared` are done */
	uint32_t skipped;           /* clears of the first segment that are part of the initial pixels */
};

/* Room for a round's fragments and their rays. */
struct places {
	struct fragment_list alone, leaving; /* those shaded one by one; those that reflect or transmit light */
	struct light_rays rays;
	uint32_t n_slots;
	struct dome_plain dome; /* none */
};

static const struct accel_space *space_of(const struct frame *frame, const struct segment *segment)
{
	return frame->options->mode == TRACER_GL ? NULL : secondary_space(frame, segment->view, 0);
}

/* 1 if a segment's rays need another space than those of the round so far. */
static int leaves_space(const struct frame *frame, const struct segment *segment, const struct looks *looks)
{
	const int has_rays = frame->prepared.n_light_slots || plain_has_mirrors(frame);
	const struct accel_space *own = has_rays ? space_of(frame, segment) : NULL;

	return own && looks->space && own != looks->space;
}

/* Number of the first segment's clears that are part of the initial pixels. */
static uint32_t cleared_first(const struct frame *frame, struct scene_clear *clear)
{
	const uint32_t n = segment_whole_clear(frame, clear);

	return frame->scene->start ? 0 : n;
}

/* 1 if later clears affect none of these buffers (bits as in a Clear). */
static int keeps_uncleared(const struct frame *frame, uint32_t buffers)
{
	struct scene_clear clear;
	uint32_t first = cleared_first(frame, &clear);

	for (uint32_t i = 0; i < frame->prepared.n_segments; i++, first = 0) {
		const struct segment *segment = &frame->prepared.segments[i];

		for (uint32_t k = first; k < segment->clear_count; k++)
			if (frame->scene->clears[segment->clear_first + k].target == 0 &&
			    frame->scene->clears[segment->clear_first + k].buffers & buffers)
				return 0;
	}
	return 1;
}

/* Buffers that all pixels begin with cleared. */
static uint32_t cleared_buffers(const struct frame *frame)
{
	struct scene_clear clear;
	const uint32_t n = cleared_first(frame, &clear);
	uint32_t buffers = 0;

	for (uint32_t i = 0; i < n; i++)
		buffers |= frame->scene->clears[frame->prepared.segments[0].clear_first + i].buffers;
	return buffers;
}

/* 1 if unknown colours from before the frame may show. */
static int is_unknown(const struct frame *frame)
{
	return frame->scene->needs_previous && !frame->scene->start && !(cleared_buffers(frame) & 1);
}

/* For a picture: 1 if at most the colour of its pixels is unknown, and the stencil is unchanged. */
static int suits_picture(const struct pass *pass)
{
	const struct frame *frame = pass->frame;
	const struct scene *scene = frame->scene;

	if (pass->picture->colors || pass->picture->samples ||
	    (scene->needs_previous && !scene->start && !(cleared_buffers(frame) & 2)))
		return 0;
	for (uint32_t i = 0; i < scene->n_rectangles && scene->stencil_bits; i++)
		if (scene->rectangles[i].kind == SCENE_STENCIL_PIXELS)
			return 0;
	return !scene->stencil_bits || keeps_uncleared(frame, 4);
}

/* For an image: 1 if at most the colour of its pixels is unknown, and that may be made later. */
static int suits_image(const struct frame *frame)
{
	const struct scene *scene = frame->scene;

	return !scene->needs_previous || scene->start || (scene->before && cleared_buffers(frame) & 2);
}

int layered_suits(const struct pass *pass)
{
	const struct frame *frame = pass->frame;
	const struct prepared *p = &frame->prepared;

	if (!frame_in_packets(frame) || !plain_is_simple(pass) || !keeps_uncleared(frame, 1) || dome_is_there(frame) ||
	    p->has_fragment_programs || p->has_vertex_programs)
		return 0;
	if ((frame->scene->start && frame->scene->start->colors) ||
	    !(pass->image ? suits_image(frame) : suits_picture(pass)))
		return 0;
	for (uint32_t i = 0; i < p->n_instances; i++)
		if (pack_refuses_layers(&frame->scene->materials[p->instances[i].material], pixel_stencil_bits(frame->bits) != 0,
		                        plain_has_mirrors(frame)))
			return 0;
	return 1;
}

/* 1 if a pixel may have many fragments. */
static int has_columns(const struct frame *frame)
{
	int columns = 0;

	for (uint32_t i = 0; i < frame->prepared.n_segments; i++)
		columns |= frame->prepared.segments[i].mode == CAMERA_COLUMN;
	return columns;
}

uint32_t layered_pixels(const struct frame *frame)
{
	return has_columns(frame) ? 16384u : 65536u;
}

/* --- Looks ------------------------------------------------------------------------------------------------------- */

/* Clear the counts of a look: they are 0 outside its rectangle. */
static int clear_look(const struct band *band, const struct looks *looks)
{
	struct tracer *tr = band->frame->tr;
	const uint32_t first = plain_look_first(looks->columns, looks->n, band->n_pixels);
	const size_t bytes = band->n_pixels * sizeof(*tr->band->host_counts);

	memset(tr->band->host_counts, 0, bytes);
	return device_write(tr->dev, tr->band->counts.buffer, first * sizeof(*tr->band->host_counts),
	                    tr->band->host_counts, bytes);
}

/* Make room for one look at each segment, and one more for continued columns. */
static int reserve_looks(const struct band *band, struct looks *looks)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	size_t n;
	int err;

	looks->most = has_columns(frame);
	for (uint32_t i = 0; i < frame->prepared.n_segments; i++)
		looks->most += frame->prepared.segments[i].view != SCENE_NONE;
	looks->most = looks->most < PLAIN_LOOKS ? looks->most : PLAIN_LOOKS;
	n = (size_t)looks->most * band->n_pixels;
	err = launch_reserve(tr->dev, tr->band->counts, n * CAMERA_COLUMN_MAX);
	if (!err)
		err = launch_reserve(tr->dev, tr->band->after, n);
	return err ? err : launch_reserve(tr->dev, tr->band->sparse, n * CAMERA_COLUMN_MAX);
}

/* Add a look's counts, in host_counts, to the layers of blocks, in host_first. @return most layers of a pixel */
static uint32_t add_layers(const struct band *band, struct looks *looks)
{
	const struct frame *frame = band->frame;
	const uint32_t columns = plain_columns(frame->width), *counts = frame->tr->band->host_counts;
	uint32_t most_of_all = 0;

	for (uint32_t y0 = 0; y0 < band->n_rows; y0 += PLAIN_ROWS)
		for (uint32_t x0 = 0; x0 < frame->width; x0 += PLAIN_WIDTH) {
			uint32_t *layers = &frame->tr->band->host_first[y0 / PLAIN_ROWS * columns + x0 / PLAIN_WIDTH],
				 most = 0;

			for (uint32_t y = y0; y < y0 + PLAIN_ROWS && y < band->n_rows; y++)
				for (uint32_t x = x0; x < x0 + PLAIN_WIDTH && x < frame->width; x++)
					most = counts[y * frame->width + x] > most ? counts[y * frame->width + x] :
					                                             most;
			*layers += most;
			looks->layers = *layers > looks->layers ? *layers : looks->layers;
			most_of_all = most > most_of_all ? most : most_of_all;
		}
	return most_of_all;
}

/* Find where the columns filled by the last look continue. host_counts: its counts, replaced by these positions. */
static int go_on(const struct band *band, const struct looks *looks)
{
	struct tracer *tr = band->frame->tr;
	const uint32_t from = plain_look_first(looks->columns, looks->n - 1, band->n_pixels);
	const struct fragment *sparse;
	const void *mapped;
	int err = device_map(tr->dev, tr->band->sparse.buffer,
	                     ((size_t)from + band->n_pixels) * CAMERA_COLUMN_MAX * sizeof(*sparse), 1, &mapped);

	if (err)
		return err;
	sparse = mapped;
	for (uint32_t i = 0; i < band->n_pixels; i++)
		tr->band->host_counts[i] = tr->band->host_counts[i] == CAMERA_COLUMN_MAX ?
		                        sparse[((size_t)from + i + 1) * CAMERA_COLUMN_MAX - 1].order + 1 :
		                        SCENE_NONE;
	return device_unmap(tr->dev, tr->band->sparse.buffer, mapped);
}

/* Look once at a rectangle of a segment. */
static int look_at(const struct band *band, const struct segment *segment, struct camera_rectangle r,
                   struct looks *looks)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	const struct accel_space *space = space_of(frame, segment);
	const uint32_t is_column = segment->mode == CAMERA_COLUMN;
	const size_t bytes = band->n_pixels * sizeof(*tr->band->host_counts);
	uint32_t first;
	int err = 0;

	looks->columns |= is_column << looks->n;
	looks->asking |= (space != NULL) << looks->n;
	looks->space = space ? space : looks->space;
	looks->sky = space ? secondary_space(frame, segment->view, 1) : looks->sky;
	first = plain_look_first(looks->columns, looks->n, band->n_pixels);
	if (!looks->goes_on)
		memset(tr->band->host_counts, 0, bytes); /* columns start at the first fragment */
	if (is_column)
		err = device_write(tr->dev, tr->band->after.buffer, first * sizeof(*tr->band->host_counts),
		                   tr->band->host_counts, bytes);
	if (!err)
		err = clear_look(band, looks);
	if (!err)
		err = segment_trace_camera(band, segment, r, first);
	if (!err)
		err = device_read(tr->dev, tr->band->counts.buffer, first * sizeof(*tr->band->host_counts),
		                  tr->band->host_counts, bytes);
	looks->n++;
	looks->goes_on = !err && add_layers(band, looks) == CAMERA_COLUMN_MAX && is_column;
	return looks->goes_on ? go_on(band, looks) : err;
}

/* Add the clears of a segment before the next look. */
static void clear_segment(const struct band *band, const struct segment *segment, struct looks *looks)
{
	const uint32_t bits = pixel_depth_bits(band->frame->bits);

	for (uint32_t i = looks->cleared ? 0 : looks->skipped; i < segment->clear_count; i++) {
		const struct scene_clear *clear = &band->frame->scene->clears[segment->clear_first + i];
		const struct camera_rectangle r = segment_in_buffers(band, segment_rectangle(band, clear->scissor));

		if (clear->target == 0 && clear->buffers & 2)
			looks->clears[looks->n_clears++] = (struct layer_clear){ looks->n,
				                                                 r.x0,
				                                                 r.y0,
				                                                 r.x1,
				                                                 r.y1,
				                                                 pixel_depth_steps(clear->depth, bits),
				                                                 clamp01(clear->depth) };
	}
	looks->cleared++;
}

/* Run the looks of one round. host_first receives the layers of blocks. */
static int look_around(const struct band *band, struct looks *looks)
{
	const struct frame *frame = band->frame;
	const struct prepared *p = &frame->prepared;
	int err = 0;

	looks->n = looks->layers = looks->columns = looks->asking = looks->n_clears = 0;
	looks->space = looks->sky = NULL;
	memset(frame->tr->band->host_first, 0,
	       plain_blocks(frame->width, band->n_rows) * sizeof(*frame->tr->band->host_first));
	while (!err && looks->next < p->n_segments) {
		const struct segment *segment = &p->segments[looks->next];
		const uint32_t slots = segment->mode == CAMERA_COLUMN ? CAMERA_COLUMN_MAX : 1;

		if (segment->view != SCENE_NONE && segment->instance_count) {
			const struct camera_rectangle r = segment_rectangle(band, p->views[segment->view].scissor);

			if (looks->n == looks->most || looks->layers + slots > PLAIN_LAYERS ||
			    leaves_space(frame, segment, looks))
				return 0;
			if (looks->cleared == looks->next)
				clear_segment(band, segment, looks);
			if (r.x0 < r.x1)
				err = look_at(band, segment, r, looks);
		} else if (looks->cleared == looks->next) {
			clear_segment(band, segment, looks);
		}
		looks->next += !looks->goes_on;
	}
	return err;
}

/* Give blocks with fragments their places, one per layer. @return number of pixels in all places */
static uint32_t place_blocks(const struct band *band)
{
	const struct frame *frame = band->frame;
	const uint32_t blocks = plain_blocks(frame->width, band->n_rows);
	uint32_t next = 0;

	for (uint32_t i = 0; i < blocks; i++) {
		const uint32_t layers = frame->tr->band->host_first[i];

		frame->tr->band->host_first[i] = layers ? next : SCENE_NONE;
		next += layers;
	}
	return next * PLAIN_WIDTH * PLAIN_ROWS;
}

/* --- Drawing ----------------------------------------------------------------------------------------------------- */

/* Make room for n fragments that are shaded one by one, and for the rays of all. */
static int reserve_places(const struct frame *frame, uint32_t n, uint32_t n_slots, struct places *out)
{
	struct device *dev = frame->tr->dev;
	struct band_buffers *b = frame->tr->band;
	int err;

	if ((err = launch_reserve(dev, b->alone_fragments, n)) || (err = launch_reserve(dev, b->alone_pixels, n)) ||
	    (err = launch_reserve(dev, b->alone_shaded, n)) ||
	    (err = launch_reserve(dev, b->leaving, n / PLAIN_WIDTH)) ||
	    (err = launch_reserve(dev, b->leaving_first, n / PLAIN_WIDTH)) ||
	    (err = band_reserve_list(frame, 1, &out->leaving)) || (err = dome_prepare_none(frame, &out->dome)))
		return err;
	out->alone = (struct fragment_list){ b->alone_fragments, b->alone_pixels, b->alone_shaded, n };
	out->n_slots = n_slots;
	return secondary_reserve_rays(frame, n_slots ? (size_t)n * n_slots : 1, &b->layer_visibility, &out->rays);
}

/* round: PLAIN_BEGINS and similar flags */
static struct plain_launch launch_of(const struct band *band, const struct looks *looks, const struct places *places,
                                     uint32_t round)
{
	const struct band_buffers *b = band->frame->tr->band;
	struct plain_launch a = plain_launch_of(band, &places->alone, &places->rays, places->n_slots, &places->dome,
	                                        looks->planes);

	a.layers = *LAUNCH(layers, .counts = b->counts, .n_looks = looks->n, .columns = looks->columns,
	                   .asking = looks->asking, .round = round, .clears = b->layer_clears,
	                   .n_clears = looks->n_clears, .before = *looks->before, .after = *looks->after,
	                   .unknown = b->unknown, .mirrors = looks->space && plain_has_mirrors(band->frame),
	                   .leaving = b->leaving, .list_first = b->leaving_first, .list = places->leaving.fragments,
	                   .list_pixels = places->leaving.pixels, .list_shaded = places->leaving.shaded);
	return a;
}

/* Give the fragments that reflect or transmit light, out of n, their places in the list. */
static int place_leaving(const struct frame *frame, uint32_t n, struct fragment_list *out)
{
	struct tracer *tr = frame->tr;
	const uint32_t rows = n / PLAIN_WIDTH;
	uint32_t *first = malloc(rows * sizeof(*first)), n_list = 0;
	const void *mapped;
	int err;

	if (!first)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u rows of pixels", rows);
	err = device_map(tr->dev, tr->band->leaving.buffer, rows * sizeof(*first), 1, &mapped);
	for (uint32_t i = 0; i < rows && !err; i++) {
		first[i] = n_list;
		for (uint32_t left = ((const uint32_t *)mapped)[i]; left; left &= left - 1)
			n_list++;
	}
	if (!err)
		err = device_unmap(tr->dev, tr->band->leaving.buffer, mapped);
	if (!err)
		err = launch_upload(tr->dev, tr->band->leaving_first, first, rows);
	free(first);
	if (!err && n_list)
		err = band_reserve_list(frame, n_list, out);
	out->n = n_list;
	return err;
}

/* Follow paths from the list, then make all planes if there are any. */
static int follow(const struct band *band, const struct looks *looks, struct places *places, uint32_t round)
{
	const struct frame *frame = band->frame;
	struct plain_launch a;
	int err = secondary_paths(band, looks->space, looks->sky, &places->leaving);

	if (!err) /* paths may have replaced the buffer of rays */
		err = secondary_reserve_rays(frame, 1, &frame->tr->band->layer_visibility, &places->rays);
	if (err)
		return err;
	a = launch_of(band, looks, places, round);
	return launch_layered_mirror(frame->tr->dev, plain_blocks(frame->width, band->n_rows), &a);
}

/* Draw all planes without shadows and mirrors, trace rays to lights, then redraw the planes that these change. n:
 * number of fragments */
static int draw(const struct band *band, const struct looks *looks, uint32_t round, uint32_t n)
{
	const struct frame *frame = band->frame;
	const uint32_t blocks = plain_blocks(frame->width, band->n_rows),
		       n_slots = looks->space && n ? frame->prepared.n_light_slots : 0;
	struct places places = { .n_slots = 0 };
	struct plain_launch a;
	int err = reserve_places(frame, n, n_slots, &places);

	if (!err)
		err = launch_upload(frame->tr->dev, frame->tr->band->layer_clears, looks->clears, looks->n_clears + 1);
	if (err)
		return err;
	a = launch_of(band, looks, &places, round);
	places.leaving.n = 0;
	err = launch_layered(frame->tr->dev, blocks, &a);
	if (!err && n_slots)
		err = plain_trace_rays(frame, looks->space, &a);
	if (!err && n && a.layers.mirrors)
		err = place_leaving(frame, n, &places.leaving);
	if (err || !(n_slots || places.leaving.n))
		return err;
	a = launch_of(band, looks, &places, round);
	if (round & PLAIN_ENDS) /* other rounds pass on whole pixels */
		a.request = plain_shadow_request(a.request);
	err = launch_layered_shadow(frame->tr->dev, blocks, &a);
	return err || !places.leaving.n ? err : follow(band, looks, &places, round);
}

/* Make room for the state passed from one round to the next, if there are several. */
static int reserve_kept(const struct band *band, const struct looks *looks, int is_only)
{
	const struct frame *frame = band->frame;
	const size_t n = is_only ? 1 : (size_t)plain_columns(frame->width) * PLAIN_WIDTH * band->n_rows * PLAIN_KEPT;
	int err = launch_reserve(frame->tr->dev, *looks->before, n);

	return err ? err : launch_reserve(frame->tr->dev, *looks->after, n);
}

/* Flags of a round, except PLAIN_ENDS. */
static uint32_t round_of(const struct frame *frame, int is_first)
{
	if (!is_first)
		return plain_has_mirrors(frame) ? PLAIN_MIRRORED : 0;
	return frame->scene->start ? 0 : PLAIN_BEGINS | (is_unknown(frame) ? PLAIN_UNKNOWN : 0);
}

/* Run a round with as many looks as there is room for, and draw the fragments found. is_first: first round of the band.
 * is_last: receives 1 if it was the last */
static int draw_round(const struct band *band, struct looks *looks, int is_first, int *is_last)
{
	const struct frame *frame = band->frame;
	union buffer_float *const before = looks->before;
	uint32_t n, round = round_of(frame, is_first);
	int err = look_around(band, looks);

	if (err)
		return err;
	*is_last = looks->next == frame->prepared.n_segments;
	round |= *is_last && band->pass->image ? PLAIN_ENDS : 0;
	n = place_blocks(band);
	err = launch_upload(frame->tr->dev, frame->tr->band->blocks, frame->tr->band->host_first,
	                    plain_blocks(frame->width, band->n_rows));
	if (!err)
		err = reserve_kept(band, looks, is_first && *is_last && band->pass->image && !frame->scene->start);
	if (!err && is_first && frame->scene->start)
		err = picture_keep_start(band, *looks->before);
	if (!err)
		err = draw(band, looks, round, n);
	looks->before = looks->after;
	looks->after = before;
	return err;
}

/* looks: has room for clears */
static int draw_band(struct band *band, struct looks *looks)
{
	const struct frame *frame = band->frame;
	struct compose_planes planes;
	struct scene_clear clear;
	int err, is_last = 0;

	looks->skipped = cleared_first(frame, &clear);
	memset(band->background, 0, sizeof(band->background));
	if (!frame->scene->start)
		memcpy(band->background, clear.color, sizeof(band->background));
	looks->planes = &planes;
	err = segment_clear_first(band);
	if (!err)
		err = band_reserve_counts(band);
	if (!err)
		err = reserve_looks(band, looks);
	if (!err)
		err = compose_reserve(band, &planes);
	if (!err)
		err = launch_reserve(frame->tr->dev, frame->tr->band->unknown,
		                     plain_columns(frame->width) * band->n_rows);
	for (int is_first = 1; !err && !is_last; is_first = 0)
		err = draw_round(band, looks, is_first, &is_last);
	if (err)
		return err;
	if (!band->pass->image)
		return picture_take_band(band, *looks->before, frame->tr->band->unknown, clear.stencil);
	err = compose_fetch(band, &planes);
	return err || !is_unknown(frame) ? err : picture_count_rows(band, frame->tr->band->unknown);
}

int layered_band(struct band *band)
{
	const struct frame *frame = band->frame;
	struct band_buffers *b = frame->tr->band;
	struct looks looks = { .before = &b->kept_pixels, .after = &b->next_pixels,
		               .clears = calloc(frame->scene->n_clears + (size_t)1, sizeof(*looks.clears)) };
	int err = looks.clears ? draw_band(band, &looks) :
	                         err_report(ERR_SYSTEM, NULL, "out of memory for %u clears", frame->scene->n_clears);

	free(looks.clears);
	return err;
}
