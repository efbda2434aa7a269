/* Blobs of an index: Snappy-packed if that saves space, otherwise stored as they are. */
#pragma once

#include <stddef.h>

/** Size of the buffer for packing n bytes. */
size_t pack_room(size_t n);

/**
 * Pack bytes, unless a sample shows that it would save little. Photographs would take most of an index's time, and save
 * a tenth of their size.
 * @param out     pack_room(n) bytes
 * @param packed  receives the number of bytes written: n if stored unpacked, else fewer
 * @return 0 or ERR_SYSTEM
 */
int pack_blob(const char *data, size_t n, char *out, size_t *packed);

/**
 * @param n  original size
 * @return the bytes: `packed` itself if stored unpacked, else memory to be freed with free(); NULL: damaged, or out of
 *         memory
 */
char *unpack_blob(char *packed, size_t n_packed, size_t n);
