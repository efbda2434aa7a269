/*
 * One kernel launched on several queues at once with growing widths and more threads than cores: PoCL miscounts the
 * kernel's users if launches of several widths run at once (tracer/device/cl_launch.h), and ends the process.
 */
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include "kernels/frame/stages/scan.h"
#include "tests/case.h"
#include "tests/driver.h"
#include "tracer/frame/light/scan.h"

#define QUEUES 8
#define LAUNCHES 250u
#define STEP 50u /* work items, so that the last launches have groups of their own */
#define MOST (SCAN_CHUNK * (2 + STEP * LAUNCHES * QUEUES))

struct queue {
	struct device *dev;
	union buffer_uint counts; /* shared */
	const char *wrong;
};

static atomic_uint n_launched;

/* Sums of ones: each launch, on any queue, is slightly wider than earlier ones. */
static void *launch_all(void *user)
{
	struct queue *q = user;
	union buffer_uint sums = { NULL };
	uint32_t got[2];

	q->wrong = launch_reserve(q->dev, sums, MOST / SCAN_CHUNK) ? "reserve" : NULL;
	for (uint32_t i = 0; i < LAUNCHES && !q->wrong; i++) {
		const uint32_t chunks = 2 + STEP * atomic_fetch_add(&n_launched, 1);

		if (launch_scan_sum(
			    q->dev, chunks,
			    LAUNCH(scan_sum, .counts = q->counts, .n = chunks * SCAN_CHUNK, .full = 2, .sums = sums)) ||
		    device_read(q->dev, sums.buffer, (chunks - 2) * sizeof(got[0]), got, sizeof(got)))
			q->wrong = "launch";
		else if ((got[0] & 0x7fffffff) != SCAN_CHUNK || (got[1] & 0x7fffffff) != SCAN_CHUNK)
			q->wrong = "sums";
	}
	device_release(q->dev, &sums.buffer);
	return NULL;
}

START_TEST(widths_at_once)
{
	struct queue queues[QUEUES] = { { NULL } };
	pthread_t threads[QUEUES];
	uint32_t *ones = malloc(MOST * sizeof(*ones));
	union buffer_uint counts = { NULL };
	struct device *dev = NULL;

	setenv("POCL_MAX_PTHREAD_COUNT", "16", 1);
	ck_assert_int_eq(device_open("0", 0, &dev), 0);
	ck_assert_ptr_nonnull(ones);
	for (uint32_t i = 0; i < MOST; i++)
		ones[i] = 1;
	ck_assert_int_eq(launch_reserve(dev, counts, MOST), 0);
	ck_assert_int_eq(device_write(dev, counts.buffer, 0, ones, MOST * sizeof(*ones)), 0);
	ck_assert_int_eq(device_finish(dev), 0);
	for (uint32_t i = 0; i < QUEUES; i++) {
		queues[i].counts = counts;
		ck_assert_int_eq(device_share(dev, &queues[i].dev), 0);
		ck_assert_int_eq(pthread_create(&threads[i], NULL, launch_all, &queues[i]), 0);
	}
	for (uint32_t i = 0; i < QUEUES; i++) {
		pthread_join(threads[i], NULL);
		ck_assert_msg(!queues[i].wrong, "queue %u: %s", i, queues[i].wrong);
		device_close(&queues[i].dev);
	}
	device_release(dev, &counts.buffer);
	device_close(&dev);
	free(ones);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("devices");

	if (lacks_driver())
		return SKIPPED;
	tcase_set_timeout(tests, 240);
	tcase_add_test(tests, widths_at_once);
	return run_case(tests, "widths");
}
