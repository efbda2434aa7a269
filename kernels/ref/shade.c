/* C twins of kernels/frame/shade.cl and shade_packet.cl. */
#include "kernels/gl/stages.h"
#include "tracer/device/device.h"

extern device_twin gather_c, shade_c, shade_packet_c;

static uint32_t number(const void *arg)
{
	return *(const uint32_t *)arg;
}

void gather_c(const void *const *args, size_t first, size_t last)
{
	struct camera_rectangle rectangle = *(const struct camera_rectangle *)args[7];

	for (size_t i = first; i < last && i < number(args[9]); i++)
		gather_item(args[0], args[1], number(args[2]), args[3], (void *)args[4], (void *)args[5], (void *)args[6],
		            stage_pixel(rectangle, number(args[8]), (uint32_t)i));
}

void shade_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;
	struct stage_kept kept;

	for (size_t i = first; i < last && i < number(args[22]); i++)
		shade_item(&t, args[12], args[13], (void *)args[14], args[15], number(args[16]), number(args[17]), number(args[18]),
		           args[19], number(args[20]), number(args[21]), number(args[22]), (void *)args[23], (uint32_t)i, 0, &kept);
}

/* Each fragment on its own: what neighbours share must not show. */
void shade_packet_c(const void *const *args, size_t first, size_t last)
{
	shade_c(args, first * SHADE_PACKET, last * SHADE_PACKET);
}
