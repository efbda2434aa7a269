/* Counts in messages: printf("%u frame%s", n, plural(n)) prints "1 frame" and "2 frames". */
#pragma once

#include <stdint.h>

static inline const char *plural(uint64_t n)
{
	return n == 1 ? "" : "s";
}
