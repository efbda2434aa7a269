/* C twins of kernels/frame/compose.cl and compose_packet.cl. */
#include "kernels/frame/compose.h"

KERNEL_TWIN(compose, n)

void compose_packet_c(const struct compose_arguments *a, size_t first, size_t last)
{
	const uint32_t columns = compose_columns(a->request.width);

	for (size_t i = first; i < last; i++) {
		const size_t row = i / columns * a->request.width, x = i % columns * COMPOSE_PACKET;
		const size_t end = x + COMPOSE_PACKET < a->request.width ? x + COMPOSE_PACKET : a->request.width;

		compose_c(a, row + x, row + end);
	}
}

KERNEL_TWIN(add_pass, n)
