/*
 * Frame ranges and file name patterns, as every verb takes them.
 *
 * A range list is "1-500", "1-500x5" (every fifth), "7", or several of these with commas. Frames count from 0, in the
 * order of the trace's frame ends.
 * A pattern holds the frame number as "####" (zero-padded to the number of #), "%04d", "$F4" ("$F" alone: no padding) or
 * "{frame}" (no padding).
 */
#ifndef BASE_FRAMES_H
#define BASE_FRAMES_H

#include <stddef.h>
#include <stdint.h>

struct frame_range {
	uint64_t first, last, step; /* last is included; step >= 1 */
};

struct frame_list {
	struct frame_range *ranges; /* owned; sorted by first */
	size_t n_ranges;            /* 0: every frame */
};

/**
 * Parse a range list.
 * @param text  as typed by the user
 * @param out   zero-initialised; filled on success, untouched on failure; free with frame_list_free
 * @return 0, ERR_USAGE (reported) or ERR_SYSTEM (reported)
 */
int frame_list_parse(const char *text, struct frame_list *out);
void frame_list_free(struct frame_list *list);

/** 1 where the list holds the frame (an empty list holds every frame), 0 otherwise. */
int frame_list_contains(const struct frame_list *list, uint64_t frame);

/** The last frame the list asks for; UINT64_MAX for an empty list. */
uint64_t frame_list_last(const struct frame_list *list);

/** How many frames below `end` the list asks for. */
uint64_t frame_list_count(const struct frame_list *list, uint64_t end);

/** The first frame from `from` on that the list asks for. @return 1, or 0 where there is none */
int frame_list_next(const struct frame_list *list, uint64_t from, uint64_t *frame);

/** Parse one frame number. @return 0 or ERR_USAGE (reported) */
int frame_number_parse(const char *text, uint64_t *frame);

/** Parse "i/n", 1 <= i <= n. @return 0 or ERR_USAGE (reported) */
int frame_chunk_parse(const char *text, uint64_t *i, uint64_t *n);

/**
 * Cut the list down to its i-th part of n: consecutive frames, parts as equal as can be, every frame in exactly one part.
 * @param end  how many frames there are; those beyond it belong to no part
 * @return 0; 1 where this part holds no frame (the list is left as it is); ERR_SYSTEM (reported)
 */
int frame_list_chunk(struct frame_list *list, uint64_t end, uint64_t i, uint64_t n);

/** 1 where the pattern holds a place for a frame number. */
int frame_pattern_has_number(const char *pattern);

/** How many bytes of the pattern stand before the frame number; all, where it holds none. */
size_t frame_pattern_prefix(const char *pattern);

/**
 * Put a frame number into a pattern.
 * @param out, size  receives the name, NUL-terminated
 * @return 0, or ERR_USAGE (reported) where the name does not fit
 */
int frame_pattern_expand(const char *pattern, uint64_t frame, char *out, size_t size);

#endif
