/*
 * Runs inside the traced program. Asking the kernel which pages the program has written since we last asked, so that an array
 * on other pages need not be read.
 *
 * Linux can tell from 6.7 on: it write-protects pages and undoes that by itself at the first store (userfaultfd's
 * UFFD_FEATURE_WP_ASYNC: no signal, no handler, nothing the program could see but in /proc/self/maps). The PAGEMAP_SCAN ioctl
 * lists the pages that are protected no longer. Elsewhere, or where a sandbox forbids it, nothing can be watched.
 *
 * Only private memory that is there is watched. Stores by the kernel count like the program's own. What a device writes into
 * pages that it got before they were watched does not.
 */
#pragma once

#include <stdint.h>

/** Whole pages. All zero: none. */
struct watch {
	uintptr_t first, end;
};

/**
 * Watch the whole pages in [from, end), those that no other watch has; on success they count as unwritten from now on, so
 * compare them after this.
 * @return 1; 0 where they cannot be watched, with nothing changed
 */
int watch_begin(struct watch *w, const void *from, const void *end);

/**
 * The pages of [from, end), which lies in `w`, that may have been written since they last counted as unwritten. They count as
 * unwritten again: compare all of each.
 * @param written  room for `max` pieces of [from, end), ascending
 * @return how many there are; -1 where it is not known (the memory was mapped anew, the program closed our descriptors): end the watch
 */
int watch_take_written(const struct watch *w, uintptr_t from, uintptr_t end, struct watch *written, int max);

void watch_end(struct watch *w);
