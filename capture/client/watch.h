/*
 * Runs inside the traced program. Asking the kernel which pages the program has written since we last asked, so that an
 * array on other pages need not be read.
 *
 * Linux supports this from 6.7 on: it write-protects pages and removes the protection at the first store (userfaultfd's
 * UFFD_FEATURE_WP_ASYNC: no signal, no handler, nothing the program could see but in /proc/self/maps). The PAGEMAP_SCAN
 * ioctl lists the pages that are no longer protected. Elsewhere, or if a sandbox forbids it, nothing can be watched.
 *
 * Only private, present memory is watched. Stores by the kernel count like the program's own. Writes by a device, to
 * pages that it got before they were watched, do not.
 */
#pragma once

#include <stdint.h>

/** Whole pages. All zero: none. */
struct watch {
	uintptr_t first, end;
};

/**
 * Watch the whole pages in [from, end), those that no other watch has; on success they count as unwritten from now on,
 * so compare them after this.
 * @return 1; 0: they cannot be watched, and nothing has changed
 */
int watch_begin(struct watch *w, const void *from, const void *end);

/**
 * The pages of [from, end), which lies in `w`, that may have been written since they last counted as unwritten. They
 * count as unwritten again: compare all of each.
 * @param written  room for `max` pieces of [from, end), ascending
 * @return their number; -1: not known (the memory was remapped, the program closed our descriptors), so end the watch
 */
int watch_take_written(const struct watch *w, uintptr_t from, uintptr_t end, struct watch *written, int max);

void watch_end(struct watch *w);
