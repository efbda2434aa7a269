/* Callback that reports the progress of a replay towards a frame. */
#pragma once

#include <stdint.h>

/**
 * @param frame   the wanted frame
 * @param played  number of earlier frames played so far, out of `of`
 * @param why     which pixels are needed, so that earlier frames are drawn as well; NULL: earlier frames are skipped
 */
typedef void replay_tell(void *user, uint64_t frame, uint64_t played, uint64_t of, const char *why);
