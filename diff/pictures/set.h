/* A set of frames to compare: records of a .ref file, or images on disk. Each has a frame number. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "capture/format/ref.h"
#include "tracer/image/image.h"

struct set_entry {
	uint64_t frame;
	char *path; /* owned; NULL: a record of the set's .ref file */
	char *name; /* owned; in a set with names, the path within the set, without extension. After set_match, only of
	               pictures matched by name */
	int has_number; /* in a set with names, 1: `frame` comes from the file's name */
};

struct set {
	char *name; /* the .ref file, folder, pattern or image that was opened */
	struct set_entry *entries; /* sorted by frame, one for each */
	size_t n_entries;
	char *trace; /* the trace that led to the set; NULL: none */
	char trace_hash[33]; /* hash_name() of the trace; "" without a trace */
	int is_single; /* 1: a single image, given by name: its frame number may be anything */
	struct ref_file ref; /* open if the set is a .ref file */
};

/**
 * Find the frames of a set.
 *
 * @param where  a .ref file; a trace (its NAME.ref is used); a folder of images; a pattern with a frame number
 *         ("out/gears.####.exr"); or one image. In a folder, the last number in a file's name is its frame; files
 *         without an image extension are skipped. Two images with one frame are an error.
 * @param out    all zero; free with set_free
 * @return 0; ERR_INPUT (reported: missing, unreadable, or without images); ERR_USAGE (reported: two images with one
 *         frame); ERR_SYSTEM (reported)
 */
int set_open(const char *where, struct set *out);
void set_free(struct set *set);

/** As set_open, for set_match: a folder yields all pictures in it and its subfolders, with or without numbers. */
int set_open_named(const char *where, struct set *out);

/** A frame's entry, or NULL. */
const struct set_entry *set_find(const struct set *set, uint64_t frame);

/**
 * Read a frame; may be called from several threads at once. A .ref file gives channels R G B (display), and gl.depth if
 * recorded.
 * @param img  empty; filled on success
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int set_read(const struct set *set, const struct set_entry *entry, struct image *img);

/** Read a picture of any format, recognized by its first bytes. @return as set_read */
int set_read_picture(const char *path, struct image *img);
