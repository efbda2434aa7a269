/*
 * Runs inside the traced program. Arrays in client memory have a buffer object in the trace that holds the same bytes.
 *
 * Each array, identified by its address, has a buffer that exists only in the trace, and a copy in memory of the
 * buffer's content. Before a draw, the elements that it uses are compared with the copy, and only the part that differs
 * is written (glBufferSubData). So the comparison is exact and costs one pass over the elements used, and an array of
 * twenty draws is stored once. Contents that return to an address after others were there have buffers of their own
 * (content.h).
 */
#pragma once

/** The vertices that a row of indices uses, kept with the mirror of the row. */
struct mirror_indices {
	long bytes, restart; /* the indices that the range is for; bytes 0: none kept */
	unsigned type;
	long lowest, highest;
};

/**
 * The buffer that holds what an array holds now. There must be a current context.
 * @param target  GL_ARRAY_BUFFER or GL_ELEMENT_ARRAY_BUFFER: where it is bound in the trace while it is written
 * @param data    the array's start in the program; read without faulting
 * @param first, end  bytes of it that are drawn from; the buffer holds these at the same place
 * @param bound   set to 1 if the trace now has it bound to the target, else unchanged
 * @param indices NULL, or set to a slot that is kept with these bytes until they change; NULL if there is none
 * @return its name; 0: none
 */
unsigned mirror_buffer(unsigned target, const void *data, long first, long end, int *bound,
                       struct mirror_indices **indices);
