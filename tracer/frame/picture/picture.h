/* Transfers pixels in the format of GL's frame buffer to the device before a frame and back after it. */
#pragma once

#include "tracer/frame/common/frame.h"

/** Upload the band's pixels from before the scene, or mark them as unknown. @return 0 or ERR_SYSTEM (reported) */
int picture_upload_start(struct job *job);

/** Read the band from buffers.frame. @param picture as in tracer_render_picture, except for `unknown` @return 0 or
 * ERR_SYSTEM (reported) */
int picture_read_band(const struct job *job, struct scene_picture *picture);

/** Add the band's unknown pixels, in buffers.frame or in buffers.unknown, to job->unknown. @return 0, ERR_MEMORY or
 * ERR_SYSTEM (reported) */
int picture_count_band(struct job *job);
int picture_count_rows(struct job *job);

/**
 * Read the band into job->picture, and add its unknown pixels, in buffers.unknown, to job->unknown.
 * @param kept     pixels that the kernel layered kept
 * @param stencil  value that the stencil buffer was cleared to, if the scene starts without a picture
 * @return 0 or ERR_SYSTEM (reported)
 */
int picture_take_band(struct job *job, union buffer_float kept, uint32_t stencil);
