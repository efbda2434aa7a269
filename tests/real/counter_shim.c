/*
 * Preloaded before the recorder by tests/show/kill.py: counts the frames whose swap has returned to the program, in a
 * file that outlives it (KILL_COUNTER: process number, then frames, 8 bytes each).
 */
#include <dlfcn.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

static volatile uint64_t *counter;

__attribute__((constructor)) static void start(void)
{
	const char *path = getenv("KILL_COUNTER");
	int fd = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
	void *p = fd < 0 ? MAP_FAILED : mmap(NULL, 16, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);

	if (p != MAP_FAILED) {
		counter = p;
		counter[0] = (uint64_t)getpid();
	}
	if (fd >= 0)
		close(fd);
}

void glXSwapBuffers(void *display, unsigned long drawable)
{
	void (*swap)(void *, unsigned long) = (void (*)(void *, unsigned long))dlsym(RTLD_NEXT, "glXSwapBuffers");

	swap(display, drawable);
	if (counter)
		counter[1]++;
}
