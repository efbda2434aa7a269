#include "verbs/render/stamp.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/version.h"
#include "tracer/image/display.h"
#include "tracer/image/foreign.h"

int stamp_image(const struct stamp *stamp, struct image *img)
{
	const char *slash = strrchr(stamp->program, '/');
	int err = image_set_attribute(img, "relume:trace", "%s", stamp->trace);

	if (!err && stamp->program[0])
		err = image_set_attribute(img, "relume:program", "%s", slash ? slash + 1 : stamp->program);
	if (!err)
		err = image_set_attribute(img, "relume:settings", "%s", stamp->settings);
	return err ? err : image_set_attribute(img, "relume:version", "%s", RELUME_VERSION);
}

/* A JPEG that was cut reads as a picture with grey below: it must end with its end marker. */
static int is_cut(const char *path)
{
	uint8_t end[2] = { 0 };
	FILE *file;

	if (display_kind_of(path) != DISPLAY_JPEG)
		return 0;
	file = fopen(path, "rb");
	if (file && fseek(file, -2, SEEK_END) == 0 && fread(end, 1, 2, file) != 2)
		end[0] = 0;
	if (file)
		fclose(file);
	return (end[0] != 0xff || end[1] != 0xd9) && err_report(ERR_INPUT, path, "is cut short");
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
	if (is_cut(path) || (display_kind_of(path) == DISPLAY_EXR ? image_read_exr(&img, path) : foreign_read(&img, path)))
		return STAMP_DAMAGED;
	snprintf(number, sizeof(number), "%llu", (unsigned long long)frame);
	same = says(&img, "relume:trace", stamp->trace) && says(&img, "relume:settings", stamp->settings) &&
	       says(&img, "relume:version", RELUME_VERSION) && says(&img, "relume:frame", number);
	image_free(&img);
	return same ? STAMP_SAME : STAMP_OTHER;
}
