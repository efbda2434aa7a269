/* Drops degenerate and duplicate triangles. All functions return 0 or ERR_SYSTEM (reported). */
#pragma once

#include <stdint.h>

struct shape;

/** Drop triangles with fewer than three distinct places, and all but the first of those with the same three places and
 * the same winding. */
int doubles_drop(struct shape *s);

/** Drop triangles narrower than the tolerance: their corners then lie on their neighbours' edges. */
int doubles_drop_narrow(struct shape *s);

/**
 * From two triangles back to back, drop the one that its neighbours do not need, if they continue only one of them.
 * Both sides of a thin sheet stay.
 */
int doubles_drop_backs(struct shape *s);

/** Find all but the first of triangles back to back. marks: receives [n_faces], 1 for each found; to be freed in any
 * case */
int doubles_find_backs(const struct shape *s, uint8_t **marks);
