/*
 * Runs inside the traced program. Mapped buffers: the recorder sees no stores, so it writes the memory as a copy
 * (apitrace's own memory function): the range of each flush, and the whole mapping when it ends.
 *
 * A program may write to a persistent mapping (ARB_buffer_storage) while draws read the buffer. Its content is written
 * when it begins. Before each command that may read it, it is compared with a copy and the differences are written. If
 * the kernel reports which pages were written (watch.h), only those are compared.
 */
#pragma once

/**
 * Part of a buffer was mapped; the call is already written. The mapping is followed until it ends if the program may
 * write to it while draws read it: persistent, without explicit flushes.
 * @param data    the result that the program gets; NULL: the call failed
 * @param access  as for glMapBufferRange
 */
void maps_begun(const void *data, long bytes, unsigned access);

/** Before a command that may read buffers: write what has changed in the mappings that are followed. */
void maps_read(void);

/** Before buffers are deleted, which ends their mappings. */
void maps_buffers_deleted(int n, const unsigned *names);
/** Before the buffer bound to `target` is unmapped. */
void maps_unmapped(unsigned target);
/** Before a part of it is flushed: bytes [offset, offset + length) of the mapping. */
void maps_flushed(unsigned target, long offset, long length);
