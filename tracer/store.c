#include "tracer/store.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/part.h"
#include "tracer/tree.h"

#define SUFFIX ".tree"
/* How much more is written before the folder is counted again, and how full it is afterwards, as shares of its bound. */
#define COUNT_SHARE 16
#define FULL_SHARE(most) ((most) / 4 * 3)

static const char magic[8] = "relume\001\n"; /* its end shows files that were sent as text */

/* A file: this, nodes, order. In this machine's byte order, which `version` gives away. */
struct header {
	char magic[8];
	struct store_key key;
	uint32_t n_nodes, n_order, node_bytes;
	uint64_t checksum; /* XXH3 over all but itself */
};
_Static_assert(sizeof(struct store_key) == 32 && sizeof(struct header) == 64, "no padding is written but zeros");

struct store {
	char folder[PATH_MAX - 96];
	uint64_t most, added; /* added: bytes since the folder was counted last */
	int counted, lost;    /* lost: nothing can be written */
	pthread_mutex_t lock; /* of what is written, and of the fields above */
};

int store_open(const char *folder, uint64_t most, struct store **out)
{
	struct store *store = calloc(1, sizeof(*store));

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

void store_close(struct store **store)
{
	if (*store)
		pthread_mutex_destroy(&(*store)->lock);
	free(*store);
	*store = NULL;
}

static void path_of(const struct store *store, const struct store_key *key, char path[PATH_MAX])
{
	snprintf(path, PATH_MAX, "%s/%016llx%016llx-%u-%u" SUFFIX, store->folder, (unsigned long long)key->hash[0],
	         (unsigned long long)key->hash[1], key->kind, key->version);
}

static struct header header_of(const struct store_key *key, const struct tree *tree)
{
	struct header h;

	memset(&h, 0, sizeof(h));
	memcpy(h.magic, magic, sizeof(magic));
	memcpy(h.key.hash, key->hash, sizeof(h.key.hash));
	h.key.version = key->version;
	h.key.kind = key->kind;
	h.key.n_triangles = key->n_triangles;
	h.n_nodes = tree->n_nodes;
	h.n_order = tree->n_order;
	h.node_bytes = sizeof(struct node2);
	return h;
}

/* Of a header whose checksum is 0, and what follows it. */
static uint64_t checksum_of(const struct header *h, const struct tree *tree)
{
	uint64_t sum = XXH3_64bits(h, sizeof(*h));

	sum = XXH3_64bits_withSeed(tree->nodes, tree->n_nodes * sizeof(*tree->nodes), sum);
	return XXH3_64bits_withSeed(tree->order, tree->n_order * sizeof(*tree->order), sum);
}

/* --- Reading ------------------------------------------------------------------------------------------------------- */

static int read_all(int fd, void *out, size_t bytes)
{
	while (bytes) {
		ssize_t n = read(fd, out, bytes);

		if (n <= 0)
			return 0;
		out = (char *)out + n;
		bytes -= (size_t)n;
	}
	return 1;
}

/* A file's content, checked. @return 0: not one that can be used */
static int read_tree(int fd, const struct store_key *key, struct tree *out)
{
	struct header h, want;
	struct stat info;

	if (fstat(fd, &info) || !read_all(fd, &h, sizeof(h)))
		return 0;
	out->n_nodes = h.n_nodes;
	out->n_order = h.n_order;
	want = header_of(key, out);
	want.checksum = h.checksum;
	if (memcmp(&h, &want, sizeof(h)) != 0 ||
	    (uint64_t)info.st_size != sizeof(h) + (uint64_t)h.n_nodes * sizeof(*out->nodes) + (uint64_t)h.n_order * sizeof(*out->order))
		return 0;
	out->nodes = malloc(h.n_nodes * sizeof(*out->nodes) + 1);
	out->order = malloc(h.n_order * sizeof(*out->order) + 1);
	if (!out->nodes || !out->order || !read_all(fd, out->nodes, h.n_nodes * sizeof(*out->nodes)) ||
	    !read_all(fd, out->order, h.n_order * sizeof(*out->order)))
		return 0;
	h.checksum = 0;
	return checksum_of(&h, out) == want.checksum && tree_is_sound(out, key->n_triangles);
}

int store_load(struct store *store, const struct store_key *key, struct tree *out)
{
	char path[PATH_MAX];
	int fd, found;

	path_of(store, key, path);
	*out = (struct tree){ NULL };
	fd = open(path, O_RDONLY | O_CLOEXEC);
	if (fd < 0)
		return 0;
	found = read_tree(fd, key, out);
	if (found)
		utimensat(AT_FDCWD, path, NULL, 0); /* used just now; where that is not allowed, nothing is removed either */
	else
		tree_free(out);
	close(fd);
	return found;
}

/* --- Keeping the bound --------------------------------------------------------------------------------------------- */

struct kept {
	struct timespec used;
	uint64_t bytes;
	char name[96];
};

static int compare_kept(const void *a, const void *b)
{
	const struct kept *x = a, *y = b;

	if (x->used.tv_sec != y->used.tv_sec)
		return x->used.tv_sec < y->used.tv_sec ? -1 : 1;
	return (x->used.tv_nsec > y->used.tv_nsec) - (x->used.tv_nsec < y->used.tv_nsec);
}

static int is_tree(const char *name)
{
	const size_t n = strlen(name), end = strlen(SUFFIX);

	return n > end && n < sizeof(((struct kept *)0)->name) && strcmp(name + n - end, SUFFIX) == 0;
}

/* The files of the folder. @return how many, in an array of the caller's; 0 also where memory is short */
static size_t list_kept(DIR *dir, struct kept **out)
{
	size_t n = 0, room = 0;
	struct dirent *entry;

	*out = NULL;
	while ((entry = readdir(dir))) {
		struct stat info;

		if (!is_tree(entry->d_name) || fstatat(dirfd(dir), entry->d_name, &info, AT_SYMLINK_NOFOLLOW) || !S_ISREG(info.st_mode))
			continue;
		if (n == room) {
			struct kept *grown = realloc(*out, (room = 2 * room + 64) * sizeof(*grown));

			if (!grown)
				return 0;
			*out = grown;
		}
		(*out)[n].used = info.st_mtim;
		(*out)[n].bytes = (uint64_t)info.st_size;
		memcpy((*out)[n++].name, entry->d_name, strlen(entry->d_name) + 1);
	}
	return n;
}

/* Count the folder, and remove what was unused for longest where it holds more than it may. Others may do the same. */
static void keep_bound(struct store *store)
{
	DIR *dir = opendir(store->folder);
	uint64_t bytes = 0;
	struct kept *kept;
	size_t n;

	if (!dir)
		return;
	n = list_kept(dir, &kept);
	for (size_t i = 0; i < n; i++)
		bytes += kept[i].bytes;
	if (bytes > store->most) {
		qsort(kept, n, sizeof(*kept), compare_kept);
		for (size_t i = 0; i < n && bytes > FULL_SHARE(store->most); i++) {
			unlinkat(dirfd(dir), kept[i].name, 0);
			bytes -= kept[i].bytes;
		}
	}
	store->added = 0;
	store->counted = 1;
	free(kept);
	closedir(dir);
}

/* --- Writing ------------------------------------------------------------------------------------------------------- */

/* @return 0, or the errno of what failed */
static int write_parts(int fd, struct iovec *parts, int n)
{
	while (n) {
		ssize_t done = writev(fd, parts, n);

		if (done < 0 && errno == EINTR)
			continue;
		if (done < 0)
			return errno;
		for (; n && (size_t)done >= parts->iov_len; parts++, n--)
			done -= (ssize_t)parts->iov_len;
		if (n) {
			parts->iov_base = (char *)parts->iov_base + done;
			parts->iov_len -= (size_t)done;
		}
	}
	return 0;
}

static int write_file(const char *part, const struct store_key *key, const struct tree *tree)
{
	struct header h = header_of(key, tree);
	struct iovec parts[] = { { &h, sizeof(h) }, { tree->nodes, tree->n_nodes * sizeof(*tree->nodes) },
		                 { tree->order, tree->n_order * sizeof(*tree->order) } };
	int fd = open(part, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666), failed;

	if (fd < 0)
		return errno;
	h.checksum = checksum_of(&h, tree);
	failed = write_parts(fd, parts, 3);
	if (close(fd) && !failed)
		failed = errno;
	return failed;
}

static void save(struct store *store, const char *path, const struct store_key *key, const struct tree *tree)
{
	char part[PATH_MAX + 128];
	int failed = folder_try(store->folder);

	if (!failed && !store->counted) {
		part_sweep(path);
		keep_bound(store);
	}
	if (!failed) {
		if (part_begin(path, part, sizeof(part))) {
			store->lost = 1;
			return;
		}
		failed = write_file(part, key, tree);
		if (failed)
			part_drop(part);
		else
			store->lost = part_finish(part, path) != 0;
	}
	if (failed) {
		err_warn(store->folder, "trees of meshes are not kept there: %s", strerror(failed));
		store->lost = 1;
	}
}

void store_save(struct store *store, const struct store_key *key, const struct tree *tree)
{
	const uint64_t bytes = sizeof(struct header) + (uint64_t)tree->n_nodes * sizeof(*tree->nodes) +
	                       (uint64_t)tree->n_order * sizeof(*tree->order);
	char path[PATH_MAX];

	if (bytes > store->most / 4)
		return; /* many others would go for it */
	path_of(store, key, path);
	pthread_mutex_lock(&store->lock);
	if (!store->lost) {
		save(store, path, key, tree);
		store->added += bytes;
		if (!store->lost && store->added > store->most / COUNT_SHARE)
			keep_bound(store);
	}
	pthread_mutex_unlock(&store->lock);
}
