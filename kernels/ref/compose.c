/* C twins of kernels/frame/stages/compose.cl and compose_packet.cl. */
#include "kernels/frame/stages/compose.h"

KERNEL_TWIN(compose, n)

void compose_packet_c(const struct compose_arguments *a, size_t first, size_t last)
{
	const struct compose_request *r = &a->request;
	const uint32_t columns = frame_columns(r->width);

	for (size_t i = first * COMPOSE_ROWS; i < last * COMPOSE_ROWS; i++) {
		const uint32_t item = (uint32_t)i / COMPOSE_ROWS, y = item / columns * COMPOSE_ROWS + (uint32_t)i % COMPOSE_ROWS;
		const uint32_t column = item % columns, x = column * FRAME_ROW,
			       end = x + FRAME_ROW < r->width ? x + FRAME_ROW : r->width;

		for (uint32_t k = y * r->width + x; y < r->height && k < y * r->width + end; k++)
			compose_one(a, a->drawn[y * columns + column] ? &a->frame[k] : a->cleared, k, compose_at(r, k));
	}
}

KERNEL_TWIN(add_pass, n)
