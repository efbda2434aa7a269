#include "render/stamp.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/version.h"

int stamp_image(const struct stamp *stamp, struct image *img)
{
	int err = image_set_attribute(img, "relume:trace", "%s", stamp->trace);

	if (!err)
		err = image_set_attribute(img, "relume:settings", "%s", stamp->settings);
	return err ? err : image_set_attribute(img, "relume:version", "%s", RELUME_VERSION);
}

static int says(const struct image *img, const char *name, const char *text)
{
	const char *found = image_attribute(img, name);

	return found && strcmp(found, text) == 0;
}

enum stamp_state stamp_check(const struct stamp *stamp, uint64_t frame, const char *path)
{
	struct image img = { .width = 0 };
	char number[24];
	int same;

	if (access(path, F_OK) != 0)
		return STAMP_MISSING;
	if (image_read_exr(&img, path))
		return STAMP_DAMAGED;
	snprintf(number, sizeof(number), "%llu", (unsigned long long)frame);
	same = says(&img, "relume:trace", stamp->trace) && says(&img, "relume:settings", stamp->settings) &&
	       says(&img, "relume:version", RELUME_VERSION) && says(&img, "relume:frame", number);
	image_free(&img);
	return same ? STAMP_SAME : STAMP_OTHER;
}
