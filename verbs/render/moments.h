/*
 * The moment of the recording that each picture shows: a recorded frame, a turntable's one frame, or, with a rate of
 * their own (--fps), any moment between two frames (look/between/between.h). Time is then the program's clock when it
 * ended frames, or, with --recorded-fps, their number.
 */
#pragma once

#include "base/frames.h"
#include "replay/replay.h"

struct moments {
	double fps;       /* pictures per second; 0: each picture shows a frame and has its number */
	double shutter;   /* how long it is open, as a share of the time from one picture to the next; 0: an instant */
	uint64_t first;   /* frame of the recording */
	uint64_t n;       /* number of frames from there on; no others are used */
	uint64_t first_ns; /* with fps: when the first ended; 0: not known */
	double *seconds;  /* with fps, [n]: when frames ended, from 0 on; owned */
	uint64_t count;   /* with fps: pictures */
};

/**
 * Pictures at a rate of their own.
 * @param m             shutter is there
 * @param frames        a contiguous range of frames; empty: all
 * @param end           frames that the recording has
 * @param recorded_fps  0: the clock counts
 * @return 0; ERR_USAGE (reported): no contiguous range, or too many pictures; ERR_INPUT (reported): the recording has
 *         no clock, or it runs backwards; ERR_SYSTEM (reported)
 */
int moments_make(struct moments *m, struct replay *replay, const char *trace, const struct frame_list *frames,
                 uint64_t end, double fps, double recorded_fps);
void moments_free(struct moments *m);

/**
 * The moment of a picture, or one before or after it.
 * @param after  share of the time from a picture to the next, from then on
 * @param at     [0,1), how far after *frame; 0 if that is the last one
 */
void moments_at(const struct moments *m, uint64_t picture, double after, uint64_t *frame, double *at);

/** With fps: when a picture is shown, in nanoseconds, by the recorded clock of the first frame. Never 0 */
uint64_t moments_time(const struct moments *m, uint64_t picture);

/** The recorded frame that is nearest. */
uint64_t moments_nearest(const struct moments *m, uint64_t picture);
