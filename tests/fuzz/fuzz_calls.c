/* libFuzzer's target for the state machine alone: the input is a sequence of calls (calls.h), and is changed call by call. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/fuzz/calls.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out, size_t max_size,
                                 unsigned seed);

/* What is reported about senseless calls is of no interest here. */
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
	(void)argc;
	(void)argv;
	return freopen("/dev/null", "w", stdout) ? 0 : 1;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	if (calls_run(data, size, NULL))
		abort();
	return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
	size_t n = size / CALLS_SLOT, most = max_size / CALLS_SLOT, at = calls_draw(&seed, (unsigned)n), end, parts;
	uint8_t slot[CALLS_SLOT];

	switch (n && n < most ? calls_draw(&seed, 6) : n ? 4 + calls_draw(&seed, 2) : 0) {
	case 0: /* a call that was not there */
	case 1:
		calls_invent(&seed, slot);
		break;
	case 2: /* one that was, again */
		memcpy(slot, data + calls_draw(&seed, (unsigned)n) * CALLS_SLOT, CALLS_SLOT);
		break;
	case 3: /* without some */
		parts = n - at < 8 ? n - at : 8;
		end = at + 1 + calls_draw(&seed, (unsigned)parts);
		end = end > n ? n : end;
		memmove(data + at * CALLS_SLOT, data + end * CALLS_SLOT, (n - end) * CALLS_SLOT);
		return (n - (end - at)) * CALLS_SLOT;
	default: /* another value */
		data[at * CALLS_SLOT + 2 + calls_draw(&seed, CALLS_SLOT - 2)] = (uint8_t)calls_draw(&seed, 256);
		if (calls_draw(&seed, 4) == 0)
			LLVMFuzzerMutate(data + at * CALLS_SLOT, CALLS_SLOT, CALLS_SLOT);
		return n * CALLS_SLOT;
	}
	if (most == 0)
		return 0;
	memmove(data + (at + 1) * CALLS_SLOT, data + at * CALLS_SLOT, (n - at) * CALLS_SLOT);
	memcpy(data + at * CALLS_SLOT, slot, CALLS_SLOT);
	return (n + 1) * CALLS_SLOT;
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size, uint8_t *out, size_t max_size,
                                 unsigned seed)
{
	size_t most = max_size / CALLS_SLOT, a_n = a_size / CALLS_SLOT, b_n = b_size / CALLS_SLOT;
	size_t head = calls_draw(&seed, (unsigned)a_n + 1), tail = calls_draw(&seed, (unsigned)b_n + 1);

	head = head > most ? most : head;
	tail = tail > most - head ? most - head : tail;
	memcpy(out, a, head * CALLS_SLOT);
	memcpy(out + head * CALLS_SLOT, b + (b_n - tail) * CALLS_SLOT, tail * CALLS_SLOT);
	return (head + tail) * CALLS_SLOT;
}
