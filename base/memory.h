/* How the process gets its memory from the system. */
#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H

/**
 * Let malloc use transparent huge pages, where the system offers them on request, and keep freed memory. A replay fills tens of
 * MiB once; a page fault for each 4 KiB is a sixth of its time. Call once, before starting threads. Does nothing where the
 * system refuses.
 */
void memory_use_large_pages(void);

#endif
