/*
 * Frame ranges and file name patterns, as every verb takes them.
 *
 * A range list is "1-500", "1-500x5" (every fifth), "7", "55-" (to the end), or several of these with commas. Frames
 * count from 0, in the order of the trace's frame ends. A pattern holds the frame number as "####" (zero-padded to the
 * number of #), "%04d", "$F4" ("$F" alone: no padding) or
 * "{frame}" (no padding).
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct frame_range {
	uint64_t first, last, step; /* last is included; step >= 1 */
};

struct frame_list {
	struct frame_range *ranges; /* owned; sorted by first; overlapping ones hold few enough frames to count them one
	                               by one */
	size_t n_ranges;            /* 0: every frame */
};

/**
 * Parse a range list.
 * @param text  as typed by the user
 * @param out   zero-initialised; filled on success, untouched on failure; free with frame_list_free
 * @return 0, ERR_USAGE (reported) or ERR_SYSTEM (reported)
 */
int frame_list_parse(const char *text, struct frame_list *out);

/** As frame_list_parse, for numbers of something else. @param what  for the message: "range of calls" */
int frame_list_parse_of(const char *text, const char *what, struct frame_list *out);
void frame_list_free(struct frame_list *list);

/** 1 if the list holds the frame (an empty list holds every frame), else 0. */
int frame_list_contains(const struct frame_list *list, uint64_t frame);

/** The last frame of the list; UINT64_MAX for an empty list, and for a range without an end. */
uint64_t frame_list_last(const struct frame_list *list);

/** The last frame that the recording must have; a range without an end needs its first. 0 for an empty list. */
uint64_t frame_list_needed(const struct frame_list *list);

/** Report that a recording has no such frame, and which it has. @param n  its frames @return ERR_USAGE, or ERR_INPUT if
 * it has none */
int frame_report_missing(const char *trace, uint64_t frame, uint64_t n);

/** Number of frames of the list below `end`. */
uint64_t frame_list_count(const struct frame_list *list, uint64_t end);

/** The first frame of the list at or after `from`. @return 1, or 0 if there is none */
int frame_list_next(const struct frame_list *list, uint64_t from, uint64_t *frame);

/** Parse one frame number. @return 0 or ERR_USAGE (reported) */
int frame_number_parse(const char *text, uint64_t *frame);

/** Parse "i/n", 1 <= i <= n. @return 0 or ERR_USAGE (reported) */
int frame_chunk_parse(const char *text, uint64_t *i, uint64_t *n);

/**
 * Cut the list down to its i-th part of n. Parts are runs of consecutive frames whose lengths differ by at most one;
 * each frame is in exactly one part.
 * @param end  number of frames of the recording; later ones are in no part
 * @return 0; 1 if this part holds no frame (the list is unchanged); ERR_SYSTEM (reported)
 */
int frame_list_chunk(struct frame_list *list, uint64_t end, uint64_t i, uint64_t n);

/** The part, 1 to n, that holds a frame of the list. */
uint64_t frame_list_part_of(const struct frame_list *list, uint64_t end, uint64_t frame, uint64_t n);

/** 1 if the pattern has a placeholder for the frame number. */
int frame_pattern_has_number(const char *pattern);

/** Bytes of the pattern before its placeholder; its whole length if it has none. */
size_t frame_pattern_prefix(const char *pattern);

/**
 * Put a frame number into a pattern.
 * @param out, size  receives the name, NUL-terminated
 * @return 0, or ERR_USAGE (reported) if the name does not fit
 */
int frame_pattern_expand(const char *pattern, uint64_t frame, char *out, size_t size);
