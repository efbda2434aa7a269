#include "base/memory.h"

#include <malloc.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define LARGE_PAGE ((uintptr_t)2 << 20)
#define HEAP_BYTES (64 << 20)   /* requested at once; only addresses, until the memory is touched */
#define KEEP_BYTES (256 << 20)  /* free memory at the heap's end above which it is returned */
#define MAPPED_BYTES ((size_t)16 << 20) /* blocks of this size or more are mapped separately */

int memory_resize(void *array, size_t n, size_t item_bytes)
{
	void *items, *grown = NULL;

	memcpy(&items, array, sizeof(items));
	if (n <= SIZE_MAX / item_bytes)
		grown = realloc(items, n * item_bytes + 1);
	if (!grown)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %zu items of %zu bytes", n, item_bytes);
	memcpy(array, &grown, sizeof(grown));
	return 0;
}

size_t memory_grow(void *array, size_t room, size_t wanted, size_t item_bytes)
{
	const size_t more = wanted + wanted / 2 + 16;

	return memory_resize(array, more, item_bytes) ? room : more;
}

void memory_widen_heap(void)
{
	void *volatile blocks[2]; /* volatile, or the compiler removes malloc and free */

	for (int i = 0; i < 2; i++)
		blocks[i] = malloc(MAPPED_BYTES - ((size_t)1 << 20)); /* a larger block would be mapped separately */
	for (int i = 0; i < 2; i++)
		free(blocks[i]);
}

void memory_use_large_pages(void)
{
	void *volatile block; /* volatile, or the compiler removes malloc and free */
	uintptr_t begin = ((uintptr_t)sbrk(0) + LARGE_PAGE - 1) & ~(LARGE_PAGE - 1), end;

	mallopt(M_MMAP_THRESHOLD, (int)MAPPED_BYTES);
	mallopt(M_TRIM_THRESHOLD, KEEP_BYTES);
	mallopt(M_TOP_PAD, HEAP_BYTES);
	block = malloc(1 << 20); /* more than is available: the heap grows */
	free(block);
	mallopt(M_TOP_PAD, (int)LARGE_PAGE);
	end = (uintptr_t)sbrk(0);
	if (end > begin)
		madvise((void *)begin, end - begin, MADV_HUGEPAGE);
}
