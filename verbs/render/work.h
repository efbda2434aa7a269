/* Workers: each makes pictures of scenes with a tracer of its own. */
#pragma once

#include "verbs/render/pipeline_state.h"

/** Start another worker where pictures would wait for one. @return 0 or ERR_SYSTEM (reported): there is none at all */
int pipeline_call_worker(struct pipeline_state *state);
