/* The maps of evaluators (GL 2.1 sec. 5.1). */
#pragma once

struct bytes;
struct cursor;
struct gls_maps;

void gls_maps_free(struct gls_maps *maps);
/** Save a context's maps in a snapshot; NULL is allowed. */
void gls_maps_save(const struct gls_maps *maps, struct bytes *out);
/**
 * Load maps, which the caller owns. @return NULL: there are none; or in->failed is set: too few bytes, or out of memory
 */
struct gls_maps *gls_maps_load(struct cursor *in);
