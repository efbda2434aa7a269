/*
 * What schemata.py puts into sources: places where a mutant's text may stand for what was. Nothing of it is in the
 * product. OpenCL C keeps what was: mutants of shared text run in its C build.
 */
#pragma once

#ifdef __OPENCL_VERSION__
#define MUTANT(n, was, instead) was
#define MUTANT_VALUE(n, was, instead) was
#define MUTANT_BRANCH(n, was) was
#else
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

/* One for all files of a program or library. */
#define MUTANT_SHARED __attribute__((weak, visibility("hidden")))
MUTANT_SHARED int mutant_at = 0; /* its number; 0: none, -1: seen ones are noted */
MUTANT_SHARED unsigned char *mutant_seen = 0;

MUTANT_SHARED __attribute__((constructor)) void mutant_begin(void)
{
	const char *number = getenv("RELUME_MUTANT"), *path = getenv("RELUME_MUTANTS");
	const int fd = path && !mutant_at ? open(path, O_RDWR | O_CLOEXEC) : -1;
	struct stat st;

	if (number)
		mutant_at = atoi(number);
	if (fd < 0)
		return;
	if (!fstat(fd, &st)) {
		void *seen = mmap(0, (size_t)st.st_size, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);

		mutant_seen = seen == MAP_FAILED ? 0 : seen;
		mutant_at = mutant_seen ? -1 : 0;
	}
	close(fd);
}

/* Whether mutant n runs; what: what is noted where none does. */
static inline int mutant_runs(int n, int what)
{
	if (__builtin_expect(!mutant_at, 1))
		return 0;
	if (mutant_at < 0)
		mutant_seen[n] |= (unsigned char)what;
	return mutant_at == n;
}

#define MUTANT(n, was, instead) (mutant_runs(n, 3) ? instead : was)
#define MUTANT_BRANCH(n, was) (was && !mutant_runs(n, 3))
/* Numbers that can be worked out twice. */
#define MUTANT_VALUE(n, was, instead) ({ \
	__auto_type mutant_was_##n = was; \
	if (__builtin_expect(mutant_at, 0) && mutant_runs(n, mutant_at < 0 && mutant_was_##n != instead ? 3 : 1)) \
		mutant_was_##n = instead; \
	mutant_was_##n; \
})
#endif
