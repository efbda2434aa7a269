/* Pictures in a snapshot: the contents of drawables and renderbuffers, one blob for each plane. */
#pragma once

#include "replay/index/snapshot_parts.h"

/** picture: NULL if there is none */
void snapshot_put_picture(struct saver *s, const struct gls_picture *picture);

/** @return a reference, or NULL: there is none, or the loader is bad */
struct gls_picture *snapshot_get_picture(struct loader *l);
