/* Records of reference frames (ref.h), as the recorder and `relume trim` write them. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "capture/format/ref.h"

/** The record of a kind that was written last, which the next one may build on. All zero: there is none. */
struct ref_last {
	uint64_t at; /* offset of its head in the file */
	uint32_t width, height;
	uint32_t in_a_row;  /* records since the last one that is whole */
	size_t whole_bytes; /* size of that one's block */
};

/** The most bytes that a record of n pixels takes. */
size_t ref_pack_room(size_t n);

/**
 * Make a record: the differences from the last one if that has the same size, or a whole one.
 * @param last    of this kind; becomes this record
 * @param head    with kind (REF_COLOR or REF_DEPTH), size and frame
 * @param at      where it will be in the file
 * @param pixels  [width * height]: RGBA, or a float each
 * @param before  the last record's pixels; read only if it has the same size
 * @param planes  room for as much as pixels
 * @param out     receives head and block; room for ref_pack_room(width * height)
 * @return its bytes; 0: no memory
 */
size_t ref_pack(struct ref_last *last, const struct ref_head *head, uint64_t at, const uint32_t *pixels,
                const uint32_t *before, uint8_t *planes, uint8_t *out);
