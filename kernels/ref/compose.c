/* C twins of kernels/frame/compose.cl and compose_packet.cl. */
#include "kernels/frame/compose.h"

KERNEL_TWIN(compose, n)

void compose_packet_c(const struct compose_arguments *a, size_t first, size_t last)
{
	compose_c(a, first * COMPOSE_PACKET, last * COMPOSE_PACKET);
}

KERNEL_TWIN(add_pass, n)
