/*
 * Trees cached on disk: returned to the byte, never the wrong one; the folder stays within its limit; failures are
 * reported once.
 */
#include "tests/check/random_scene.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xxhash.h>

#include "tests/case.h"
#include "tracer/accel/blas_store.h"
#include "tracer/accel/builders.h"

#define N 6000

static char folder[256];
static struct soup soup;

static const struct blas_store_key key = { { 1, 2 }, TREE_VERSION, ACCEL_BVH, N };

/* Triangles of several sizes, the same in each run. */
static void make_soup(void)
{
	static float positions[3 * N][4];
	static uint32_t index[3 * N];
	struct random_scene r = { .random = 7 };
	struct scene_mesh mesh = { .kind = SCENE_TRIANGLES,
		                   .vertex_count = 3 * N,
		                   .primitive_count = N,
		                   .position = positions[0],
		                   .index = index };

	for (uint32_t i = 0; i < N; i++) {
		const float at[3] = { between(&r, -9, 9), between(&r, -9, 9), between(&r, -2, 2) }, size = i % 9 ? 0.1f : 2;

		for (uint32_t k = 3 * i; k < 3 * i + 3; k++) {
			for (int a = 0; a < 3; a++)
				positions[k][a] = at[a] + between(&r, -size, size);
			positions[k][3] = 1;
			index[k] = k;
		}
	}
	ck_assert_int_eq(soup_make(&mesh, (const float (*)[4])positions, &soup), 0);
	ck_assert_uint_eq(soup.n, N);
}

/* Before each test, in its process. */
static void set_up(void)
{
	snprintf(folder, sizeof(folder), "%s/store.%d/trees", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp", (int)getpid());
	make_soup();
}

static struct blas_store *open_store(uint64_t most)
{
	struct blas_store *store;

	ck_assert_int_eq(blas_store_open(folder, most, &store), 0);
	return store;
}

static struct tree build(enum accel_kind kind)
{
	struct tree tree;

	ck_assert_int_eq(builders_make_tree(&soup, kind, (const uint64_t[]){ 1, 2 }, NULL, &tree), 0);
	return tree;
}

static int is_same(const struct tree *a, const struct tree *b)
{
	return a->n_nodes == b->n_nodes && a->n_order == b->n_order &&
	       memcmp(a->nodes, b->nodes, a->n_nodes * sizeof(*a->nodes)) == 0 &&
	       memcmp(a->order, b->order, a->n_order * sizeof(*a->order)) == 0;
}

/* Paths of the files in the folder; returns their number, and adds up their sizes. */
static unsigned list_files(char (*paths)[512], unsigned room, uint64_t *bytes)
{
	DIR *dir = opendir(folder);
	struct dirent *entry;
	unsigned n = 0;

	*bytes = 0;
	while (dir && (entry = readdir(dir))) {
		struct stat info;

		if (entry->d_name[0] == '.' || fstatat(dirfd(dir), entry->d_name, &info, 0))
			continue;
		*bytes += (uint64_t)info.st_size;
		if (n < room)
			snprintf(paths[n], sizeof(*paths), "%s/%s", folder, entry->d_name);
		n++;
	}
	if (dir)
		closedir(dir);
	return n;
}

START_TEST(a_tree_is_found_again)
{
	struct blas_store *store = open_store(BLAS_STORE_BYTES);
	struct tree got;

	for (int kind = 0; kind < N_ACCEL_KINDS; kind++) {
		struct tree tree = build((enum accel_kind)kind);
		struct blas_store_key k = key, other;

		k.kind = (uint32_t)kind;
		ck_assert_int_eq(blas_store_load(store, &k, &got), 0);
		ck_assert_ptr_null(got.nodes);
		blas_store_save(store, &k, &tree);
		ck_assert_int_eq(blas_store_load(store, &k, &got), 1);
		ck_assert(is_same(&tree, &got));
		tree_free(&got);
		for (int what = 0; what < 4; what++) {
			other = k;
			other.hash[0] += what == 0;
			other.hash[1] += what == 1;
			other.version += what == 2;
			other.n_triangles += what == 3;
			ck_assert_msg(blas_store_load(store, &other, &got) == 0, "found by another key (%d)", what);
		}
		tree_free(&tree);
	}
	blas_store_close(&store);
	soup_free(&soup);
}
END_TEST

START_TEST(large_meshes_alone_are_kept)
{
	struct blas_store *store = open_store(BLAS_STORE_BYTES);
	struct soup little = soup;
	struct tree tree, again;
	char paths[4][512];
	uint64_t bytes;

	ck_assert_int_eq(builders_make_tree(&soup, ACCEL_BVH, (const uint64_t[]){ 3, 4 }, store, &tree), 0);
	tree_free(&tree);
	little.n = 100;
	ck_assert_int_eq(builders_make_tree(&little, ACCEL_SBVH, (const uint64_t[]){ 3, 4 }, store, &tree), 0);
	tree_free(&tree);
	ck_assert_uint_eq(list_files(paths, 4, &bytes), 0);
	ck_assert_int_eq(builders_make_tree(&soup, ACCEL_SBVH, (const uint64_t[]){ 3, 4 }, store, &tree), 0);
	ck_assert_uint_eq(list_files(paths, 4, &bytes), 1);
	/* Keys are exact: the boxes of 6000 other triangles find none of their trees. */
	for (uint32_t i = 0; i < soup.n; i++)
		soup.boxes[i].lo[0] = soup.boxes[i].hi[0] = 0;
	ck_assert_int_eq(builders_make_tree(&soup, ACCEL_SBVH, (const uint64_t[]){ 3, 4 }, store, &again), 0);
	ck_assert(is_same(&tree, &again));
	tree_free(&tree);
	tree_free(&again);
	blas_store_close(&store);
	soup_free(&soup);
}
END_TEST

static void write_byte(const char *path, off_t at, uint8_t change)
{
	int fd = open(path, O_RDWR);
	uint8_t byte;

	ck_assert_int_eq(pread(fd, &byte, 1, at), 1);
	byte ^= change;
	ck_assert_int_eq(pwrite(fd, &byte, 1, at), 1);
	close(fd);
}

START_TEST(a_damaged_file_is_no_tree)
{
	struct random_scene r = { .random = 3 };
	struct tree tree = build(ACCEL_BVH), got;
	struct blas_store *store = open_store(BLAS_STORE_BYTES);
	char path[1][512];
	uint64_t bytes;

	blas_store_save(store, &key, &tree);
	ck_assert_uint_eq(list_files(path, 1, &bytes), 1);
	for (int i = 0; i < 500; i++) {
		const off_t at = i < 64 ? i : (off_t)between(&r, 64, (float)bytes - 1);
		const uint8_t change = (uint8_t)(1u << i % 8);

		write_byte(path[0], at, change);
		ck_assert_msg(blas_store_load(store, &key, &got) == 0, "a flipped bit %d of byte %ld goes unnoticed",
		              i % 8, (long)at);
		ck_assert_ptr_null(got.nodes);
		write_byte(path[0], at, change);
	}
	ck_assert_int_eq(blas_store_load(store, &key, &got), 1);
	tree_free(&got);
	for (uint64_t length = 0; length <= bytes + 1; length += length < 70 ? 1 : bytes / 9) {
		ck_assert_int_eq(truncate(path[0], (off_t)length), 0);
		ck_assert_msg(length == bytes || blas_store_load(store, &key, &got) == 0, "a file cut to %llu bytes",
		              (unsigned long long)length);
		blas_store_save(store, &key, &tree);
		ck_assert_int_eq(blas_store_load(store, &key, &got), 1);
		tree_free(&got);
	}
	tree_free(&tree);
	blas_store_close(&store);
	soup_free(&soup);
}
END_TEST

/* A tree with a valid checksum that would lead a kernel out of its arrays or its stack. */
START_TEST(an_unsound_tree_is_no_tree)
{
	struct blas_store *store = open_store(BLAS_STORE_BYTES);
	struct tree tree = build(ACCEL_BVH), got;

	ck_assert(tree_is_sound(&tree, N));
	for (int what = 0; what < 8; what++) {
		struct node2 node = tree.nodes[0];
		uint32_t item = tree.order[N - 1];

		switch (what) {
		case 0: tree.nodes[0].child[0] = tree.n_nodes; break;
		case 1: tree.nodes[0].child[1] = 0; break;
		case 2: tree.nodes[0].child[0] = N - 1; tree.nodes[0].count[0] = 2; break;
		case 3: tree.nodes[0].child[0] = 7; tree.nodes[0].count[0] = 0xfffffff0u; break;
		case 4: tree.order[N - 1] = N; break;
		case 5: tree.nodes[0].child[1] = tree.nodes[0].child[0]; break; /* one node is a child twice */
		case 6: tree.nodes[0].child[0] = 0; tree.nodes[0].count[0] = 9; break; /* leaf too large */
		case 7: tree.nodes[0].child[1] = 0; tree.nodes[0].count[1] = 1; break; /* unreachable nodes */
		}
		ck_assert_msg(!tree_is_sound(&tree, N), "case %d", what);
		blas_store_save(store, &key, &tree);
		ck_assert_msg(blas_store_load(store, &key, &got) == 0, "case %d", what);
		tree.nodes[0] = node;
		tree.order[N - 1] = item;
	}
	/* A chain of nodes with an item each; the last has two. */
	for (uint32_t n = BVH_MAX_DEPTH; n <= BVH_MAX_DEPTH + 1; n++) {
		for (uint32_t i = 0; i < n; i++) {
			tree.nodes[i].child[0] = i + 1 < n ? i + 1 : n;
			tree.nodes[i].count[0] = i + 1 == n;
			tree.nodes[i].child[1] = i;
			tree.nodes[i].count[1] = 1;
		}
		tree.n_nodes = n;
		tree.n_order = n + 1;
		ck_assert_msg(tree_is_sound(&tree, N) == (n <= BVH_MAX_DEPTH), "a path of %u nodes", n);
	}
	tree_free(&tree);
	blas_store_close(&store);
	soup_free(&soup);
}
END_TEST

START_TEST(unused_ones_go_first)
{
	struct tree tree = build(ACCEL_BVH), got;
	const uint64_t each = 64 + tree.n_nodes * sizeof(*tree.nodes) + tree.n_order * sizeof(*tree.order), most = 20 * each;
	struct blas_store *store = open_store(most);
	uint64_t bytes;

	for (uint32_t i = 0; i < 60; i++) {
		struct blas_store_key k = key;

		k.hash[0] = i;
		blas_store_save(store, &k, &tree);
		k.hash[0] = 3; /* used all the time */
		if (i >= 3) {
			ck_assert_msg(blas_store_load(store, &k, &got) == 1, "a tree just used is gone after %u", i);
			tree_free(&got);
		}
		list_files(NULL, 0, &bytes);
		ck_assert_uint_le(bytes, most + most / 16 + each);
		usleep(2000); /* file times have the resolution of the kernel's ticks */
	}
	ck_assert_uint_ge(bytes, most / 2);
	tree_free(&tree);
	blas_store_close(&store);
	soup_free(&soup);
}
END_TEST

/* Processes that write, read and remove the same few trees: any tree found must be complete and the right one. */
START_TEST(processes_share_a_folder)
{
	enum { PROCESSES = 4, KEYS = 6 };
	struct tree trees[KEYS];
	uint64_t bytes;
	pid_t children[PROCESSES];
	int found_some = 0;

	for (int i = 0; i < KEYS; i++) {
		trees[i] = build(ACCEL_BVH);
		trees[i].nodes[0].lo[0][0] -= (float)i; /* makes them distinct */
	}
	bytes = 64 + trees[0].n_nodes * sizeof(*trees[0].nodes) + trees[0].n_order * sizeof(*trees[0].order);
	for (uint32_t p = 0; p < PROCESSES; p++) {
		children[p] = fork();
		if (children[p] == 0) {
			struct random_scene r = { .random = 11 + p };
			struct blas_store *store;
			int wrong = blas_store_open(folder, 5 * bytes, &store) != 0, found = 0;

			for (int i = 0; i < 300 && !wrong; i++) {
				const uint32_t which = (uint32_t)between(&r, 0, KEYS - 0.01f);
				struct blas_store_key k = key;
				struct tree got;

				k.hash[1] = which;
				if (blas_store_load(store, &k, &got)) {
					found++;
					wrong = !is_same(&got, &trees[which]);
					tree_free(&got);
				} else {
					blas_store_save(store, &k, &trees[which]);
				}
			}
			blas_store_close(&store);
			_exit(wrong ? 1 : found ? 2 : 0);
		}
	}
	for (int p = 0; p < PROCESSES; p++) {
		int status;

		ck_assert_int_eq(waitpid(children[p], &status, 0), children[p]);
		ck_assert(WIFEXITED(status));
		ck_assert_int_ne(WEXITSTATUS(status), 1);
		found_some += WEXITSTATUS(status) == 2;
	}
	ck_assert_int_gt(found_some, 0);
	for (int i = 0; i < KEYS; i++)
		tree_free(&trees[i]);
	soup_free(&soup);
}
END_TEST

/* Number of lines on standard error while a folder cannot be written; no file may be left there. */
static unsigned count_lines(uint64_t most)
{
	struct tree tree = build(ACCEL_BVH);
	struct blas_store *store = open_store(most);
	int saved = dup(2), ends[2];
	char text[4096];
	unsigned lines = 0;
	ssize_t n;

	ck_assert_int_eq(pipe(ends), 0);
	dup2(ends[1], 2);
	for (int i = 0; i < 5; i++)
		blas_store_save(store, &key, &tree);
	dup2(saved, 2);
	close(ends[1]);
	while ((n = read(ends[0], text, sizeof(text))) > 0)
		for (ssize_t i = 0; i < n; i++)
			lines += text[i] == '\n';
	close(ends[0]);
	close(saved);
	tree_free(&tree);
	blas_store_close(&store);
	soup_free(&soup);
	return lines;
}

START_TEST(no_right_to_write_is_one_line)
{
	snprintf(folder, sizeof(folder), "/dev/null/trees");
	ck_assert_uint_eq(count_lines(BLAS_STORE_BYTES), 1);
}
END_TEST

START_TEST(a_full_disk_is_one_line)
{
	const struct rlimit limit = { 10000, 10000 };
	uint64_t bytes;

	signal(SIGXFSZ, SIG_IGN);
	ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &limit), 0);
	ck_assert_uint_eq(count_lines(BLAS_STORE_BYTES), 1);
	ck_assert_uint_eq(list_files(NULL, 0, &bytes), 0);
}
END_TEST

/* Checksums of the trees of a given mesh, by version. If this fails, builders have changed: raise TREE_VERSION and
 * enter the new sums. */
START_TEST(other_trees_are_another_version)
{
	static const uint64_t sums[N_ACCEL_KINDS] = { [ACCEL_BVH] = 0x1b93a3dbc07afc84u, [ACCEL_SBVH] = 0x8a222f99c945d872u,
		[ACCEL_KD] = 0xb283596433dc3bcbu, [ACCEL_LBVH] = 0x4349abbf97e11efeu };

	ck_assert_uint_eq(TREE_VERSION, 1);
	for (int kind = 0; kind < N_ACCEL_KINDS; kind++) {
		struct tree tree = build((enum accel_kind)kind);
		const uint64_t sum = XXH3_64bits(tree.nodes, tree.n_nodes * sizeof(*tree.nodes)) ^
		                     XXH3_64bits(tree.order, tree.n_order * sizeof(*tree.order));

		ck_assert_msg(sum == sums[kind], "kind %d: 0x%016llx", kind, (unsigned long long)sum);
		tree_free(&tree);
	}
	soup_free(&soup);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("store");

	tcase_set_timeout(tests, 60);
	tcase_add_checked_fixture(tests, set_up, NULL);
	tcase_add_test(tests, a_tree_is_found_again);
	tcase_add_test(tests, large_meshes_alone_are_kept);
	tcase_add_test(tests, a_damaged_file_is_no_tree);
	tcase_add_test(tests, an_unsound_tree_is_no_tree);
	tcase_add_test(tests, unused_ones_go_first);
	tcase_add_test(tests, processes_share_a_folder);
	tcase_add_test(tests, no_right_to_write_is_one_line);
	tcase_add_test(tests, a_full_disk_is_one_line);
	tcase_add_test(tests, other_trees_are_another_version);
	return run_case(tests, "store");
}
