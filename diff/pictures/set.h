/*
 * A set of frames to compare: the records of a .ref file, or images on disk. Each has a frame number.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "capture/format/ref.h"
#include "tracer/image/image.h"

struct set_entry {
	uint64_t frame;
	char *path; /* owned; NULL: record of the set's .ref file */
	char *name; /* owned; of a set with names: its path within the set, without its ending. After set_match, of
	               pictures matched by it alone */
	int has_number; /* of a set with names: 1: `frame` is a number in the file's name */
};

struct set {
	char *name; /* as found: the .ref file, directory, pattern or image */
	struct set_entry *entries; /* sorted by frame, one for each */
	size_t n_entries;
	char *trace; /* the trace that named the set; NULL: none did */
	char trace_hash[33]; /* its hash_name(); "" without a trace */
	int is_single; /* one image, named as such: its frame number may be anything */
	struct ref_file ref; /* open where the set is a .ref file */
};

/**
 * Find the frames of a set.
 *
 * @param where  a .ref file; a trace (its NAME.ref is taken); a directory of images; a pattern with a frame number
 *               ("out/gears.####.exr"); or one image. In a directory the last number of a name is its frame; files
 *               whose names are not those of images are passed over. Two images of one frame are an error.
 * @param out    all zero; free with set_free
 * @return 0; ERR_INPUT (reported: missing, unreadable, or no image in it); ERR_USAGE (reported: two images of one
 *         frame); ERR_SYSTEM (reported)
 */
int set_open(const char *where, struct set *out);
void set_free(struct set *set);

/**
 * The same, for set_match: of a folder, all pictures in it and in its folders, also those without a number.
 */
int set_open_named(const char *where, struct set *out);

/** The entry of a frame, or NULL. */
const struct set_entry *set_find(const struct set *set, uint64_t frame);

/**
 * Read a frame; several threads may do so at once. A .ref file gives channels R G B (display), and gl.depth if it was
 * recorded.
 * @param img  empty; filled on success
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int set_read(const struct set *set, const struct set_entry *entry, struct image *img);

/** Read a picture of any kind, by the first bytes of its file. @return as set_read */
int set_read_picture(const char *path, struct image *img);
