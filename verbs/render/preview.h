/* Shows a frame's picture while its samples are still being traced: a file that is always complete, and rewritten from
 * time to time. */
#pragma once

#include "tracer/image/image.h"
#include "verbs/render/settings.h"

struct preview {
	const struct settings *settings; /* preview: the file's name */
	uint64_t frame;
};

/**
 * tracer_options.preview: write the file.
 * @param user  struct preview
 * @param img   denoised if the settings ask for it
 * @return 0 or ERR_SYSTEM (reported)
 */
int preview_show(void *user, struct image *img);
