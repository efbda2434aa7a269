/*
 * Snappy is C++: if malloc fails it throws, and nothing catches that. Its temporary memory (175 KB at most, for chunks
 * of any size) therefore comes from here, for one caller at a time. These are C++'s operators new and delete, for the
 * command and the recorder only: no library or program sees them.
 */
#include <sched.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#define HIDDEN __attribute__((visibility("hidden")))
enum { RESERVE_BYTES = 256 << 10 };

static _Alignas(64) uint8_t reserve[RESERVE_BYTES]; /* costs nothing until it is used */
static atomic_flag is_taken = ATOMIC_FLAG_INIT;

HIDDEN void *_Znwm(size_t n);
HIDDEN void _ZdlPv(void *p);
HIDDEN void _ZdlPvm(void *p, size_t n);

void *_Znwm(size_t n)
{
	void *p = malloc(n ? n : 1);

	if (p)
		return p;
	if (n > RESERVE_BYTES)
		abort();
	while (atomic_flag_test_and_set(&is_taken))
		sched_yield();
	return reserve;
}

void _ZdlPv(void *p)
{
	if (p == reserve)
		atomic_flag_clear(&is_taken);
	else
		free(p);
}

void _ZdlPvm(void *p, size_t n)
{
	(void)n;
	_ZdlPv(p);
}
