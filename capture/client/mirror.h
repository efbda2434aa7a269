/*
 * Runs inside the traced program. Arrays in client memory have a buffer object in the trace that holds the same bytes.
 *
 * Each array (known by its address) has a buffer that only the trace has, and a copy in memory of what that buffer holds. Before
 * a draw, the elements that it uses are compared with the copy. Where they are the same nothing is written, else the part that
 * differs is (glBufferSubData). So equality is exact, costs one pass over the elements used, and an array of twenty draws is
 * stored once. Contents that come back at an address after others have buffers of their own (content.h).
 */
#pragma once

/** The vertices that a row of indices uses, kept with the mirror of the row. */
struct mirror_indices {
	long bytes, restart; /* what it was found for; bytes 0: nothing is kept */
	unsigned type;
	long lowest, highest;
};

/**
 * The buffer that holds what an array holds now. There must be a current context.
 * @param target  GL_ARRAY_BUFFER or GL_ELEMENT_ARRAY_BUFFER: where it is bound in the trace while it is written
 * @param data    the array's start in the program; read without faulting
 * @param first, end  bytes of it that are drawn from; the buffer holds these at the same place
 * @param bound   set to 1 where the trace now has it bound to the target, else left
 * @param indices NULL, or set to a place that goes with these bytes as long as they stay the same; NULL where there is none
 * @return its name, or 0 where there is none
 */
unsigned mirror_buffer(unsigned target, const void *data, long first, long end, int *bound, struct mirror_indices **indices);
