/* Studies a recording (look/study): its frames are replayed without pixels. Also fetches the scenes that rules name. */
#pragma once

#include "base/frames.h"

struct look;
struct replay;

/**
 * Study a recording, and get its rules.
 * @param frames  frames to study; of too many, an evenly spread selection
 * @param look    receives the rules; rules_free
 * @return 0 or ERR_* (reported)
 */
int look_study(const char *trace, const struct frame_list *frames, struct look **look);

/**
 * Fetch the scenes that rules `unseen` name; a frame that is not there is left out.
 * @param replay  with a supplier of pixels (replay_set_supplier); otherwise later frames lack the pixels that these
 * read back
 * @param look    NULL: nothing to do
 * @return 0 or ERR_* (reported)
 */
int look_fetch_unseen(struct replay *replay, struct look *look);
