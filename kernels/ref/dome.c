/* C twins of kernels/frame/dome/dome.cl and dome_packet.cl. */
#include "kernels/frame/dome/dome.h"

KERNEL_TWIN(dome_find, n)
KERNEL_TWIN(dome_sum, n)
KERNEL_TWIN(dome_light, n)

void dome_find_packet_c(const struct dome_find_arguments *a, size_t first, size_t last)
{
	dome_find_c(a, first * SHADE_PACKET, last * SHADE_PACKET);
}

/* Light the fragments of a pixel of the band. */
static void light_pixel(const struct dome_light_arguments *a, uint32_t x, uint32_t y)
{
	uint32_t count;
	const uint32_t begin = dome_items(a, x, y, &count);

	for (uint32_t i = begin; i < begin + count; i++)
		dome_light_at(a, i, x, y);
}

void dome_light_packet_c(const struct dome_light_arguments *a, size_t first, size_t last)
{
	const struct camera_rectangle r = a->rectangle;

	for (size_t tile = first; tile < last; tile++) {
		const uint32_t x0 = (uint32_t)tile % dome_columns(a->width) * DOME_WIDTH;
		const uint32_t y0 = (uint32_t)tile / dome_columns(a->width) * CAMERA_TILE;

		for (uint32_t y = dome_most(y0, (uint32_t)r.y0); y < y0 + CAMERA_TILE && y < (uint32_t)r.y1; y++)
			for (uint32_t x = dome_most(x0, (uint32_t)r.x0); x < x0 + DOME_WIDTH && x < (uint32_t)r.x1; x++)
				light_pixel(a, x, y);
	}
}
