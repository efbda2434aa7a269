#include "tracer/frame/light/dome.h"

#include "kernels/frame/dome/dome.h"
#include "tracer/frame/light/secondary.h"

/* Divisor of options.rays, which is the number of rays for a single pixel: neighbours share theirs. */
#define RAYS_SHARED 8u
/* Rays per pixel that are traced at once. */
#define RAYS_AT_ONCE 2u

/* Rays per pixel in a pass. */
static uint32_t rays_of(const struct frame *frame)
{
	return (frame->options->rays + RAYS_SHARED - 1) / RAYS_SHARED;
}

/* Upload the directions of the rays of a block's pixels. first: index of the first ray over all passes */
static int upload_directions(const struct frame *frame, uint32_t first, uint32_t samples)
{
	float directions[RAYS_AT_ONCE][DOME_BLOCK * DOME_BLOCK][4];

	for (uint32_t i = 0; i < samples; i++)
		for (uint32_t k = 0; k < DOME_BLOCK * DOME_BLOCK; k++)
			dome_direction(&frame->scene->dome, k, first + i, directions[i][k]);
	return frame_upload(frame->tr, dome_directions, directions[0][0],
	                    samples * sizeof(directions[0]) / sizeof(directions[0][0][0]));
}

int dome_is_there(const struct frame *frame)
{
	return frame->scene->dome.reach > 0 && frame->options->mode == TRACER_WHITTED;
}

/* Make the rays of n fragments along the uploaded directions. */
static int find(const struct frame *frame, uint32_t samples, uint32_t n)
{
	struct tracer *tr = frame->tr;
	const struct frame_buffers *b = &tr->buffers;
	const struct dome_find_launch *a = LAUNCH(
		dome_find, .tables = frame_tables(tr), .views = b->views, .windows = b->windows,
		.fragments = b->fragments, .pixels = b->pixels, .width = frame->width, .shaded = b->shaded,
		.dome = frame->scene->dome, .directions = b->dome_directions, .samples = samples, .n = n,
		.places = b->dome_places, .rays = b->rays);

	if (frame_in_packets(frame))
		return launch_dome_find_packet(tr->dev, (n + SHADE_PACKET - 1) / SHADE_PACKET, a);
	return launch_dome_find(tr->dev, n, a);
}

/* Trace some rays of each of n fragments and add their results to those of earlier rays. first: index of the first of
 * these rays */
static int look_around(const struct frame *frame, const struct accel_space *space, union buffer_ray rays,
                       uint32_t first, uint32_t samples, uint32_t n)
{
	const struct frame_buffers *b = &frame->tr->buffers;
	const struct light_rays asked = { rays, b->visibility, samples * n, 0 };
	int err = secondary_ask(frame, space, &asked);

	return err ? err :
	             launch_dome_sum(frame->tr->dev, n,
	                             LAUNCH(dome_sum, .places = b->dome_places, .rays = rays,
	                                    .visibility = b->visibility, .dome = frame->scene->dome, .samples = samples,
	                                    .is_first = first == 0, .n = n, .sums = b->dome_sums));
}

/* Trace some rays of each fragment of the list. */
static int look_from_list(const struct pass *pass, const struct accel_space *space, uint32_t first, uint32_t samples,
                          uint32_t n)
{
	const struct frame *frame = pass->frame;
	int err = upload_directions(frame, pass->number * rays_of(frame) + first, samples);

	if (!err)
		err = find(frame, samples, n);
	return err ? err : look_around(frame, space, frame->tr->buffers.rays, first, samples, n);
}

/* in_blocks: as in kernels.h */
static int light(const struct band *band, struct camera_rectangle rectangle, uint32_t in_blocks, uint32_t n)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	const struct frame_buffers *b = &tr->buffers;
	const struct dome_light_launch *a = LAUNCH(
		dome_light, .places = b->dome_places, .sums = b->dome_sums, .pixels = b->pixels,
		.first = in_blocks ? b->pixels : b->first, .counts = b->counts, .rectangle = rectangle,
		.width = frame->width, .first_pixel = frame_first_pixel(band), .dome = frame->scene->dome,
		.in_blocks = in_blocks, .blocks = in_blocks ? b->blocks : b->counts, .n = n, .shaded = b->shaded,
		.factors = in_blocks ? b->dome_factors : b->dome_sums);

	if (frame_in_packets(frame))
		return launch_dome_light_packet(
			tr->dev, dome_columns(frame->width) * ((band->n_rows + CAMERA_TILE - 1) / CAMERA_TILE), a);
	return launch_dome_light(tr->dev, n, a);
}

/* Make room for the kernels' results for n fragments. */
static int reserve(const struct frame *frame, uint32_t n)
{
	int err = frame_reserve(frame->tr, dome_places, n);

	return err ? err : frame_reserve(frame->tr, dome_sums, 4 * (size_t)n);
}

int dome_light_list(const struct band *band, const struct accel_space *space, struct camera_rectangle rectangle,
                    uint32_t n)
{
	const struct frame *frame = band->frame;
	const uint32_t rays = rays_of(frame), most = rays < RAYS_AT_ONCE ? rays : RAYS_AT_ONCE;
	int err = secondary_reserve_rays(frame, (size_t)most * n, &frame->tr->buffers.visibility);

	if (!err)
		err = reserve(frame, n);
	for (uint32_t i = 0; i < rays && !err; i += most)
		err = look_from_list(band->pass, space, i, rays - i < most ? rays - i : most, n);
	return err ? err : light(band, rectangle, 0, n);
}

int dome_suits_plain(const struct frame *frame)
{
	return !dome_is_there(frame) || (rays_of(frame) <= RAYS_AT_ONCE && !frame->scene->n_programs);
}

int dome_prepare_plain(const struct frame *frame, uint32_t n, uint32_t *samples)
{
	int err = reserve(frame, n);

	*samples = rays_of(frame);
	if (!err)
		err = frame_reserve(frame->tr, dome_rays, (size_t)*samples * n);
	if (!err)
		err = frame_reserve(frame->tr, dome_factors, 3 * (size_t)n);
	if (!err)
		err = secondary_reserve_rays(frame, (size_t)*samples * n, &frame->tr->buffers.visibility);
	return err ? err : upload_directions(frame, 0, *samples);
}

int dome_light_plain(const struct band *band, const struct accel_space *space, const struct plain_launch *a)
{
	int err = look_around(band->frame, space, a->looks, 0, a->samples, a->n);

	return err ? err : light(band, a->rectangle, 1, a->n);
}
