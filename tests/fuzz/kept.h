/* The kept sequences of calls (pack_calls.py), one after the other. */
#pragma once

#include <check.h>
#include <stdio.h>

#define KEPT "tests/fuzz/kept_calls"
#define KEPT_LARGEST 65536

/** The next sequence of an open file. @param bytes  [KEPT_LARGEST]. @return 1, or 0 at the end */
static inline int kept_next(FILE *file, uint8_t *bytes, size_t *size)
{
	uint8_t head[4];

	if (fread(head, 1, 4, file) != 4)
		return 0;
	*size = head[0] | (size_t)head[1] << 8 | (size_t)head[2] << 16 | (size_t)head[3] << 24;
	ck_assert_msg(*size <= KEPT_LARGEST && fread(bytes, 1, *size, file) == *size, KEPT " is cut");
	return 1;
}
