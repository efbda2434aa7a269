/* Transfers pixels in the format of GL's frame buffer to the device before a frame and back after it. */
#pragma once

#include "tracer/frame/common/frame.h"

/** Upload the band's pixels from before the scene, or mark them as unknown. @return 0 or ERR_SYSTEM (reported) */
int picture_upload_start(const struct band *band);

/** Read the band from the frame's pixels. @param picture as in tracer_render_picture, except for `unknown` @return 0 or
 * ERR_SYSTEM (reported) */
int picture_read_band(const struct band *band, struct scene_picture *picture);

/** Add the band's unknown pixels, in the frame or in `unknown`, to drawn->unknown. @return 0, ERR_MEMORY or
 * ERR_SYSTEM (reported) */
int picture_count_band(const struct band *band);
int picture_count_rows(const struct band *band, union buffer_uint unknown);

/** Convert the picture that the frame starts from to the pixels that the kernel layered keeps. @return 0, ERR_MEMORY or
 * ERR_SYSTEM (reported) */
int picture_keep_start(const struct band *band, union buffer_float kept);

/**
 * Read the band into pass->picture, and add its unknown pixels to drawn->unknown.
 * @param kept     pixels that the kernel layered kept
 * @param unknown  which of them are unknown
 * @param stencil  value that the stencil buffer was cleared to, if the scene starts without a picture
 * @return 0 or ERR_SYSTEM (reported)
 */
int picture_take_band(const struct band *band, union buffer_float kept, union buffer_uint unknown, uint32_t stencil);
