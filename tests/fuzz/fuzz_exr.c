/* OpenEXR frames, as `diff`, `denoise`, `film` and `--skip-existing` read them. */
#include <unistd.h>

#include "tests/fuzz/target.h"
#include "tracer/image/image.h"
#include "verbs/render/stamp.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	const struct stamp stamp = { "0123456789abcdef0123456789abcdef", "0123456789abcdef", "/a/program" };
	struct image img = { 0 };
	char path[32];
	int file = target_file(data, size, path);

	if (!image_read_exr(&img, path)) {
		for (size_t i = 0; i < img.n_channels; i++)
			image_values(&img, i);
		image_attribute(&img, "relume:trace");
		image_free(&img);
		stamp_check(&stamp, 3, path);
	}
	close(file);
	return 0;
}
