/*
 * One file of a cache folder, written atomically (base/part.h) with a key and a checksum. A file that is missing,
 * truncated, damaged or has another key counts as absent.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/**
 * @param key    hash of everything that the content depends on
 * @param bytes  receives the content; release with free()
 * @return 1; 0: absent
 */
int kept_read(const char *path, const uint64_t key[2], void **bytes, size_t *n);

/** Replace the file; make its folder if missing. @return 0; the errno; or -1 (reported) */
int kept_write(const char *path, const uint64_t key[2], const void *bytes, size_t n);
