/* Draw names for callers that know nothing of replays (scene/draw_names.h). */
#pragma once

#include "scene/draw_names.h"

/** A draw_namer: replays the trace up to the last frame asked for. Problems with the trace are reported. */
void replay_name_draws(const char *trace, struct draw_name *names, size_t n);
