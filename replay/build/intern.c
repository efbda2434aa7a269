#include "replay/build/intern.h"

#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"
#include "base/memory.h"
#include "replay/machine/errors.h"
#include "scene/scene.h"

int gls_append(void *array, uint32_t *n, uint32_t *room, const void *items, uint32_t count, size_t size)
{
	uint8_t **p = array;

	if (*n + count > *room)
		*room = (uint32_t)memory_grow(array, *room, *n + count, size);
	if (*n + count > *room)
		return ERR_SYSTEM;
	if (count)
		memcpy(*p + *n * size, items, count * size);
	*n += count;
	return 0;
}

uint32_t gls_intern(struct gls_exec *x, struct table *t, void *array, uint32_t *n, uint32_t *room, const void *value,
                    size_t size)
{
	return gls_intern_array(x, t, array, n, room, value, 1, size);
}

uint32_t gls_intern_array(struct gls_exec *x, struct table *t, void *array, uint32_t *n, uint32_t *room,
                          const void *values, uint32_t count, size_t size)
{
	uint64_t hash = XXH3_64bits_withSeed(values, count * size, count - 1);
	uint8_t **p = array;
	uintptr_t found;

	if (!count)
		return 0;
	for (; (found = (uintptr_t)table_find(t, hash)); hash++)
		if (*n - (found - 1) >= count && memcmp(*p + (found - 1) * size, values, count * size) == 0)
			return (uint32_t)(found - 1);
	found = *n;
	if (gls_append(array, n, room, values, count, size) || table_set(t, hash, (void *)(found + 1))) {
		gls_fail(x);
		return SCENE_NONE;
	}
	return (uint32_t)found;
}
