/* C twins of kernels/frame/resolve.cl. */
#include "kernels/gl/stages.h"
#include "tracer/device/device.h"

extern device_twin clear_c, resolve_c, merge_samples_c;

static uint32_t number(const void *arg)
{
	return *(const uint32_t *)arg;
}

void clear_c(const void *const *args, size_t first, size_t last)
{
	struct camera_rectangle rectangle = *(const struct camera_rectangle *)args[1];
	struct frame_pixel *frame = (void *)args[5];

	for (size_t i = first; i < last && i < number(args[4]); i++)
		pixel_clear(args[0], &frame[stage_pixel(rectangle, number(args[2]), (uint32_t)i)], number(args[3]));
}

void resolve_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;
	struct camera_rectangle rectangle = *(const struct camera_rectangle *)args[16];

	for (size_t i = first; i < last && i < number(args[19]); i++)
		resolve_item(&t, args[12], (void *)args[13], args[14], args[15], number(args[18]), (void *)args[20],
		             stage_pixel(rectangle, number(args[17]), (uint32_t)i));
}

void merge_samples_c(const void *const *args, size_t first, size_t last)
{
	const struct frame_pixel *sample[4] = { args[0], args[1], args[2], args[3] };
	struct frame_pixel *frame = (void *)args[5];

	for (size_t i = first; i < last && i < number(args[4]); i++)
		pixel_merge(&sample[0][i], &sample[1][i], &sample[2][i], &sample[3][i], &frame[i]);
}
