/*
 * Runs inside the traced program. Memory: the program's, read without ever faulting, and pages of our own.
 *
 * An enabled vertex array may be stale or shorter than the draw says, and the real GL may never look at it. So the
 * kernel reads client memory for us: it returns an error where a load would raise a signal.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/**
 * Copy `bytes` from the program's memory; what cannot be read becomes zeros. Keeps errno.
 * @return bytes that could not be read
 */
size_t pages_read(void *to, const void *from, size_t bytes);

/** Bytes of a text before its NUL, or before what cannot be read. */
size_t pages_text_bytes(const char *text);

/** Map zeroed pages; munmap frees them. malloc is not for us: the program may have replaced it. NULL: no memory. */
void *pages_map(size_t bytes);

/**
 * Make room for `bytes` at *pages and keep what is there.
 * @param pages   NULL: none yet
 * @param mapped  bytes mapped there, a multiple of 64 KiB
 * @return 1; 0: no memory, nothing changed
 */
int pages_grow(uint8_t **pages, size_t *mapped, size_t bytes);
