/*
 * Runs inside the traced program. Contents that were seen before: buffer objects of the recorder's own in the trace.
 */
#ifndef CAPTURE_WRITE_CONTENT_H
#define CAPTURE_WRITE_CONTENT_H

struct content_table; /* of one context; NULL is an empty one */

enum { CONTENT_MIN_BYTES = 256 }; /* less is not worth two calls */

/**
 * The buffer that holds these bytes in the trace.
 * @param table   the current context's; made at need
 * @param target  where it is bound in the trace while it is filled: GL_ARRAY_BUFFER and the like
 * @param data    the recorder's own copy
 * @param bytes   at least CONTENT_MIN_BYTES
 * @param bound   set to 1 where the trace now has it bound to the target (it has just been made), else left
 * @return its name, or 0 where there is none: the bytes are new
 */
unsigned content_buffer(struct content_table **table, unsigned target, const void *data, long bytes, int *bound);

/**
 * The same of bytes in the program's memory, which are read without faulting.
 * @param bytes  0 where it is not known how many; then there is no buffer
 */
unsigned content_of_memory(struct content_table **table, unsigned target, const void *data, long bytes, int *bound);

/** Write a fake glBindBuffer. */
void content_bind(unsigned target, unsigned buffer);
/** Write a fake glGenBuffers; returns the name. */
unsigned content_new_buffer(void);
/** Write a fake glBufferData of the buffer that is bound; `data` may be NULL. */
void content_data(unsigned target, const void *data, long bytes);

void content_free(struct content_table **table);

#endif
