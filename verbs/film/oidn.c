#include "verbs/film/oidn.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "verbs/film/filter.h"

/* The part of its interface used here, from oidn.h 2 (https://www.openimagedenoise.org/documentation.html). */
enum { DEVICE_CPU = 1, FORMAT_FLOAT3 = 3 };

static struct {
	pthread_mutex_t lock;
	void *device; /* NULL: not open */
	void *(*new_device)(int type);
	void (*commit_device)(void *device);
	int (*device_error)(void *device, const char **text);
	void *(*new_filter)(void *device, const char *type);
	void (*set_image)(void *filter, const char *name, void *values, int format, size_t width, size_t height,
	                  size_t offset, size_t pixel_stride, size_t row_stride);
	void (*set_bool)(void *filter, const char *name, _Bool value);
	void (*commit_filter)(void *filter);
	void (*execute_filter)(void *filter);
	void (*release_filter)(void *filter);
} oidn = { .lock = PTHREAD_MUTEX_INITIALIZER };

static const struct symbol {
	const char *name;
	void **to;
} symbols[] = {
	{ "oidnNewDevice", (void **)&oidn.new_device },
	{ "oidnCommitDevice", (void **)&oidn.commit_device },
	{ "oidnGetDeviceError", (void **)&oidn.device_error },
	{ "oidnNewFilter", (void **)&oidn.new_filter },
	{ "oidnSetSharedFilterImage", (void **)&oidn.set_image },
	{ "oidnSetFilterBool", (void **)&oidn.set_bool },
	{ "oidnCommitFilter", (void **)&oidn.commit_filter },
	{ "oidnExecuteFilter", (void **)&oidn.execute_filter },
	{ "oidnReleaseFilter", (void **)&oidn.release_filter },
};

/* Report any error since the last check. @return 0: none; ERR_SYSTEM (reported) */
static int check_device(const char *where)
{
	const char *text = NULL;

	return oidn.device_error(oidn.device, &text) ? err_report(ERR_SYSTEM, where, "Open Image Denoise: %s", text) : 0;
}

int oidn_open(void)
{
	void *library;

	if (oidn.device)
		return 0;
	library = dlopen("libOpenImageDenoise.so.2", RTLD_NOW | RTLD_LOCAL);
	if (!library)
		return err_report(
			ERR_SYSTEM, NULL,
			"--oidn: Intel's Open Image Denoise 2 is not installed (%s); --denoise does not need it",
			dlerror());
	for (size_t i = 0; i < sizeof(symbols) / sizeof(symbols[0]); i++) {
		*symbols[i].to = dlsym(library, symbols[i].name);
		if (!*symbols[i].to)
			return err_report(ERR_SYSTEM, NULL, "--oidn: Open Image Denoise has no %s", symbols[i].name);
	}
	oidn.device = oidn.new_device(DEVICE_CPU);
	if (!oidn.device)
		return err_report(ERR_SYSTEM, NULL, "--oidn: Open Image Denoise does not run on this processor");
	oidn.commit_device(oidn.device);
	return check_device(NULL);
}

/* Three channels side by side. name: a prefix and three letters, as "N.XYZ" */
static int interleave(struct image *img, const char *where, const char *name, float (*out)[3])
{
	const size_t length = strlen(name) - 3, n = (size_t)img->width * img->height;

	for (int c = 0; c < 3; c++) {
		char channel[16] = "";
		const float *plane;

		strncat(channel, name, length);
		strncat(channel, name + length + c, 1);
		plane = image_channel(img, channel);
		if (!plane)
			return err_report(ERR_INPUT, where,
			                  "has no channel %s; render it with all channels, or --aov %s", channel,
			                  FILTER_NEEDS);
		for (size_t i = 0; i < n; i++)
			out[i][c] = plane[i];
	}
	return 0;
}

static int execute(const struct image *img, const char *where, float (*color)[3], float (*albedo)[3],
                   float (*normal)[3])
{
	const struct {
		const char *name;
		float (*values)[3];
	} images[] = { { "color", color }, { "albedo", albedo }, { "normal", normal }, { "output", color } };
	void *filter;
	int err;

	pthread_mutex_lock(&oidn.lock);
	filter = oidn.new_filter(oidn.device, "RT");
	for (size_t i = 0; filter && i < sizeof(images) / sizeof(images[0]); i++)
		oidn.set_image(filter, images[i].name, images[i].values, FORMAT_FLOAT3, img->width, img->height, 0, 0, 0);
	if (filter) {
		oidn.set_bool(filter, "hdr", 1);
		oidn.commit_filter(filter);
		oidn.execute_filter(filter);
		oidn.release_filter(filter);
	}
	err = check_device(where);
	pthread_mutex_unlock(&oidn.lock);
	return err;
}

int oidn_denoise(struct image *img, const char *where)
{
	const size_t n = (size_t)img->width * img->height;
	float (*planes)[3] = calloc(3 * n + 1, sizeof(*planes)), *to[3];
	int err = planes ? 0 : err_report(ERR_SYSTEM, where, "out of memory for %u x %u pixels", img->width, img->height);

	if (!err)
		err = interleave(img, where, "RGB", planes);
	if (!err)
		err = interleave(img, where, "albedo.RGB", planes + n);
	if (!err)
		err = interleave(img, where, "N.XYZ", planes + 2 * n);
	if (!err)
		err = execute(img, where, planes, planes + n, planes + 2 * n);
	if (!err)
		err = filter_beauty(img, to);
	for (int c = 0; c < 3 && !err; c++)
		for (size_t i = 0; i < n; i++)
			to[c][i] = planes[i][c];
	free(planes);
	return err;
}
