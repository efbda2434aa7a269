#include "verbs/render/preview.h"

#include "base/folder.h"

#define MAX_PATH_BYTES 4096

int preview_show(void *user, struct image *img)
{
	const struct preview *p = user;
	const struct settings *s = p->settings;
	struct display *display = NULL;
	char path[MAX_PATH_BYTES];
	int err = settings_denoise(s, img);

	if (!err)
		err = frame_pattern_expand(s->preview, p->frame, path, sizeof(path));
	if (!err)
		err = folder_make_for(path);
	if (err)
		return err;
	if (display_kind_of(path) == DISPLAY_EXR)
		return image_write_exr(img, path);
	err = display_create(&s->display, &display);
	if (!err)
		err = display_write(display, img, path, NULL);
	display_destroy(&display);
	return err;
}
