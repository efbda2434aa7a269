/*
 * The moment of the recording that each picture shows: a recorded frame; for a turntable, always the same frame; or,
 * with --fps, any moment between two frames (look/between/between.h). A frame's time is then when the program
 * ended it, or, with --recorded-fps, its number divided by that rate.
 */
#pragma once

#include "base/frames.h"
#include "replay/replay.h"

struct moments {
	double fps;       /* pictures per second; 0: each picture shows a frame and has its number */
	double shutter;   /* how long it is open, as a share of the time between two pictures; 0: an instant */
	uint64_t first;   /* first frame of the recording that is used */
	uint64_t n;       /* number of frames used, from that one on */
	uint64_t first_ns; /* with fps: when the first frame ended; 0: not known */
	double *seconds;  /* with fps, [n]: when each frame ended, counted from the first one's end; owned */
	uint64_t count;   /* with fps: number of pictures */
};

/**
 * Set up pictures for --fps.
 * @param m             shutter is set
 * @param frames        a contiguous range of frames; empty: all
 * @param end           number of frames in the recording
 * @param recorded_fps  frames a second of the recording; 0: use the program's clock
 * @return 0; ERR_USAGE (reported): no contiguous range, or too many pictures; ERR_INPUT (reported): the recording has
 *         no clock, or it runs backwards; ERR_SYSTEM (reported)
 */
int moments_make(struct moments *m, struct replay *replay, const char *trace, const struct frame_list *frames,
                 uint64_t end, double fps, double recorded_fps);
void moments_free(struct moments *m);

/**
 * The moment of a picture, or one before or after it.
 * @param after  how much later, in pictures; may be negative
 * @param at     receives how far after *frame the moment is, as a share of the time to the next frame: [0,1), and 0 for
 *               the last frame
 */
void moments_at(const struct moments *m, uint64_t picture, double after, uint64_t *frame, double *at);

/** With fps: when a picture is shown, in nanoseconds, by the recorded clock of the first frame. Never 0 */
uint64_t moments_time(const struct moments *m, uint64_t picture);

/** The recorded frame that is nearest. */
uint64_t moments_nearest(const struct moments *m, uint64_t picture);
