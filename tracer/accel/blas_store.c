#include "tracer/accel/blas_store.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/bytes.h"
#include "base/err.h"
#include "base/folder.h"
#include "base/folder_bound.h"
#include "base/hash.h"
#include "base/kept.h"
#include "base/part.h"
#include "tracer/accel/tree.h"

#define SUFFIX ".tree"
/* Recount the folder after writing 1 / COUNT_SHARE of its limit. If it exceeds the limit, shrink it to FULL_SHARE. */
#define COUNT_SHARE 16
#define FULL_SHARE(most) ((most) / 4 * 3)

/* Header of a file; nodes and order follow it. */
struct counts {
	uint32_t n_nodes, n_order;
};

struct blas_store {
	char folder[PATH_MAX - 96];
	uint64_t most, added; /* added: bytes written since the folder was last counted */
	int counted, lost;    /* lost: the folder cannot be written */
	pthread_mutex_t lock; /* guards writing and the members above */
};

int blas_store_open(const char *folder, uint64_t most, struct blas_store **out)
{
	struct blas_store *store = calloc(1, sizeof(*store));

	*out = NULL;
	if (!store)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (folder ? snprintf(store->folder, sizeof(store->folder), "%s", folder) >= (int)sizeof(store->folder)
	           : !folder_cached("trees", store->folder, sizeof(store->folder))) {
		free(store);
		return folder ? err_report(ERR_SYSTEM, folder, "the name is too long") : 0;
	}
	store->most = most;
	pthread_mutex_init(&store->lock, NULL);
	*out = store;
	return 0;
}

void blas_store_close(struct blas_store **store)
{
	if (*store)
		pthread_mutex_destroy(&(*store)->lock);
	free(*store);
	*store = NULL;
}

static void path_of(const struct blas_store *store, const struct blas_store_key *key, char path[PATH_MAX])
{
	snprintf(path, PATH_MAX, "%s/%016llx%016llx-%u-%u" SUFFIX, store->folder, (unsigned long long)key->hash[0],
	         (unsigned long long)key->hash[1], key->kind, key->version);
}

static size_t bytes_of(struct counts n)
{
	return sizeof(n) + n.n_nodes * sizeof(struct node2) + n.n_order * sizeof(uint32_t);
}

/* Hash everything that the content depends on, including the layout and byte order of nodes. */
static void hash_key(const struct blas_store_key *key, uint64_t out[2])
{
	const uint64_t all[] = { key->hash[0], key->hash[1], key->version, key->kind, key->n_triangles, sizeof(struct node2) };

	hash_bytes(all, sizeof(all), out);
}

/* --- Reading ----------------------------------------------------------------------------------------------------- */

/* Read a tree from a file's content. @return 0: not a valid tree */
static int unpack(const char *bytes, size_t n, uint32_t n_triangles, struct tree *out)
{
	struct counts counts;

	if (n < sizeof(counts))
		return 0;
	memcpy(&counts, bytes, sizeof(counts));
	if (n != bytes_of(counts))
		return 0;
	*out = (struct tree){ malloc(counts.n_nodes * sizeof(*out->nodes) + 1),
		              malloc(counts.n_order * sizeof(*out->order) + 1), counts.n_nodes, counts.n_order };
	if (!out->nodes || !out->order)
		return 0;
	bytes += sizeof(counts);
	memcpy(out->nodes, bytes, counts.n_nodes * sizeof(*out->nodes));
	memcpy(out->order, bytes + counts.n_nodes * sizeof(*out->nodes), counts.n_order * sizeof(*out->order));
	return tree_is_sound(out, n_triangles);
}

int blas_store_load(struct blas_store *store, const struct blas_store_key *key, struct tree *out)
{
	char path[PATH_MAX];
	uint64_t hash[2];
	void *bytes;
	size_t n;
	int found;

	path_of(store, key, path);
	hash_key(key, hash);
	*out = (struct tree){ NULL };
	if (!kept_read(path, hash, &bytes, &n))
		return 0;
	found = unpack(bytes, n, key->n_triangles, out);
	free(bytes);
	if (found)
		/* record the time of last use; without permission to set it, we cannot remove files either */
		utimensat(AT_FDCWD, path, NULL, 0);
	else
		tree_free(out);
	return found;
}

/* --- Keeping the bound ------------------------------------------------------------------------------------------- */

/* Count the folder. If it exceeds its limit, remove the least recently used trees. */
static void keep_bound(struct blas_store *store)
{
	if (!folder_keep_bound(store->folder, "?*" SUFFIX, store->most, FULL_SHARE(store->most)))
		return;
	store->added = 0;
	store->counted = 1;
}

/* --- Writing ----------------------------------------------------------------------------------------------------- */

/* @return 0, the errno of a failed write, or -1 (reported) */
static int save(struct blas_store *store, const char *path, const struct blas_store_key *key, const struct tree *tree)
{
	const struct counts counts = { tree->n_nodes, tree->n_order };
	char *bytes = malloc(bytes_of(counts));
	uint64_t hash[2];
	int failed;

	if (!bytes)
		return ENOMEM;
	memcpy(bytes, &counts, sizeof(counts));
	memcpy(bytes + sizeof(counts), tree->nodes, tree->n_nodes * sizeof(*tree->nodes));
	memcpy(bytes + sizeof(counts) + tree->n_nodes * sizeof(*tree->nodes), tree->order,
	       tree->n_order * sizeof(*tree->order));
	if (!store->counted) {
		part_sweep(path);
		keep_bound(store);
	}
	hash_key(key, hash);
	failed = kept_write(path, hash, bytes, bytes_of(counts));
	free(bytes);
	return failed;
}

void blas_store_save(struct blas_store *store, const struct blas_store_key *key, const struct tree *tree)
{
	const uint64_t bytes = bytes_of((struct counts){ tree->n_nodes, tree->n_order });
	char path[PATH_MAX];
	int failed;

	if (bytes > store->most / 4)
		return; /* would displace too many others */
	path_of(store, key, path);
	pthread_mutex_lock(&store->lock);
	if (!store->lost) {
		failed = save(store, path, key, tree);
		if (failed > 0)
			err_warn(store->folder, "trees of meshes are not kept there: %s", strerror(failed));
		store->lost = failed != 0;
		store->added += bytes;
		if (!failed && store->added > store->most / COUNT_SHARE)
			keep_bound(store);
	}
	pthread_mutex_unlock(&store->lock);
}
