/*
 * Windows of a picture. The pixels of an OpenEXR file fill its data window; the picture is its display window
 * (OpenEXR's technical introduction, "Image"). Readers return the pixels of the data window. If the windows differ,
 * they set attribute relume:window, "X Y WIDTH HEIGHT": the position of the data window's first pixel in the display
 * window, and the size of the display window.
 */
#pragma once

#include "tracer/image/image.h"

/**
 * Crop and extend the picture to its display window. `outside` marks the pixels that the file does not have.
 * @return 0, ERR_INPUT (reported: the windows have no pixel in common, or the display window is too large) or
 * ERR_SYSTEM (reported)
 */
int image_place(struct image *img, const char *path);
