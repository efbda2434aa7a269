/*
 * Runs inside the traced program. Reading the program's memory without ever faulting.
 *
 * An enabled vertex array may be stale or shorter than the draw says; the real GL may not even look at it. So client memory
 * is read through the kernel, which answers where a load would be a signal.
 */
#ifndef CAPTURE_GL_MEMORY_H
#define CAPTURE_GL_MEMORY_H

#include <stddef.h>

/**
 * Copy `bytes` from the program's memory; what cannot be read becomes zeros. Keeps errno.
 * @return bytes that could not be read
 */
size_t memory_read(void *to, const void *from, size_t bytes);

/** Bytes of a text before its NUL, or before what cannot be read. */
size_t memory_text_bytes(const char *text);

#endif
