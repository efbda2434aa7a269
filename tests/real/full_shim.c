/*
 * Simulates a full disk; preloaded into a program by test_record_full.py. A pwrite to a file whose name ends with
 * FULL_NAME writes up to FULL_BYTES and then fails with errno FULL_ERRNO.
 */
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

static int is_meant(int fd)
{
	const char *ending = getenv("FULL_NAME");
	char link[64], path[4096];
	ssize_t n;

	snprintf(link, sizeof(link), "/proc/self/fd/%d", fd);
	n = ending ? readlink(link, path, sizeof(path) - 1) : -1;
	if (n < (ssize_t)(ending ? strlen(ending) : 0))
		return 0;
	path[n] = '\0';
	return strcmp(path + n - strlen(ending), ending) == 0;
}

ssize_t pwrite(int fd, const void *data, size_t bytes, off_t offset)
{
	ssize_t (*real)(int, const void *, size_t,
	                off_t) = (ssize_t(*)(int, const void *, size_t, off_t))dlsym(RTLD_NEXT, "pwrite");
	const off_t most = atol(getenv("FULL_BYTES") ? getenv("FULL_BYTES") : "0");

	if (!is_meant(fd) || offset + (off_t)bytes <= most)
		return real(fd, data, bytes, offset);
	if (offset < most)
		return real(fd, data, (size_t)(most - offset), offset);
	errno = atoi(getenv("FULL_ERRNO"));
	return -1;
}

ssize_t pwrite64(int fd, const void *data, size_t bytes, off_t offset)
{
	return pwrite(fd, data, bytes, offset);
}
