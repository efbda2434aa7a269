#include "base/memory.h"

#include <malloc.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#define LARGE_PAGE ((uintptr_t)2 << 20)
#define HEAP_BYTES (64 << 20)   /* that is asked for at once; addresses, and no memory until it is touched */
#define KEEP_BYTES (256 << 20)  /* free at the heap's end, beyond which it is given back */
#define MAPPED_BYTES (16 << 20) /* from which on a block has pages of its own */

void memory_use_large_pages(void)
{
	void *volatile block; /* so that the compiler does not see that it comes to nothing */
	uintptr_t begin = ((uintptr_t)sbrk(0) + LARGE_PAGE - 1) & ~(LARGE_PAGE - 1), end;

	mallopt(M_MMAP_THRESHOLD, MAPPED_BYTES);
	mallopt(M_TRIM_THRESHOLD, KEEP_BYTES);
	mallopt(M_TOP_PAD, HEAP_BYTES);
	block = malloc(1 << 20); /* more than there is: the heap grows */
	free(block);
	mallopt(M_TOP_PAD, (int)LARGE_PAGE);
	end = (uintptr_t)sbrk(0);
	if (end > begin)
		madvise((void *)begin, end - begin, MADV_HUGEPAGE);
}
