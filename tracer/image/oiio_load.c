/*
 * Loads OpenImageIO and its hundreds of dependencies when the first picture needs them. If they were linked with the
 * command, loading them would be most of the time of a short run. The bridge itself is oiio.cpp, in relume-oiio.so.
 */
#include "tracer/image/oiio.h"

#include <dlfcn.h>
#include <limits.h>
#include <pthread.h>

#include "base/beside.h"
#include "base/err.h"

static struct {
	pthread_once_t once;
	int whole; /* 1: all functions were found; 0: the reason was reported */
	__typeof__(oiio_fork) *fork;
	__typeof__(oiio_read) *read;
	__typeof__(oiio_encode) *encode;
	__typeof__(oiio_compare_yee) *compare_yee;
	__typeof__(oiio_draw_text) *draw_text;
} bridge = { .once = PTHREAD_ONCE_INIT };

static void load(void)
{
	char path[PATH_MAX];
	void *library;

	if (beside_find("relume-oiio.so", path, sizeof(path)))
		return;
	library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
	if (!library) {
		err_report(ERR_SYSTEM, path, "cannot be loaded: %s", dlerror());
		return;
	}
	*(void **)&bridge.fork = dlsym(library, "oiio_fork");
	*(void **)&bridge.read = dlsym(library, "oiio_read");
	*(void **)&bridge.encode = dlsym(library, "oiio_encode");
	*(void **)&bridge.compare_yee = dlsym(library, "oiio_compare_yee");
	*(void **)&bridge.draw_text = dlsym(library, "oiio_draw_text");
	bridge.whole = bridge.fork && bridge.read && bridge.encode && bridge.compare_yee && bridge.draw_text;
	if (!bridge.whole)
		err_report(ERR_SYSTEM, path, "belongs to another version of Relume");
}

static int loaded(void)
{
	pthread_once(&bridge.once, load);
	return bridge.whole;
}

pid_t oiio_fork(void)
{
	return loaded() ? bridge.fork() : -1;
}

int oiio_read(struct image *img, const char *path)
{
	return loaded() ? bridge.read(img, path) : ERR_SYSTEM;
}

int oiio_encode(const struct oiio_pixels *pixels, const struct oiio_coding *coding, uint8_t **out, size_t *out_bytes)
{
	return loaded() ? bridge.encode(pixels, coding, out, out_bytes) : ERR_SYSTEM;
}

int oiio_compare_yee(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, double *count)
{
	return loaded() ? bridge.compare_yee(a, b, width, height, count) : ERR_SYSTEM;
}

int oiio_draw_text(const struct oiio_pixels *pixels, const struct oiio_label *label)
{
	return loaded() ? bridge.draw_text(pixels, label) : ERR_SYSTEM;
}
