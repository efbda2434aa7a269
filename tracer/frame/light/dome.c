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
	return launch_upload(frame->tr->dev, frame->tr->dome->directions, directions[0][0],
	                    samples * sizeof(directions[0]) / sizeof(directions[0][0][0]));
}

int dome_is_there(const struct frame *frame)
{
	return frame->scene->dome.reach > 0 && frame->options->mode == TRACER_WHITTED;
}

/* Make the rays of the fragments along the uploaded directions. */
static int find(const struct frame *frame, const struct fragment_list *from, uint32_t samples, union buffer_ray rays)
{
	const uint32_t n = from->n;
	struct tracer *tr = frame->tr;
	const struct dome_buffers *b = frame->tr->dome;
	const struct dome_find_launch *a = LAUNCH(
		dome_find, .tables = frame_tables(tr), .views = tr->placed.views, .windows = tr->placed.windows,
		.fragments = from->fragments, .pixels = from->pixels, .width = frame->width, .shaded = from->shaded,
		.dome = frame->scene->dome, .directions = b->directions, .samples = samples, .n = n,
		.places = b->places, .rays = rays);

	if (frame_in_packets(frame))
		return launch_dome_find_packet(tr->dev, (n + SHADE_PACKET - 1) / SHADE_PACKET, a);
	return launch_dome_find(tr->dev, n, a);
}

/* Trace `samples` rays of each of n fragments and add their results to those of earlier rays. is_first: there are none
 * yet */
static int look_around(const struct frame *frame, const struct accel_space *space, const struct light_rays *rays,
                       uint32_t is_first, uint32_t samples, uint32_t n)
{
	const struct dome_buffers *b = frame->tr->dome;
	int err = secondary_ask(frame, space, rays);

	return err ? err :
	             launch_dome_sum(frame->tr->dev, n,
	                             LAUNCH(dome_sum, .places = b->places, .rays = rays->rays,
	                                    .visibility = rays->visibility, .dome = frame->scene->dome,
	                                    .samples = samples, .is_first = is_first, .n = n, .sums = b->sums));
}

/* Trace some rays of each fragment of the list. first: index of the first of these rays; rays: room for them */
static int look_from_list(const struct pass *pass, const struct accel_space *space, const struct fragment_list *from,
                          struct light_rays rays, uint32_t first, uint32_t samples)
{
	const struct frame *frame = pass->frame;
	int err = upload_directions(frame, pass->number * rays_of(frame) + first, samples);

	if (!err)
		err = find(frame, from, samples, rays.rays);
	rays.n = samples * from->n;
	return err ? err : look_around(frame, space, &rays, first == 0, samples, from->n);
}

/* Work items of dome_light_packet. */
static uint32_t packets_of(const struct band *band)
{
	return dome_columns(band->frame->width) * ((band->n_rows + CAMERA_TILE - 1) / CAMERA_TILE);
}

/* Make room for the kernels' results for n fragments. */
static int reserve(const struct frame *frame, uint32_t n)
{
	int err = launch_reserve(frame->tr->dev, frame->tr->dome->places, n);

	return err ? err : launch_reserve(frame->tr->dev, frame->tr->dome->sums, 4 * (size_t)n);
}

/* Light the fragments of a list by the sums. */
static int apply_sums(const struct band *band, const struct fragment_list *from, const struct dome_area *area)
{
	const struct frame *frame = band->frame;
	const struct dome_buffers *b = frame->tr->dome;
	const struct dome_light_launch *a = LAUNCH(
		dome_light, .places = b->places, .sums = b->sums, .pixels = from->pixels, .first = area->first,
		.counts = area->counts, .rectangle = area->rectangle, .width = frame->width,
		.first_pixel = frame_first_pixel(band), .dome = frame->scene->dome, .in_blocks = 0,
		.blocks = area->counts, .n = from->n, .shaded = from->shaded, .factors = b->sums);

	if (frame_in_packets(frame))
		return launch_dome_light_packet(frame->tr->dev, packets_of(band), a);
	return launch_dome_light(frame->tr->dev, from->n, a);
}

int dome_light_list(const struct band *band, const struct accel_space *space, const struct fragment_list *from,
                    const struct dome_area *area)
{
	const struct frame *frame = band->frame;
	const uint32_t all = rays_of(frame), most = all < RAYS_AT_ONCE ? all : RAYS_AT_ONCE;
	struct light_rays rays;
	int err = secondary_reserve_rays(frame, (size_t)most * from->n, NULL, &rays);

	rays.to_lights = 0;
	if (!err)
		err = reserve(frame, from->n);
	for (uint32_t i = 0; i < all && !err; i += most)
		err = look_from_list(band->pass, space, from, rays, i, all - i < most ? all - i : most);
	return err ? err : apply_sums(band, from, area);
}

int dome_suits_plain(const struct frame *frame)
{
	return !dome_is_there(frame) || (rays_of(frame) <= RAYS_AT_ONCE && !frame->scene->n_programs);
}

int dome_prepare_plain(const struct frame *frame, uint32_t n, struct dome_plain *out)
{
	struct tracer *tr = frame->tr;
	struct dome_buffers *b = tr->dome;
	const uint32_t samples = rays_of(frame);
	struct light_rays room;
	int err = reserve(frame, n);

	if (!err)
		err = launch_reserve(tr->dev, b->rays, (size_t)samples * n);
	if (!err)
		err = launch_reserve(tr->dev, b->factors, 3 * (size_t)n);
	if (!err)
		err = secondary_reserve_rays(frame, (size_t)samples * n, NULL, &room);
	if (!err)
		err = upload_directions(frame, 0, samples);
	*out = (struct dome_plain){ b->directions, b->factors, b->rays, b->places, samples };
	return err;
}

int dome_prepare_none(const struct frame *frame, struct dome_plain *out)
{
	struct device *dev = frame->tr->dev;
	struct dome_buffers *b = frame->tr->dome;
	int err;

	if ((err = launch_reserve(dev, b->directions, 1)) || (err = launch_reserve(dev, b->factors, 1)) ||
	    (err = launch_reserve(dev, b->rays, 1)) || (err = launch_reserve(dev, b->places, 1)))
		return err;
	*out = (struct dome_plain){ b->directions, b->factors, b->rays, b->places, 0 };
	return 0;
}

int dome_light_plain(const struct band *band, const struct accel_space *space, const struct plain_launch *a)
{
	const struct frame *frame = band->frame;
	const struct light_rays rays = { a->looks, a->visibility, a->samples * a->n, 0 };
	int err = look_around(frame, space, &rays, 1, a->samples, a->n);

	if (err)
		return err;
	return launch_dome_light_packet(
		frame->tr->dev, packets_of(band),
		LAUNCH(dome_light, .places = a->places, .sums = frame->tr->dome->sums, .pixels = a->pixels,
	               .first = a->pixels, .counts = a->layers.counts, .rectangle = a->rectangle, .width = frame->width,
	               .first_pixel = frame_first_pixel(band), .dome = a->dome, .in_blocks = 1, .blocks = a->blocks,
	               .n = a->n, .shaded = a->shaded, .factors = a->factors));
}
