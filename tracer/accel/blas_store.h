/*
 * Trees of meshes on disk: a folder of files, one per tree, that any number of threads, processes and machines share.
 *
 * Files appear whole and carry a checksum (base/kept.h). A file that is cut, damaged, of another version or of another
 * byte order counts as none, and is written again. A file's time is that of its last use; where the folder exceeds its
 * bound, the files unused for longest go. Each process counts what it adds: several may exceed the bound by a sixteenth
 * each, for a while.
 *
 * Nothing here fails a run. Where the folder cannot be written (no right, no space), one warning says so and writing
 * stops.
 */
#pragma once

#include <stdint.h>

struct blas_store;
struct tree;

/* The content a tree is found by. */
struct blas_store_key {
	uint64_t hash[2]; /* of the mesh */
	uint32_t version; /* of the builders */
	uint32_t kind;    /* which builder */
	uint32_t n_triangles;
};

#define BLAS_STORE_BYTES (2ull << 30) /* what the folder may hold by default */

/**
 * @param folder  made at the first write; NULL: "trees" in the user's cache folder (base/folder.h)
 * @param most    bytes that the folder may hold
 * @param out     receives the store; close with blas_store_close; NULL where folder is NULL and the user has none
 * @return 0 or ERR_SYSTEM (reported): out of memory, or a name that is too long
 */
int blas_store_open(const char *folder, uint64_t most, struct blas_store **out);
void blas_store_close(struct blas_store **store);

/** Find a sound tree (tree_is_sound). @return 1: *out is it, free with tree_free; 0: there is none, *out is empty */
int blas_store_load(struct blas_store *store, const struct blas_store_key *key, struct tree *out);

/** Keep a tree. */
void blas_store_save(struct blas_store *store, const struct blas_store_key *key, const struct tree *tree);
