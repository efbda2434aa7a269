/* Growing arrays; capacity is a power of two. */
#pragma once

#include <stdio.h>
#include <stdlib.h>

/** Room for one more item after `n`; ends the program if out of memory. */
static inline void *array_grow(void *items, size_t n, size_t bytes)
{
	if (n & (n - 1))
		return items;
	items = realloc(items, (n ? 2 * n : 1) * bytes);
	if (!items) {
		fputs("rooms: out of memory\n", stderr);
		exit(1);
	}
	return items;
}

/** Append an item; changes `items` and `n`. */
#define ARRAY_PUSH(items, n, item) \
	((items) = array_grow((items), (n), sizeof(*(items))), (items)[(n)] = (item), (n)++)
