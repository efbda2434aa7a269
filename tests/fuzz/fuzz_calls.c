/* libFuzzer target for the state machine alone: the input is a sequence of calls (calls.h), and is mutated call by
 * call. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/fuzz/calls.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out,
                                 size_t max_size, unsigned seed);

/* Messages about nonsensical calls are of no interest. */
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
	(void)argc;
	(void)argv;
	return freopen("/dev/null", "w", stdout) ? 0 : 1;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	if (calls_run(data, size, &calls_grey))
		abort();
	return 0;
}

/* Insert new calls, each related to the previous one, or repeat an existing one. @return the number inserted */
static size_t insert(uint8_t *data, size_t n, size_t most, unsigned *seed)
{
	size_t at = calls_draw(seed, (unsigned)n + 1), count = calls_draw(seed, 3) ? 1 : 1 + calls_draw(seed, 8);
	uint8_t slot[CALLS_SLOT], *to = data + at * CALLS_SLOT;

	count = count < most - n ? count : most - n;
	if (n)
		memcpy(slot, data + calls_draw(seed, (unsigned)n) * CALLS_SLOT, CALLS_SLOT);
	memmove(to + count * CALLS_SLOT, to, (n - at) * CALLS_SLOT);
	if (n && calls_draw(seed, 3) == 0)
		for (size_t i = 0; i < count; i++)
			memcpy(to + i * CALLS_SLOT, slot, CALLS_SLOT);
	else
		for (size_t i = 0; i < count; i++, to += CALLS_SLOT)
			calls_invent(seed, to, to > data ? to - CALLS_SLOT : NULL);
	return count;
}

static void change(uint8_t *slot, unsigned *seed)
{
	size_t n = calls_used(slot) - 2, at = 2 + calls_draw(seed, (unsigned)n + 1);

	slot[at < n + 2 ? at : CALLS_SLOT - 1] = (uint8_t)calls_draw(seed, 256);
	if (calls_draw(seed, 8) == 0) {
		LLVMFuzzerMutate(slot, CALLS_SLOT, CALLS_SLOT);
		calls_settle(slot);
	}
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
	size_t n = size / CALLS_SLOT, most = max_size / CALLS_SLOT, at = calls_draw(&seed, (unsigned)n), count;

	if (most > n && (n == 0 || calls_draw(&seed, 2)))
		return (n + insert(data, n, most, &seed)) * CALLS_SLOT;
	if (n == 0)
		return 0;
	if (calls_draw(&seed, 3)) {
		change(data + at * CALLS_SLOT, &seed);
		return n * CALLS_SLOT;
	}
	count = 1 + calls_draw(&seed, n - at < 8 ? (unsigned)(n - at) : 8);
	memmove(data + at * CALLS_SLOT, data + (at + count) * CALLS_SLOT, (n - at - count) * CALLS_SLOT);
	return (n - count) * CALLS_SLOT;
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out,
                                 size_t max_size, unsigned seed)
{
	size_t most = max_size / CALLS_SLOT, a_n = a_size / CALLS_SLOT, b_n = b_size / CALLS_SLOT;
	size_t head = calls_draw(&seed, (unsigned)a_n + 1), tail = calls_draw(&seed, (unsigned)b_n + 1);

	head = head > most ? most : head;
	tail = tail > most - head ? most - head : tail;
	memcpy(out, a, head * CALLS_SLOT);
	memcpy(out + head * CALLS_SLOT, b + (b_n - tail) * CALLS_SLOT, tail * CALLS_SLOT);
	return (head + tail) * CALLS_SLOT;
}
