/*
 * Pictures read through the bridge to OpenImageIO, in this process; the command uses a separate one
 * (tracer/image/foreign.h), which survives crashes found here. The first byte of the input selects the file name's
 * ending, and thus the reader tried first. OpenImageIO and its libraries are Debian's: without edge counters, but with
 * their allocations, copies and frees checked.
 */
#include <stdio.h>
#include <stdlib.h>

#include "base/confine.h"
#include "tests/fuzz/target.h"
#include "tracer/image/oiio.h"

static const char *const endings[] = { "png",  "jpg", "tif", "exr", "bmp", "tga", "gif", "hdr",
	                               "webp", "psd", "dds", "sgi", "pnm", "ico", "dpx", "cin" };

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
	const struct confine_file files[] = { { target_folder(), CONFINE_FILLS },
		                              { "build", CONFINE_FILLS },
		                              { "tests/fuzz", CONFINE_FILLS } };

	(void)argc;
	(void)argv;
	if (!getenv("FUZZ_FREE") /* libFuzzer's merge restarts this program */ &&
	    confine_to(files, sizeof(files) / sizeof(files[0]), CONFINE_READER))
		return 1;
	return freopen("/dev/null", "w", stdout) ? 0 : 1;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct image img = { 0 };
	char name[32], path[4096];
	uint8_t ending;

	if (!target_take(&data, &size, &ending, 1))
		return 0;
	snprintf(name, sizeof(name), "x.%s", endings[ending % (sizeof(endings) / sizeof(endings[0]))]);
	target_write(name, data, size, path);
	if (!oiio_read(&img, path))
		image_free(&img);
	return 0;
}
