/*
 * Mesh trees on disk: a folder with one file per tree. Any number of threads, processes and machines may share it.
 *
 * Files appear whole and carry a checksum (base/kept.h). A file that is truncated, damaged, or from another version or
 * byte order is treated as missing and is rewritten. The modification time of a file records its last use. When the
 * folder exceeds its limit, the least recently used files are removed. Each process counts only what it adds itself, so
 * each may exceed the limit by a sixteenth for a while.
 *
 * No failure here fails a run. If the folder cannot be written (no permission, no space), one warning is printed and
 * writing stops.
 */
#pragma once

#include <stdint.h>

struct blas_store;
struct tree;

/* The key of a tree: its content. */
struct blas_store_key {
	uint64_t hash[2]; /* hash of the mesh */
	uint32_t version; /* TREE_VERSION of the builders */
	uint32_t kind;    /* enum accel_kind */
	uint32_t n_triangles;
};

#define BLAS_STORE_BYTES (2ull << 30) /* default size limit of the folder */

/**
 * @param folder  created by the first write; NULL: "trees" in the user's cache folder (base/folder.h)
 * @param most    size limit of the folder in bytes
 * @param out     receives the store; close with blas_store_close; NULL if folder is NULL and the user has no cache
 *                folder
 * @return 0 or ERR_SYSTEM (reported): out of memory, or a name that is too long
 */
int blas_store_open(const char *folder, uint64_t most, struct blas_store **out);
void blas_store_close(struct blas_store **store);

/** Find a sound tree (tree_is_sound). @return 1: found, free *out with tree_free; 0: not found, *out is empty */
int blas_store_load(struct blas_store *store, const struct blas_store_key *key, struct tree *out);

/** Store a tree. */
void blas_store_save(struct blas_store *store, const struct blas_store_key *key, const struct tree *tree);
