/*
 * Objects that contexts share, in a snapshot: lists, textures, buffers, programs, framebuffer objects, renderbuffers.
 */
#pragma once

#include "replay/index/snapshot_parts.h"

void snapshot_put_share(struct saver *s, const struct gls_share *share);

/** @param share  empty */
void snapshot_get_share(struct loader *l, struct gls_share *share);
