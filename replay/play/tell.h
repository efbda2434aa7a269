/* Who is told how far a replay has come that leads to a frame. */
#pragma once

#include <stdint.h>

/**
 * @param frame   the one that is wanted
 * @param played  so many of the frames before it, of `of`
 * @param why     whose pixels frames need, so that those before them are drawn, too; NULL: frames before this one are
 * skipped
 */
typedef void replay_tell(void *user, uint64_t frame, uint64_t played, uint64_t of, const char *why);
