/*
 * Reading of pictures made by other programs. OpenImageIO and its readers are large, and a damaged file may crash them
 * or corrupt memory. So each picture is read in a separate process, which can read that file and access nothing else.
 */
#pragma once

#include "tracer/image/image.h"

/**
 * Read a picture as oiio_read does. Any number of threads may read at the same time.
 * @return 0, ERR_INPUT (reported; also if the reader crashed or ran too long) or ERR_SYSTEM (reported)
 */
int foreign_read(struct image *img, const char *path);
