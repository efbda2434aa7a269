/* Chooses the pictures a second of a film, unless the user does. */
#pragma once

#include "base/frames.h"
#include "diff/pictures/set.h"

enum { RATE_FPS = 30, RATE_FAST_FPS = 60 };

/** When the program showed a frame; 0: not in its file. */
uint64_t rate_time_ns(const struct image *img);

/**
 * RATE_FAST_FPS if the program mostly showed more than 45 frames a second, judged by a few from all over, else
 * RATE_FPS.
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported)
 */
int rate_choose(struct set *frames, const struct frame_list *wanted, unsigned *fps);
