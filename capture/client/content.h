/*
 * Runs inside the traced program. Contents that are drawn again and again are stored once: in a buffer object of the
 * recorder's own, which exists only in the trace.
 *
 * A content gets its buffer when it is seen for the second time, so vertices that change every frame need none, and
 * replaying a long recording does not fill the GL with buffers that are used once. Contents are identified by a 128-bit
 * hash, separately for each context, as contexts need not share objects.
 */
#pragma once

enum { CONTENT_MIN_BYTES = 256 }; /* less is not worth two calls */

/**
 * The buffer that holds these bytes in the trace. There must be a current context.
 * @param target  where the trace binds it to fill it: GL_ARRAY_BUFFER and the like
 * @param data    the recorder's own copy
 * @param bytes   at least CONTENT_MIN_BYTES
 * @param bound   set to 1 if the trace now has it bound to the target (it was just created), else unchanged
 * @return its name; 0: none, as the bytes are new
 */
unsigned content_buffer(unsigned target, const void *data, long bytes, int *bound);

/**
 * The same for bytes in the program's memory, read without faulting.
 * @param bytes  0: not known; then there is no buffer
 */
unsigned content_of_memory(unsigned target, const void *data, long bytes, int *bound);

/** Write a fake glBindBuffer. */
void content_bind(unsigned target, unsigned buffer);
/** Write a fake glGenBuffers; returns the name. */
unsigned content_new_buffer(void);
/** Write a fake glBufferData of the buffer that is bound; `data` may be NULL. */
void content_data(unsigned target, const void *data, long bytes);
