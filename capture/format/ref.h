/*
 * Reference frames: the recorded program's own pictures, read back just before each frame's end.
 *
 * File NAME.ref beside NAME.trace, little-endian:
 *   magic   8 bytes "RELREF2\n"; "RELREF1\n" where no record has REF_CHANGED
 *   record* u32 kind, u32 width, u32 height, u64 frame, u64 packed_bytes, then packed_bytes of one raw Snappy block
 * kind 1: colour, RGBA, 8 bits each; the mean of a pixel's samples, as the window shows it.
 * kind 2: window depth, one float each, [0,1]; with several samples what glReadPixels gives.
 * If kind has REF_CHANGED, packed_bytes begin with u64 base: the offset of an earlier record of the same kind and size.
 * The block then holds the differences: pixels xor those of that record, first the lowest bytes of all of them, then
 * the next ones, four times.
 * Rows run from the bottom row up, as GL delivers them, without padding. A frame's records follow each other. Frames
 * ascend, except for those that several threads ended at the same time. A file cut at any byte is valid up to the last
 * whole record.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#define REF_MAGIC "RELREF2\n"
#define REF_MAGIC_WHOLE "RELREF1\n"
#define REF_MAGIC_BYTES 8
#define REF_CHANGED 0x100u   /* added to a record's kind */
#define REF_MOST_CHANGED 15u /* most records in a chain of differences, after a whole one */

enum ref_kind { REF_COLOR = 1, REF_DEPTH = 2 };

/** The head of a record, as in the file. */
struct __attribute__((packed)) ref_head {
	uint32_t kind, width, height;
	uint64_t frame, packed_bytes;
};
_Static_assert(sizeof(struct ref_head) == 28 && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the file's layout");

struct ref_entry {
	enum ref_kind kind;
	uint32_t width, height;
	uint64_t frame;
	uint64_t offset, packed_bytes; /* the block that follows the head in the file */
	int is_changed;                /* 1: REF_CHANGED */
};

struct ref_file {
	void *stream; /* private */
	char *path;
	struct ref_entry *entries; /* all whole records, by frames */
	size_t n_entries;
	int is_cut;                /* 1: the file ends within a record; frames after the last entry's are lost */
};

/** 1 if a file with these first bytes holds reference frames. @param head  [REF_MAGIC_BYTES] */
int ref_begins(const void *head);

/** Name the reference file beside a trace: NAME.ref for NAME.trace. @return 0, or ERR_USAGE (reported: the name is too
 * long) */
int ref_beside(const char *trace, char *out, size_t size);

/**
 * Open a reference file and list its records (pixels are not read yet). A file that ends within a record gives the
 * records before it, and a warning.
 * @param ref  all zero; filled on success; close with ref_close
 * @return 0, ERR_INPUT (reported: missing, unreadable, or not such a file) or ERR_SYSTEM (reported)
 */
int ref_open(struct ref_file *ref, const char *path);
void ref_close(struct ref_file *ref);

/** The record of a frame, or NULL. */
const struct ref_entry *ref_find(const struct ref_file *ref, enum ref_kind kind, uint64_t frame);

/**
 * Read one record's pixels. Several threads may do so at once.
 * @param out  receives a buffer of width * height * 4 bytes (RGBA8, or float), bottom row first; caller frees with
 * free()
 * @return 0, ERR_INPUT (reported: the block does not decode to that size) or ERR_SYSTEM (reported: it cannot be read,
 * or memory is short)
 */
int ref_read(const struct ref_file *ref, const struct ref_entry *entry, void **out);

/**
 * Write the records of some frames into a new file, numbered from 0. The file appears when it is whole.
 * @return 0, ERR_INPUT (reported) or ERR_SYSTEM (reported)
 */
int ref_copy(struct ref_file *ref, uint64_t first, uint64_t last, const char *path);
