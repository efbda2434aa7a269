/* The thread that plays the recording and hands out pictures to render. */
#pragma once

#include "verbs/render/pipeline_state.h"

/** Hand out all pictures that the settings ask for. @return 0 or ERR_* (reported) */
int pipeline_decode(struct pipeline_state *state);
