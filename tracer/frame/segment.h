/*
 * Segments (tracer/frame/prepare.h): clears, camera rays, fragments gathered and shaded, per-fragment operations. Draws
 * end in the sample job->frame. Functions return 0 or ERR_SYSTEM (reported).
 */
#pragma once

#include "tracer/frame/frame.h"

/** Draw to one of the pixels' samples from now on. @param note  what the kernels are told of it (pixel_sample,
 * PIXEL_FOLLOWS) */
void segment_draw_to(struct job *job, uint32_t sample, uint32_t note);

/** The pixels of the band that lie in a scissor rectangle; and as places in the buffers of pixels. */
struct camera_rectangle segment_rectangle(const struct job *job, const int32_t scissor[4]);
struct camera_rectangle segment_in_buffers(const struct job *job, struct camera_rectangle r);

/** Make room for what the camera finds in the band: `slots` fragments a pixel. */
int segment_reserve(struct job *job, uint32_t slots);

/** What the camera is asked for of a segment: a rectangle of the band, into buffers.sparse and buffers.counts. first:
 * of the band's pixels there; and ask it */
struct camera_pass_launch segment_camera_pass(const struct job *job, const struct segment *segment,
                                              struct camera_rectangle r, uint32_t first);
int segment_trace_camera(struct job *job, const struct segment *segment, struct camera_rectangle r, uint32_t first);

/** The clears of the whole picture that the first segment begins with, as one. @return how many they are */
uint32_t segment_whole_clear(const struct job *job, struct scene_clear *out);

/** One pixel as all are after these, in buffers.cleared. */
int segment_clear_one(struct job *job);

/** Say of all pixels of the band, in buffers.drawn, whether they are in the frame (1), or as in buffers.cleared until
 * they are drawn to. */
int segment_say_drawn(struct job *job, int drawn);

/**
 * What nobody cleared is 0, depth too. Where the first segment begins with clears of the whole picture, as most frames
 * do, theirs is done at once.
 * @param n_done  receives how many of its clears that are
 */
int segment_clear_all(struct job *job, uint32_t *n_done);

/** A segment's clears. @param n_cleared  how many of them are done */
int segment_clear(struct job *job, const struct segment *segment, uint32_t n_cleared);

/** Clear and draw. @param n_cleared  how many of its clears are done */
int segment_run(struct job *job, const struct segment *segment, uint32_t n_cleared);

/** The samples of all pixels into the frame. */
int segment_merge_samples(struct job *job);

/** The pixels of this pass to those of the passes before. @param first  1: there are none */
int segment_add_pass(struct job *job, uint32_t first);
