/*
 * Intel's Open Image Denoise (2.x), where it is installed: loaded when asked for, never needed. The same file on the same processor gives
 * the same bytes.
 */
#pragma once

#include "tracer/image/image.h"

/**
 * Load it and make it ready. Before the process confines itself: the library opens files.
 * @return 0 or ERR_SYSTEM (reported: it is not there, or of another version)
 */
int oidn_open(void);

/**
 * Take the noise out of R, G and B, guided by albedo and N; effect channels, which no longer add up to them, go. Any thread, one at a time.
 * @param where  the image's name, for messages
 * @return 0; ERR_INPUT (reported: channels are missing); ERR_SYSTEM (reported)
 */
int oidn_denoise(struct image *img, const char *where);
