/* C twins of kernels/frame/compose.cl and compose_packet.cl. */
#include "kernels/frame/compose.h"
#include "tracer/device/device.h"

extern device_twin compose_c, compose_packet_c, add_pass_c;

static uint32_t number(const void *arg)
{
	return *(const uint32_t *)arg;
}

void compose_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;

	for (size_t i = first; i < last && i < number(args[16]); i++)
		compose_item(&t, args[12], args[13], args[14], args[15], number(args[16]), (void *)args[17], (void *)args[18],
		             (uint32_t)i);
}

void compose_packet_c(const void *const *args, size_t first, size_t last)
{
	compose_c(args, first * COMPOSE_PACKET, last * COMPOSE_PACKET);
}

void add_pass_c(const void *const *args, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < number(args[3]); i++)
		add_pass_item(args[0], number(args[1]), number(args[2]), (void *)args[4], (uint32_t)i);
}
