/* C twins of kernels/frame/stages/vertex.cl, vertex_packet.cl and window.cl. */
#include "kernels/gl/vertex.h"

KERNEL_TWIN(vertex, n)
KERNEL_TWIN(window, n)

void vertex_packet_c(const struct vertex_arguments *a, size_t first, size_t last)
{
	vertex_c(a, first * VERTEX_PACKET, last * VERTEX_PACKET);
}
