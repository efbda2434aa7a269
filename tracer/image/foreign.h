/*
 * Pictures that others made. OpenImageIO and the readers behind it are large, and a damaged file may end them or write
 * where it should not: each picture is read in a process of its own, which can read that file and reach nothing else.
 */
#pragma once

#include "tracer/image/image.h"

/**
 * As oiio_read. Any number of threads may read at once.
 * @return 0, ERR_INPUT (reported; also where the reader broke down or came to no end) or ERR_SYSTEM (reported)
 */
int foreign_read(struct image *img, const char *path);
