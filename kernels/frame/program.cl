/*
 * program, program_packet: see kernels/gl/program.h. A packet's fragments are mostly neighbours on one surface: a triangle that several lie in is
 * set up once. Frames without programs do not compile this.
 */
#include "kernels/gl/program.h"

__kernel void program(KERNEL_ARGUMENTS(shade))
{
	const struct shade_arguments a = KERNEL_STRUCT(shade);
	struct setup_kept kept;

	if (get_global_id(0) < n)
		program_item(&a, (uint32_t)get_global_id(0), 0, &kept);
}

__kernel void program_packet(KERNEL_ARGUMENTS(shade))
{
	const uint32_t first = (uint32_t)get_global_id(0) * SHADE_PACKET;
	const struct shade_arguments a = KERNEL_STRUCT(shade);
	struct setup_kept kept;

	kept.instance = SCENE_NONE;
	for (uint32_t i = first; i < min(first + SHADE_PACKET, n); i++)
		program_item(&a, i, 1, &kept);
}
