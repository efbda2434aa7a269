/*
 * Pictures as the bridge to OpenImageIO reads them, in this process: the command does it in one of its own
 * (tracer/image/foreign.h), and survives what breaks here. The first byte of the input says which name the file ends
 * in, and so which of its readers comes first. OpenImageIO and what it stands on are Debian's: without counters of
 * edges, watched where they allocate, copy and free.
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
	if (!getenv("FUZZ_FREE") /* libFuzzer's merge starts itself */ &&
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
