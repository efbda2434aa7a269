/* Records of reference frames (ref.h), as the recorder and `relume trim` write them. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "capture/format/ref.h"

/** The record of a kind that was written last, which the next one may build on. All zero: there is none. */
struct ref_last {
	uint64_t at; /* of its head in the file */
	uint32_t width, height;
	uint32_t in_a_row;  /* records since one that holds its pixels whole */
	size_t whole_bytes; /* of that one's block */
};

/** The most bytes that a record of so many pixels takes. */
size_t ref_pack_room(size_t n);

/**
 * Make a record: of what has changed since the last one where that has the same size, or whole.
 * @param last    of this kind; becomes this record
 * @param head    with kind (REF_COLOR or REF_DEPTH), size and frame
 * @param at      where it will be in the file
 * @param pixels  [width * height]: RGBA, or a float each
 * @param before  the last record's pixels; read only where it has the same size
 * @param planes  room for as much as pixels
 * @param out     receives head and block; room for ref_pack_room(width * height)
 * @return its bytes; 0: no memory
 */
size_t ref_pack(struct ref_last *last, const struct ref_head *head, uint64_t at, const uint32_t *pixels, const uint32_t *before, uint8_t *planes, uint8_t *out);
