/*
 * Runs inside the traced program. Mapped buffers: the recorder sees no store, so what lies there goes out as a copy (apitrace's own
 * memory function): what a flush names, and all of a mapping that ends.
 *
 * A persistent mapping (ARB_buffer_storage) may be written while draws read the buffer. What it holds is written when it begins.
 * Before each command that may read it, it is compared with a copy, and what differs goes out. Where the kernel tells which pages
 * were written (watch.h), only those are compared.
 */
#pragma once

/**
 * A part of a buffer was mapped; the call is written. It is followed until it ends where it may be written while draws read
 * it: persistent, without explicit flushes.
 * @param data    what the program gets; NULL where it failed
 * @param access  as of glMapBufferRange
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
