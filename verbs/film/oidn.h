/*
 * Intel's Open Image Denoise (2.x), if it is installed: loaded on request, never required. The same file on the same
 * processor gives the same bytes.
 */
#pragma once

#include "tracer/image/image.h"

/**
 * Load and initialise it. Call before the process confines itself: the library opens files.
 * @return 0 or ERR_SYSTEM (reported: it is not there, or of another version)
 */
int oidn_open(void);

/**
 * Remove noise from R, G and B, guided by albedo and N. Effect channels are removed: they no longer add up to these.
 * Callable from any thread, one at a time.
 * @param where  the image's name, for messages
 * @return 0; ERR_INPUT (reported: channels are missing); ERR_SYSTEM (reported)
 */
int oidn_denoise(struct image *img, const char *where);
