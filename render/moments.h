/*
 * Pictures at a rate of their own (--fps): which moment of the recording each is of. A moment is a recorded frame, or a
 * place between two (look/between/between.h). Time is the program's clock when it ended frames, or, with
 * --recorded-fps, their number.
 */
#pragma once

#include "base/frames.h"
#include "replay/replay.h"

/* All zero: there are none. */
struct moments {
	double fps;
	uint64_t first, first_ns; /* frame, and when it ended; 0: not known */
	double *seconds;  /* [n]: when it ended and those after it, from 0 on; owned */
	uint64_t n, count; /* frames; pictures */
};

/**
 * @param frames        one run of frames; empty: all
 * @param end           frames that the recording has
 * @param recorded_fps  0: the clock counts
 * @return 0; ERR_USAGE (reported): no run of frames, or too many pictures; ERR_INPUT (reported): the recording has no
 *         clock, or it runs backwards; ERR_SYSTEM (reported)
 */
int moments_make(struct moments *m, struct replay *replay, const char *trace, const struct frame_list *frames,
                 uint64_t end, double fps, double recorded_fps);
void moments_free(struct moments *m);

/** A picture's moment. @param at  [0,1), how far behind *frame; 0 where that is the last one */
void moments_at(const struct moments *m, uint64_t picture, uint64_t *frame, double *at);

/** When a picture is shown, in nanoseconds, by the recorded clock of the first frame. Never 0 */
uint64_t moments_time(const struct moments *m, uint64_t picture);

/** The recorded frame that is nearest. */
uint64_t moments_nearest(const struct moments *m, uint64_t picture);
