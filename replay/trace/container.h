/* The bytes in a trace's container: Snappy chunks, gzip or Brotli, delivered piece by piece. */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct container;

/** @return 0, ERR_INPUT (reported: missing, not a file, empty, of a recognized other kind) or ERR_SYSTEM (reported) */
int container_open(struct container **out, const char *path);
void container_close(struct container **c);

/**
 * The next piece of the unpacked stream.
 * @param data, size  receive it; valid until the next call. At least 1 byte
 * @return 1; 0 at the end; ERR_INPUT (reported) if the container is damaged; ERR_SYSTEM
 */
int container_next(struct container *c, const uint8_t **data, size_t *size);

/** Offset in the file of the last piece delivered; UINT64_MAX: reading cannot start there (gzip, Brotli). */
uint64_t container_piece(const struct container *c);

/**
 * Continue from such an offset, or, if 0, from the beginning.
 * @return 0 or ERR_SYSTEM (reported)
 */
int container_seek(struct container *c, uint64_t offset);

/** 1: the file ends within a chunk or stream. All that could be unpacked of it was delivered. */
int container_is_cut(const struct container *c);

/** Number of bytes in the file after the end of the trace, once it has been reached: another trace follows. 0: none */
uint64_t container_behind(const struct container *c);

/**
 * Hash the file as hash_whole does. Snappy chunks that are read in order from now on are hashed while they are read;
 * hash_end reads the rest of the file, or all of it after a seek or for another kind of container. After hash_end
 * nothing more is delivered.
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported)
 */
int container_hash_begin(struct container *c);
int container_hash_end(struct container *c, uint64_t out[2]);

uint64_t container_offset(const struct container *c); /* bytes of the file used so far */
uint64_t container_size(const struct container *c);   /* size of the file */
