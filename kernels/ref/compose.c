/* C twins of kernels/frame/compose.cl and compose_packet.cl. */
#include "kernels/frame/compose.h"

void compose_c(const struct compose_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		compose_item(a, (uint32_t)i);
}

void compose_packet_c(const struct compose_arguments *a, size_t first, size_t last)
{
	compose_c(a, first * COMPOSE_PACKET, last * COMPOSE_PACKET);
}

void add_pass_c(const struct add_pass_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		add_pass_item(a, (uint32_t)i);
}
