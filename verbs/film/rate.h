/* Chooses the frame rate of a film, unless the user does. */
#pragma once

#include "base/frames.h"
#include "diff/pictures/set.h"

enum { RATE_FPS = 30, RATE_FAST_FPS = 60 };

/** When the program showed a frame (attribute relume:time); 0: its file does not say. */
uint64_t rate_time_ns(const struct image *img);

/**
 * Choose RATE_FAST_FPS if the program mostly showed more than 45 frames a second, else RATE_FPS. Only some frames,
 * spread over the film, are read.
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported)
 */
int rate_choose(struct set *frames, const struct frame_list *wanted, unsigned *fps);
