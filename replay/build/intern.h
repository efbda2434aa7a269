/* The arrays of a scene: equal values are stored once. */
#ifndef REPLAY_BUILD_INTERN_H
#define REPLAY_BUILD_INTERN_H

#include <stddef.h>
#include <stdint.h>

#include "base/table.h"

/** Room for as many items as wanted. @return 0 or ERR_SYSTEM (reported) */
int gls_scene_room(void *array, uint32_t *room, uint32_t wanted, size_t size);
/**
 * The index of equal bytes in an array, which are appended where they are new; SCENE_NONE: out of memory.
 * @param t      hash -> index + 1
 * @param array  address of the pointer to the items, n of them, with room for more
 */
uint32_t gls_intern(struct table *t, void *array, uint32_t *n, uint32_t *room, const void *value, size_t size);
/** The same of values that must lie together. @return the first one's index; 0 where count is 0 */
uint32_t gls_intern_run(struct table *t, void *array, uint32_t *n, uint32_t *room, const void *values, uint32_t count, size_t size);

#endif
