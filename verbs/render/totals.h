/* The last lines of a run: how far tracing changed OpenGL's picture, and how display pictures came out. */
#pragma once

#include "verbs/render/carried.h"
#include "verbs/render/settings.h"

/** Print them on standard error, unless --progress is json or none. */
void totals_print(const struct settings *settings, const struct carried *carried);
