/*
 * Segments (tracer/frame/prepare/prepare.h): clears, camera rays, fragments gathered and shaded, per-fragment
 * operations. Functions return 0 or ERR_SYSTEM (reported).
 */
#pragma once

#include "tracer/frame/common/frame.h"

/** Pixels of the band inside a scissor rectangle; the same as positions in the buffers of pixels. */
struct camera_rectangle segment_rectangle(const struct band *band, const int32_t scissor[4]);
struct camera_rectangle segment_in_buffers(const struct band *band, struct camera_rectangle r);

/** Make room for the fragments that camera rays find in the band: `slots` per pixel. */
int segment_reserve(const struct band *band, uint32_t slots);

/** Arguments of a camera pass over a rectangle of the band, into the buffers `sparse` and `counts`; run that pass.
 * first: index of the band's first pixel in these buffers */
struct camera_pass_launch segment_camera_pass(const struct band *band, const struct segment *segment,
                                              struct camera_rectangle r, uint32_t first);
int segment_trace_camera(const struct band *band, const struct segment *segment, struct camera_rectangle r,
                         uint32_t first);

/** Merge the clears of the whole picture that the first segment begins with into one. @return number of these clears */
uint32_t segment_whole_clear(const struct frame *frame, struct scene_clear *out);

/** Write one pixel, as all are after these clears, to the buffer `cleared`. */
int segment_clear_one(const struct frame *frame);

/** The same once per frame, if its other bands need nothing else there. */
int segment_clear_first(const struct band *band);

/** Set the buffer `drawn` for all pixels of the band: 1 if they are in the frame; 0 if they are as in `cleared` until
 * drawn to. */
int segment_say_drawn(const struct band *band, int drawn);

/**
 * Set all pixels to their initial value. Uncleared pixels are 0, including their depth. If the first segment begins
 * with clears of the whole picture, as in most frames, these are done here.
 * @param n_done  receives the number of its clears that are done
 */
int segment_clear_all(struct band *band, uint32_t *n_done);

/** Run a segment's clears. @param n_cleared number of its clears that are already done */
int segment_clear(struct band *band, const struct segment *segment, uint32_t n_cleared);

/** Clear and draw a segment. @param n_cleared as in segment_clear */
int segment_run(struct band *band, const struct segment *segment, uint32_t n_cleared);

/** Merge the samples of all pixels into the frame. */
int segment_merge_samples(const struct band *band);
