/*
 * Preloaded into a program by test_record_same_pixels.sh: prints a checksum of every frame, and ends the program after
 * SHIM_FRAMES frames. The clock that turns glxgears' wheels advances only 20 ms per frame, so that two runs draw the
 * same.
 */
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/time.h>

enum { VIEWPORT = 0x0BA2, RGBA = 0x1908, UNSIGNED_BYTE = 0x1401, FRAME_US = 20000 };

static long frames;

int gettimeofday(struct timeval *restrict tv, void *restrict zone)
{
	(void)zone;
	tv->tv_sec = 1000 + frames * FRAME_US / 1000000;
	tv->tv_usec = frames * FRAME_US % 1000000;
	return 0;
}

static uint64_t checksum(const uint8_t *bytes, size_t n)
{
	uint64_t sum = 14695981039346656037u; /* FNV-1a */

	for (size_t i = 0; i < n; i++)
		sum = (sum ^ bytes[i]) * 1099511628211u;
	return sum;
}

void glXSwapBuffers(void *display, unsigned long drawable)
{
	void (*swap)(void *, unsigned long) = (void (*)(void *, unsigned long))dlsym(RTLD_NEXT, "glXSwapBuffers");
	void (*get)(unsigned, int *) = (void (*)(unsigned, int *))dlsym(RTLD_NEXT, "glGetIntegerv");
	void (*read)(int, int, int, int, unsigned, unsigned, void *) =
		(void (*)(int, int, int, int, unsigned, unsigned, void *))dlsym(RTLD_NEXT, "glReadPixels");
	unsigned (*error)(void) = (unsigned (*)(void))dlsym(RTLD_NEXT, "glGetError");
	int viewport[4];
	uint8_t *pixels;

	get(VIEWPORT, viewport);
	pixels = malloc((size_t)viewport[2] * (size_t)viewport[3] * 4);
	read(0, 0, viewport[2], viewport[3], RGBA, UNSIGNED_BYTE, pixels);
	printf("frame %ld %dx%d %016llx error %x\n", frames, viewport[2], viewport[3],
	       (unsigned long long)checksum(pixels, (size_t)viewport[2] * (size_t)viewport[3] * 4), error());
	free(pixels);
	swap(display, drawable);
	if (++frames == atoi(getenv("SHIM_FRAMES")))
		exit(0);
}
