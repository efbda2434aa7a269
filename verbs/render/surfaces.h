/* relume look --sheet: a page that shows a frame whose surfaces can be pointed at, its textures and meshes, and a rule
 * for each. */
#pragma once

#include "verbs/render/single.h"

/**
 * Write the page, a self-contained file.
 * @param single  rendered with channel id
 * @param trace   the recording's name
 * @return 0 or ERR_SYSTEM (reported)
 */
int surfaces_write(const struct single *single, const char *trace, const char *path);

extern const char surfaces_page[]; /* surfaces.html, generated */
