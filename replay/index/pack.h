/*
 * Blobs of an index: Snappy-packed where that saves something, else as they are.
 */
#pragma once

#include <stddef.h>

/** Room that packing n bytes needs. */
size_t pack_room(size_t n);

/**
 * Pack bytes, unless a sample of them says that it saves little. Photographs would take most of an index's time, for a
 * tenth of their bytes.
 * @param out     pack_room(n) bytes
 * @param packed  receives how many were written: n where they are as they were, else fewer
 * @return 0 or ERR_SYSTEM
 */
int pack_blob(const char *data, size_t n, char *out, size_t *packed);

/**
 * @param n  bytes there were
 * @return the bytes: `packed` itself where they were not packed, else memory to be freed with free(); NULL: there are
 *         not n of them, or out of memory
 */
char *unpack_blob(char *packed, size_t n_packed, size_t n);
