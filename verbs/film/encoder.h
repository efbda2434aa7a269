/* Encodes pictures as a film, with ffmpeg: a child process that reads them from a pipe. */
#pragma once

#include <stdint.h>

struct encoder;
struct matroska_view;

/** 1 if a film of this name can be written; else 0, and the known endings are reported. */
int encoder_knows(const char *path);

/**
 * Start ffmpeg.
 * @param path           the film's file, which appears once it is complete; kept until encoder_close
 * @param width, height  of all pictures
 * @param fps            pictures per second
 * @param view           tells players how to show the pictures
 * @return 0 or ERR_SYSTEM (reported)
 */
int encoder_open(const char *path, uint32_t width, uint32_t height, unsigned fps,
                 const struct matroska_view *view, struct encoder **out);

/** Add a picture. @param rgb  [height][width][3]. @return 0 or ERR_SYSTEM (reported) */
int encoder_write(struct encoder *encoder, const uint8_t *rgb);

/**
 * End the film; if `err` reports an earlier failure, remove it.
 * @return err, or ERR_SYSTEM (reported)
 */
int encoder_close(struct encoder **encoder, int err);
