/*
 * The size of the memory that an argument points to: a function for each form that Khronos' registry leaves open
 * (COMPSIZE). They call no GL and use no state, so the recorder, the replay and the tests share them. A size that
 * overflows a long, or is invalid, is 0.
 */
#pragma once

#include <string.h>

/** The layout of pixels in memory (GL 2.1 sec. 3.6.1, table 3.1). GL's initial state is all zero except alignment 4. */
struct pixel_layout {
	int row_length, image_height, skip_rows, skip_pixels, skip_images, alignment;
};

/** Values of a vector parameter or query by its name (GL_POSITION: 4); 1 if the name is unknown. */
long count_of_pname(unsigned pname);

/** Bytes of one element of a type (GL_FLOAT: 4); 0: no such type. A packed pixel type counts as a whole pixel. */
long type_bytes(unsigned type);

/** Bytes of one pixel; 0 if format and type do not define it (GL_BITMAP: less than a byte). */
long image_pixel_bytes(unsigned format, unsigned type);

/** The pixels of a call. `dims` is 1 to 3; skipped rows count from 2 on, skipped images with 3. */
struct pixel_box {
	int dims;
	unsigned format, type;
	int width, height, depth;
};

/**
 * Bytes from the pointer to the end of the last pixel that GL reads.
 * @return 0 if there are no pixels, or format, type or layout are invalid
 */
long image_bytes(const struct pixel_layout *layout, const struct pixel_box *box);

/** Bytes of glCallLists' list names. */
long call_lists_bytes(int n, unsigned type);

/** Values of glClearBuffer*v for a buffer. */
long clear_buffer_count(unsigned buffer);

/** Values of one- and two-dimensional evaluator maps' control points, strides included (GL 2.1 sec. 5.1). */
long map1_count(unsigned target, int stride, int order);
long map2_count(unsigned target, int ustride, int uorder, int vstride, int vorder);

/** Bytes of a text with its length beside it. A length of 0 (marker) or below 0 (debug text) means up to the NUL. */
static inline long marker_bytes(int length, const void *text)
{
	return length > 0 || !text ? length : (long)strlen(text);
}

static inline long debug_text_bytes(int length, const void *text)
{
	return length >= 0 || !text ? length : (long)strlen(text);
}
