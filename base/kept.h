/*
 * One file in a folder of things that could be made again: written whole (base/part.h), with a key and a checksum. A file that is
 * not there, cut, damaged, or of another key is as good as none.
 */
#ifndef BASE_KEPT_H
#define BASE_KEPT_H

#include <stddef.h>
#include <stdint.h>

/**
 * @param key    of all that the content depends on
 * @param bytes  receives the content, to be freed with free()
 * @return 1; 0: there is none that can be used
 */
int kept_read(const char *path, const uint64_t key[2], void **bytes, size_t *n);

/** Replaces what is there. The folder is made where it is missing. @return 0; the errno that says why not; -1 (reported) */
int kept_write(const char *path, const uint64_t key[2], const void *bytes, size_t n);

#endif
