/* Studying a recording: it is replayed without pixels, frame by frame, into look/study; what its rules name is fetched
 * with them. */
#pragma once

#include "base/frames.h"

struct look;
struct replay;

/**
 * Study a recording, and have its rules.
 * @param frames  to be studied; evenly spread ones of these where they are too many
 * @param look    receives the rules; rules_free
 * @return 0 or ERR_* (reported)
 */
int look_study(const char *trace, const struct frame_list *frames, struct look **look);

/**
 * Fetch the scenes that rules `unseen` name; a frame that is not there is left out.
 * @param replay  with who renders for it (replay_set_supplier): without, pixels that these frames read back would be
 * missing in later ones
 * @param look    NULL: nothing to do
 * @return 0 or ERR_* (reported)
 */
int look_fetch_unseen(struct replay *replay, struct look *look);
