/*
 * Makes one picture of a shot: applies the rules and the camera, traces the scene, and adds further channels, and
 * attributes for reports.
 */
#pragma once

#include "tracer/frame/trace.h"
#include "verbs/render/settings.h"
#include "verbs/render/shot.h"

/* Receives the number of samples that the picture has so far (tracer_options.sampled). */
struct picture_listener {
	void (*sampled)(void *user, uint32_t done, uint32_t of);
	void *user;
};

/**
 * Make a picture.
 * @param tracer    used by one picture at a time
 * @param listener  called in this thread
 * @param img       filled; free with image_free, also after an error
 * @return 0; ERR_INPUT (reported): the camera's file is not for this frame; ERR_SYSTEM (reported)
 */
int picture_render(const struct settings *settings, struct tracer *tracer, const struct shot *shot,
                   const struct picture_listener *listener, struct image *img);
