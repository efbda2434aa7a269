/* Memory: growing arrays, and how the process gets memory from the system. */
#pragma once

#include <stddef.h>

#include "base/err.h"

/**
 * Give an array room for `n` items of `item_bytes` each.
 * @param array  address of the pointer to the items; NULL there is an empty array
 * @return 0, or ERR_SYSTEM (reported): the array is as it was
 */
int memory_resize(void *array, size_t n, size_t item_bytes);

/**
 * Make room for at least `wanted` items, and for half as many again.
 * @return the new room; if memory is short (reported), `room`, which is less than wanted: the array is as it was
 */
size_t memory_grow(void *array, size_t room, size_t wanted, size_t item_bytes);

/** memory_grow where it is needed. `room` is a variable, of any unsigned type. @return 0 or ERR_SYSTEM (reported) */
#define MEMORY_GROW(array, room, wanted) \
	((wanted) <= (room) ? 0 : ((room) = memory_grow(&(array), (room), (wanted), \
	sizeof(*(array)))) < (wanted) ? ERR_SYSTEM : 0)

/**
 * Let malloc use transparent huge pages, if the system offers them on request, and keep freed memory. A replay fills
 * tens of MiB once; a page fault for each 4 KiB would take a sixth of its time. Call once, before starting threads.
 * Does nothing if the system refuses.
 */
void memory_use_large_pages(void);

/**
 * Give the calling thread's heap room for tens of MiB: in all threads but the first, glibc asks the system for every
 * 4 KiB that the heap grows by. Call at the start of threads that allocate much in small blocks.
 */
void memory_widen_heap(void);
