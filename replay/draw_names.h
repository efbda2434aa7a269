/* Names of draws for those who know no replay (scene/draw_names.h). */
#pragma once

#include "scene/draw_names.h"

/** A draw_namer: replays the trace as far as the last frame asked for. What is wrong with the trace is reported. */
void replay_name_draws(const char *trace, struct draw_name *names, size_t n);
