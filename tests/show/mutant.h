/*
 * Switches that schemata.py inserts into sources, each choosing between the original text and a mutant's. Never part of
 * the product. OpenCL C keeps the original: mutants of shared text run in its C build.
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

/* One instance for all files of a program or library. */
#define MUTANT_SHARED __attribute__((weak, visibility("hidden")))
MUTANT_SHARED int mutant_at = 0; /* active mutant; 0: none, -1: record reached mutants */
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

/* Whether mutant n is active. what: value recorded when none is active. */
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
/* For values whose expression can be evaluated twice. */
#define MUTANT_VALUE(n, was, instead) ({ \
	__auto_type mutant_was_##n = was; \
	if (__builtin_expect(mutant_at, 0) && mutant_runs(n, mutant_at < 0 && mutant_was_##n != instead ? 3 : 1)) \
		mutant_was_##n = instead; \
	mutant_was_##n; \
})
#endif
