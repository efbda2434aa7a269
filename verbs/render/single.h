/* Renders one frame as GL drew it, for verbs that ask what a pixel shows. */
#pragma once

#include "replay/replay.h"
#include "scene/scene.h"
#include "tracer/image/image.h"
#include "verbs/render/supply.h"

/* All zero is empty. */
struct single {
	struct replay *replay; /* open; the caller plays it up to a frame */
	struct device *dev;
	struct tracer *tracer;
	struct supply supply;
	struct scene *scene;   /* the frame's scene; set by the caller, freed by single_free */
	struct image image;    /* its picture, once rendered */
};

/**
 * Open a recording and a device.
 * @param device  as for device_open
 * @param single  zero-initialised; single_free, also after an error
 * @return 0, ERR_USAGE, ERR_INPUT or ERR_SYSTEM (reported)
 */
int single_open(const char *trace, const char *device, struct single *single);

/** Render the scene in mode gl, one sample a pixel. @param aov channel groups. @return 0 or ERR_SYSTEM (reported) */
int single_render(struct single *single, const char *aov);

/** Which draw a pixel of the picture shows, by channel id. @return its number; 0: none */
uint32_t single_draw_at(const struct single *single, size_t pixel);

void single_free(struct single *single);
