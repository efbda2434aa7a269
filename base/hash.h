/* Hashes of bytes and files: to name them, and to see whether they have changed. */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <xxhash.h>

/** The XXH3-128 of bytes: their name in a store that keeps each content once. */
void hash_bytes(const void *data, size_t n, uint64_t out[2]);

/** The text of a hash: 32 hexadecimal digits, the high half first. */
void hash_text(const uint64_t hash[2], char out[33]);

/**
 * Name of a trace: XXH3-128 over its first MiB and its size.
 * @param out  receives 32 hex digits
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported)
 */
int hash_name(const char *path, uint64_t size, char out[33]);

/**
 * Hash a file from its beginning, in small pieces.
 * @param limit  bytes at most
 * @param state  XXH3-128, initialised by the caller, who may add more
 * @return 0 or ERR_INPUT (reported)
 */
int hash_file(const char *path, uint64_t limit, XXH3_state_t *state);

/** The XXH3-128 of a whole file. @return 0, ERR_INPUT or ERR_SYSTEM (reported) */
int hash_whole(const char *path, uint64_t out[2]);
