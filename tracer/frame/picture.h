/* Pixels as GL's frame buffer has them, to the device before a frame and from there after it. */
#pragma once

#include "tracer/frame/frame.h"

/** Put the band's pixels on the device that were there before the scene, or say that they are not known. @return 0 or
 * ERR_SYSTEM (reported) */
int picture_upload_start(struct job *job);

/** What was drawn of the band into buffers.frame. @param picture  as for tracer_render_picture, but for `unknown`
 * @return 0 or ERR_SYSTEM (reported) */
int picture_read_band(const struct job *job, struct scene_picture *picture);

/** Count the band's pixels in buffers.frame, or in buffers.unknown, that go into job->unknown. @return 0, ERR_MEMORY or
 * ERR_SYSTEM (reported) */
int picture_count_band(struct job *job);
int picture_count_rows(struct job *job);

/**
 * What was drawn of the band into buffers.kept_pixels, into job->picture; pixels in buffers.unknown count as well.
 * @param stencil  where the scene begins with no picture, what the stencil buffer was cleared to
 * @return 0 or ERR_SYSTEM (reported)
 */
int picture_take_band(struct job *job, uint32_t stencil);
