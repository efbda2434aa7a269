/* Writers: finished pictures become files. */
#pragma once

#include "verbs/render/pipeline_state.h"

/** A writer's thread: takes pictures until there are none. @param state  the struct pipeline_state */
void *pipeline_write(void *state);
