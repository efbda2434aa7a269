/* How the process gets its memory from the system. */
#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H

/**
 * Let malloc take from large pages (transparent huge pages, where the system offers them by request), and keep what it was given:
 * a replay fills tens of MiB once, and a fault for each 4 KiB is a sixth of its time. Called once, before other threads are.
 * What cannot be had is done without.
 */
void memory_use_large_pages(void);

#endif
