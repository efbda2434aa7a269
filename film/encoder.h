/* Pictures to a film, by ffmpeg: a child process that takes them through a pipe. */
#pragma once

#include <stdint.h>

struct encoder;

/** 1 where a film of this name can be written; else 0, with the known endings reported. */
int encoder_knows(const char *path);

/**
 * Start ffmpeg.
 * @param path           where the film appears once it is whole; kept until encoder_close
 * @param width, height  of all pictures
 * @param fps            pictures a second
 * @return 0 or ERR_SYSTEM (reported)
 */
int encoder_open(const char *path, uint32_t width, uint32_t height, unsigned fps, struct encoder **out);

/** Add a picture. @param rgb  [height][width][3]. @return 0 or ERR_SYSTEM (reported) */
int encoder_write(struct encoder *encoder, const uint8_t *rgb);

/**
 * End the film. Remove it where `err` says that something has failed before.
 * @return err, or ERR_SYSTEM (reported)
 */
int encoder_close(struct encoder **encoder, int err);
