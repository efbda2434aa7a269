/*
 * Reads struct node8c (kernels/shared.h), box by box. Written in the common subset of C and OpenCL C: for the builder,
 * the C twins, and kernels that look at one child at a time. kernels/rays/compressed_node.h has separate code for eight
 * at once.
 */
#pragma once

#include "kernels/common.h"

static inline uint32_t node8c_byte(GLOBAL const uint32_t *words, uint32_t slot)
{
	return words[slot >> 2] >> 8 * (slot & 3u) & 255u;
}

/* Grid step along an axis: a power of two. */
static inline float node8c_step(uint32_t exponents, uint32_t axis)
{
	return M_FLOAT((exponents >> 8 * axis & 255u) << 23);
}

/* Coordinate of a grid plane. */
static inline float node8c_plane(float origin, float step, uint32_t byte)
{
	return M_FMA((float)byte, step, origin);
}

/* The box of the child in a slot. @return 0: the slot is empty */
static inline int node8c_box(GLOBAL const struct node8c *node, uint32_t slot, float lo[3], float hi[3])
{
	for (uint32_t a = 0; a < 3; a++) {
		const float step = node8c_step(node->exponents, a);

		lo[a] = node8c_plane(node->origin[a], step, node8c_byte(node->lo[a], slot));
		hi[a] = node8c_plane(node->origin[a], step, node8c_byte(node->hi[a], slot));
	}
	return (node->exponents >> (24 + slot) & 1u) || node8c_byte(node->meta, slot);
}

/*
 * The child in a slot.
 * @param first  receives its node index, or its first triangle
 * @return 0: a node; else its number of triangles
 */
static inline uint32_t node8c_child(GLOBAL const struct node8c *node, uint32_t slot, uint32_t *first)
{
	const uint32_t meta = node8c_byte(node->meta, slot);
	uint32_t before = node->exponents >> 24 & ((1u << slot) - 1u), n = 0;

	if (meta) {
		*first = node->triangle_first + (meta & 31u);
		return (meta >> 5 & 3u) + 1u;
	}
	for (; before; before &= before - 1u)
		n++;
	*first = node->child_first + n;
	return 0;
}
