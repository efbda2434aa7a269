/* Runs inside the traced program. Buffers that are mapped: what the program stores there becomes copies in the trace. */
#ifndef CAPTURE_GL_MAPS_H
#define CAPTURE_GL_MAPS_H

/**
 * A part of a buffer was mapped; the call is written. Where it may be written while draws read it (persistent, without explicit
 * flushes) it is followed until it ends.
 * @param data    what the program gets; NULL where it failed
 * @param access  as of glMapBufferRange
 */
void maps_begun(const void *data, long bytes, unsigned access);

/** Before a command that may read buffers: what has changed in the mappings that are followed is written. */
void maps_read(void);

/** Before buffers are deleted, which ends their mappings. */
void maps_buffers_deleted(int n, const unsigned *names);
/** @param context  context_contents() of it */
void maps_context_destroyed(const void *context);

/** Before the buffer bound to `target` is unmapped. */
void buffer_unmapped(unsigned target);
/** Before a part of it is flushed: bytes [offset, offset + length) of the mapping. */
void buffer_flushed(unsigned target, long offset, long length);

#endif
