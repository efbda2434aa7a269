/* Triangles that are none, or are there twice. All return 0 or ERR_SYSTEM (reported). */
#pragma once

#include <stdint.h>

struct shape;

/** Drop triangles of fewer than three places, and all but the first of those with the same three places in the same
 * sense. */
int doubles_drop(struct shape *s);

/** Drop triangles narrower than the tolerance: their corners come to lie on their neighbours' edges. */
int doubles_drop_narrow(struct shape *s);

/**
 * Of two triangles back to back drop the one that its neighbours do not need, where they go on with one only. Both
 * sides of a thin sheet stay.
 */
int doubles_drop_backs(struct shape *s);

/** Of triangles back to back all but the first. marks: receives [n_faces], 1 for those; to be freed in any case */
int doubles_find_backs(const struct shape *s, uint8_t **marks);
