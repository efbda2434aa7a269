/* Pictures in a snapshot: what drawables and renderbuffers hold, each of its planes a blob. */
#pragma once

#include "replay/index/snapshot_parts.h"

/** picture: NULL where there is none */
void snapshot_put_picture(struct saver *s, const struct gls_picture *picture);

/** @return a reference, or NULL: there is none, or the loader is bad */
struct gls_picture *snapshot_get_picture(struct loader *l);
