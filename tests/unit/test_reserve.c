/* Reserved memory for when malloc fails (capture/format/reserve.c): for one user at a time, and never less than
 * requested. */
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tests/case.h"
#include "tests/emulated.h"

/* C++'s operators new and delete, as called by Snappy. */
void *_Znwm(size_t n);
void _ZdlPv(void *p);

enum { MOST = 175 << 10 }; /* the largest request of Snappy */

static atomic_int is_taken, others;

START_TEST(test_while_there_is_memory)
{
	uint8_t *a = _Znwm(MOST), *b = _Znwm(MOST);

	memset(a, 1, MOST);
	memset(b, 2, MOST);
	ck_assert_int_eq(a[MOST - 1], 1);
	_ZdlPv(a);
	_ZdlPv(b);
}
END_TEST

/* From here on malloc fails, even for libcheck's own notes. */
static void use_up_memory(struct rlimit *before)
{
	struct rlimit none;

	getrlimit(RLIMIT_AS, before);
	none = (struct rlimit){ 0, before->rlim_max };
	setrlimit(RLIMIT_AS, &none);
	for (size_t n = 1 << 20; n; n /= 2) {
		void *volatile taken; /* a compiler may drop a malloc whose result is not used */

		do
			taken = malloc(n);
		while (taken);
	}
}

static void *take_as_well(void *unused)
{
	void *p;

	while (!atomic_load(&is_taken))
		usleep(1000);
	p = _Znwm(MOST);
	atomic_fetch_add(&others, 1);
	memset(p, 2, MOST);
	_ZdlPv(p);
	return unused;
}

START_TEST(test_one_after_the_other)
{
	struct rlimit before;
	pthread_t thread;
	int meanwhile, changed = 0;
	uint8_t *p;

	if (memory_is_emulated())
		return;
	ck_assert_int_eq(pthread_create(&thread, NULL, take_as_well, NULL), 0);
	use_up_memory(&before);
	p = _Znwm(MOST);
	memset(p, 1, MOST);
	atomic_store(&is_taken, 1);
	usleep(100000);
	meanwhile = atomic_load(&others);
	for (int i = 0; i < MOST; i++)
		changed |= p[i] != 1;
	_ZdlPv(p);
	pthread_join(thread, NULL);
	setrlimit(RLIMIT_AS, &before);
	ck_assert_int_eq(meanwhile, 0);
	ck_assert_int_eq(changed, 0);
	ck_assert_int_eq(atomic_load(&others), 1);
}
END_TEST

/* The test writes all of the memory; a request beyond the reserve must fail. */
START_TEST(test_more_than_there_is)
{
	_Znwm(SIZE_MAX / 4);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("reserve");

	tcase_add_test(tests, test_while_there_is_memory);
	tcase_add_test(tests, test_one_after_the_other);
	tcase_add_test_raise_signal(tests, test_more_than_there_is, SIGABRT);
	return run_case(tests, "reserve");
}
