/*
 * Bottom-level trees shared by workers: each is built once; trees in use are kept; after a failure another worker
 * builds.
 */
#include "tests/check/random_scene.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

#include "tests/case.h"
#include "tracer/accel/blas_cache.h"

#define THREADS 4
#define KEYS 50
#define ROUNDS 400

static struct blas_cache *cache;
static atomic_uint n_made[KEYS];

static struct blas_key key_of(uint32_t i)
{
	return (struct blas_key){ { i, 7 }, i % N_ACCEL_KINDS, ACCEL_ROWS };
}

/* A tree of about `bytes` bytes whose nodes all contain its number. */
static struct blas make(uint32_t number, size_t bytes)
{
	struct blas b = { .n = { [BLAS_NODES2] = bytes / sizeof(struct node2) } };
	struct node2 *nodes = calloc(b.n[BLAS_NODES2] + 1, sizeof(*nodes));

	for (size_t i = 0; i < b.n[BLAS_NODES2]; i++)
		nodes[i].child[0] = number;
	b.parts[BLAS_NODES2] = nodes;
	return b;
}

static int is_of(const struct blas *b, uint32_t number)
{
	const struct node2 *nodes = b->parts[BLAS_NODES2];

	for (size_t i = 0; i < b->n[BLAS_NODES2]; i++)
		if (nodes[i].child[0] != number)
			return 0;
	return 1;
}

/* Acquire and release it. @return 1: it was cached; 0: it was built */
static int take(uint32_t number, size_t bytes)
{
	const struct blas_key key = key_of(number);
	const struct blas *got;
	int found;

	ck_assert_int_eq(blas_cache_acquire(cache, &key, &got), 0);
	found = got != NULL;
	if (!found) {
		struct blas b = make(number, bytes);

		n_made[number % KEYS]++;
		got = blas_cache_publish(cache, &key, &b);
		ck_assert_ptr_null(b.parts[BLAS_NODES2]);
	}
	ck_assert(is_of(got, number));
	blas_cache_release(cache, got);
	return found;
}

static void *take_all(void *arg)
{
	uint64_t random = *(uint32_t *)arg;

	for (int i = 0; i < ROUNDS; i++) {
		random = random * 6364136223846793005u + 1442695040888963407u;
		take((uint32_t)(random >> 40) % KEYS, 6400);
	}
	return NULL;
}

static void run_threads(void *(*work)(void *))
{
	pthread_t threads[THREADS];
	uint32_t numbers[THREADS];

	for (uint32_t i = 0; i < THREADS; i++) {
		numbers[i] = i;
		ck_assert_int_eq(pthread_create(&threads[i], NULL, work, &numbers[i]), 0);
	}
	for (int i = 0; i < THREADS; i++)
		pthread_join(threads[i], NULL);
}

START_TEST(each_is_made_once)
{
	ck_assert_int_eq(blas_cache_create(1 << 20, &cache), 0);
	run_threads(take_all);
	for (int i = 0; i < KEYS; i++)
		ck_assert_uint_eq(n_made[i], 1);
	blas_cache_destroy(&cache);
	ck_assert_ptr_null(cache);
}
END_TEST

START_TEST(little_room_makes_some_again)
{
	ck_assert_int_eq(blas_cache_create(6400 * KEYS / 4, &cache), 0);
	run_threads(take_all);
	for (int i = 0; i < KEYS; i++)
		ck_assert_uint_ge(n_made[i], 1);
	blas_cache_destroy(&cache);
}
END_TEST

START_TEST(unused_for_longest_goes_first)
{
	const struct blas_key key = key_of(1);
	const struct blas *held;

	ck_assert_int_eq(blas_cache_create(3 * 6400, &cache), 0);
	for (uint32_t i = 0; i < 3; i++)
		ck_assert_int_eq(take(i, 6400), 0);
	ck_assert_int_eq(take(0, 6400), 1);
	ck_assert_int_eq(blas_cache_acquire(cache, &key, &held), 0);
	ck_assert_int_eq(take(3, 6400), 0); /* evicts 2 */
	ck_assert_int_eq(take(0, 6400), 1);
	ck_assert_int_eq(take(2, 6400), 0); /* 1 is in use: evicts 3 */
	ck_assert_int_eq(take(3, 1 << 20), 0); /* larger than the cache: evicts everything but the tree in use */
	ck_assert_int_eq(take(0, 6400), 0);
	ck_assert(is_of(held, 1));
	ck_assert_int_eq(take(1, 6400), 1);
	blas_cache_release(cache, held);
	/* Another kind, or other parts, is a different tree. */
	for (int i = 0; i < 2; i++) {
		struct blas_key other = key;
		const struct blas *got;

		*(i ? &other.kind : &other.wide) ^= 2;
		ck_assert_int_eq(blas_cache_acquire(cache, &other, &got), 0);
		ck_assert_ptr_null(got);
		blas_cache_abandon(cache, &other);
	}
	blas_cache_destroy(&cache);
}
END_TEST

static atomic_uint n_failed;

/* Only the last worker to come succeeds in building it. */
static void *fail_then_make(void *arg)
{
	const struct blas_key key = key_of(0);
	const struct blas *got;

	(void)arg;
	ck_assert_int_eq(blas_cache_acquire(cache, &key, &got), 0);
	if (!got && n_failed < THREADS - 1) {
		usleep(20000); /* the others wait meanwhile */
		n_failed++;
		blas_cache_abandon(cache, &key);
		return NULL;
	}
	if (!got) {
		struct blas b = make(0, 640);

		got = blas_cache_publish(cache, &key, &b);
	}
	ck_assert(is_of(got, 0));
	blas_cache_release(cache, got);
	return NULL;
}

START_TEST(what_fails_passes_on)
{
	ck_assert_int_eq(blas_cache_create(1 << 20, &cache), 0);
	run_threads(fail_then_make);
	ck_assert_uint_eq(n_failed, THREADS - 1);
	ck_assert_int_eq(take(0, 640), 1);
	blas_cache_destroy(&cache);
}
END_TEST

/* Two accels with one cache: the second builds no tree for the large meshes, and both pools are equal. */
START_TEST(accels_share_trees)
{
	struct random_scene *s = random_scene_create(1);
	struct accel *both[2];

	ck_assert_int_eq(blas_cache_create(BLAS_CACHE_BYTES, &cache), 0);
	for (int i = 0; i < 2; i++) {
		ck_assert_int_eq(accel_create(&both[i]), 0);
		both[i]->wide = ACCEL_ROWS | ACCEL_COMPRESSED;
		both[i]->shared = cache;
		ck_assert_int_eq(accel_build_frame(both[i], &s->scene, NULL, NULL, s->instances, INSTANCES, &s->view, &s->spaces,
		                                   &s->n_spaces), 0);
		ck_assert_uint_eq(both[i]->n_triangles, s->accel->n_triangles);
		ck_assert_mem_eq(both[i]->nodes2, s->accel->nodes2, s->accel->n_nodes2 * sizeof(*s->accel->nodes2));
		ck_assert_mem_eq(both[i]->nodes8, s->accel->nodes8, s->accel->n_nodes8 * sizeof(*s->accel->nodes8));
		ck_assert_mem_eq(both[i]->nodes8c, s->accel->nodes8c, s->accel->n_nodes8c * sizeof(*s->accel->nodes8c));
		ck_assert_mem_eq(both[i]->triangles8, s->accel->triangles8, s->accel->n_triangles8 * sizeof(*s->accel->triangles8));
	}
	ck_assert_uint_eq(both[0]->n_made, s->accel->n_made);
	ck_assert_uint_lt(both[1]->n_made, both[0]->n_made);
	accel_destroy(&both[0]);
	accel_destroy(&both[1]);
	blas_cache_destroy(&cache);
	random_scene_free(s);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("blas_cache");

	choose_seed();
	tcase_set_timeout(tests, 60);
	tcase_add_test(tests, each_is_made_once);
	tcase_add_test(tests, little_room_makes_some_again);
	tcase_add_test(tests, unused_for_longest_goes_first);
	tcase_add_test(tests, what_fails_passes_on);
	tcase_add_test(tests, accels_share_trees);
	return run_case(tests, "blas_cache");
}
