#ifndef REPLAY_GL_GEOMETRY_EVAL_H
#define REPLAY_GL_GEOMETRY_EVAL_H

struct bytes;
struct cursor;
struct gls_maps;

void gls_maps_free(struct gls_maps *maps);
/** A context's maps in a snapshot, and out of one: NULL there is as good as here. */
void gls_maps_save(const struct gls_maps *maps, struct bytes *out);
/** @return NULL: there are none, or in->failed: no such bytes, or no memory for them. The caller owns it. */
struct gls_maps *gls_maps_load(struct cursor *in);

#endif
