/*
 * The arrays of a scene: equal values are stored once. If memory runs out the replay ends after this call (gls_fail);
 * the one place that checks is where a draw is added (frame.c).
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "base/table.h"

struct gls_exec;

/** Append `count` items to an array of n. @return 0 or ERR_SYSTEM (reported) */
int gls_append(void *array, uint32_t *n, uint32_t *room, const void *items, uint32_t count, size_t size);

/**
 * Find a value in an array, or append it. @return its index; SCENE_NONE: out of memory (reported)
 * @param t      hash -> index + 1
 * @param array  address of the pointer to the items, n of them, with room for more
 */
uint32_t gls_intern(struct gls_exec *x, struct table *t, void *array, uint32_t *n, uint32_t *room, const void *value,
                    size_t size);
/** As gls_intern, for values that must be contiguous. @return index of the first; 0 if count is 0 */
uint32_t gls_intern_array(struct gls_exec *x, struct table *t, void *array, uint32_t *n, uint32_t *room,
                          const void *values, uint32_t count, size_t size);
