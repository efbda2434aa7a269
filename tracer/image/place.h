/*
 * Windows of a picture. The numbers of an OpenEXR file fill its data window; the picture is its display window
 * (OpenEXR's technical introduction, "Image"). Readers give the data window's pixels, and where it lies as attribute
 * relume:window, "X Y WIDTH HEIGHT": the place of its first pixel in the display window, and the display window's size.
 * Where both are the same there is none.
 */
#pragma once

#include "tracer/image/image.h"

/**
 * Make the picture its display window: pixels beyond it go, and `outside` marks those that the file does not have.
 * @return 0, ERR_INPUT (reported: the windows have no pixel in common, or the display window is too large) or
 * ERR_SYSTEM (reported)
 */
int image_place(struct image *img, const char *path);
