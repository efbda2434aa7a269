/*
 * Trees of meshes on disk. The first byte selects the file's form: odd, the input itself; even, its contents with a
 * correct key and checksum. An accepted tree is then converted to other kinds of nodes.
 */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/kept.h"
#include "tests/fuzz/target.h"
#include "tracer/accel/blas_store.h"
#include "tracer/accel/compress.h"
#include "tracer/accel/tree.h"

#define TRIANGLES 64

static const struct blas_store_key key = { { 1, 2 }, 3, 4, TRIANGLES };
static struct blas_store *store;
static char file[4096];
static uint64_t file_key[2];

/* The store writes a tree, which reveals its name and key. */
static void begin(void)
{
	struct node2 node = { .lo = { { 1 }, { 1 } } };
	uint32_t none = 0;
	struct tree empty = { &node, &none, 1, 0 };
	char folder[4096], head[24];
	struct dirent *entry;
	FILE *in = NULL;
	DIR *dir;

	snprintf(folder, sizeof(folder), "%s/trees", target_folder());
	if (blas_store_open(folder, BLAS_STORE_BYTES, &store))
		abort();
	blas_store_save(store, &key, &empty);
	dir = opendir(folder);
	while (dir && (entry = readdir(dir)))
		if (strstr(entry->d_name, ".tree") &&
		    snprintf(file, sizeof(file), "%s/%.255s", folder, entry->d_name) < (int)sizeof(file))
			in = fopen(file, "rb");
	if (!in || fread(head, 1, sizeof(head), in) != sizeof(head))
		abort();
	memcpy(file_key, head + 8, sizeof(file_key));
	fclose(in);
	closedir(dir);
}

static void walk(const struct tree *tree)
{
	const size_t room = BVH_COMPRESSED_NODES(tree->n_nodes, tree->n_order) + 1;
	struct triangle *from = calloc(tree->n_order + 1, sizeof(*from)), *to = calloc(tree->n_order + 1, sizeof(*to));
	struct node8c *small = calloc(room, sizeof(*small));
	struct node8 *wide = calloc(tree->n_nodes + 1, sizeof(*wide));
	uint32_t n;

	if (!from || !to || !small || !wide)
		abort();
	bvh_cost(tree->nodes, tree->n_nodes);
	bvh_collapse8(tree->nodes, tree->n_nodes, BVH_ITEMS, wide, &n, NULL, NULL, NULL);
	bvh_compress8(tree->nodes, tree->n_nodes, from, tree->n_order, small, &n, to);
	free(from);
	free(to);
	free(small);
	free(wide);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct tree tree;
	uint8_t how;
	FILE *out;

	if (!store)
		begin();
	if (!target_take(&data, &size, &how, 1))
		return 0;
	if (how % 2 == 0) {
		if (kept_write(file, file_key, data, size))
			abort();
	} else {
		out = fopen(file, "wb");
		if (!out || fwrite(data, 1, size, out) != size || fclose(out))
			abort();
	}
	if (blas_store_load(store, &key, &tree)) {
		walk(&tree);
		tree_free(&tree);
	}
	return 0;
}
