/* Makes one picture of a shot: with the rules applied, from the recorded camera or another, with attributes for
 * reports. */
#pragma once

#include "tracer/frame/trace.h"
#include "verbs/render/settings.h"
#include "verbs/render/shot.h"

/* Called with the number of samples that a picture has so far (tracer_options.sampled). */
struct picture_listener {
	void (*sampled)(void *user, uint32_t done, uint32_t of);
	void *user;
};

/**
 * @param tracer  traces it; one picture at a time
 * @param listener  called in this thread
 * @param img     filled; image_free, also after an error
 * @return 0; ERR_INPUT: the camera's file is not for this frame; ERR_SYSTEM (reported)
 */
int picture_render(const struct settings *settings, struct tracer *tracer, const struct shot *shot,
                   const struct picture_listener *listener, struct image *img);
