/* Blobs of an index: Snappy-packed if that saves space, otherwise stored as they are. */
#pragma once

#include <stddef.h>

/** Size of the buffer that pack_blob needs for n bytes. */
size_t pack_room(size_t n);

/**
 * Pack bytes, unless a sample shows that this would save little: photographs would take most of the time to build an
 * index, and shrink by only a tenth.
 * @param out     pack_room(n) bytes
 * @param packed  receives the number of bytes written: n if stored unpacked, else fewer
 * @return 0 or ERR_SYSTEM
 */
int pack_blob(const char *data, size_t n, char *out, size_t *packed);

/**
 * Unpack what pack_blob wrote.
 * @param n  original size
 * @return the bytes: `packed` itself if stored unpacked, else memory to be freed with free(); NULL: damaged, or out of
 *         memory
 */
char *unpack_blob(char *packed, size_t n_packed, size_t n);
