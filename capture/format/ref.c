/* Reader of reference frames (ref.h): lists the records once, unpacks pixels on request. */
#include "capture/format/ref.h"

#include <errno.h>
#include <limits.h>
#include <snappy-c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/part.h"
#include "capture/format/ref_pack.h"
#include "capture/format/sidecar.h"

enum { MAX_SIDE = 65536 };

static int add_entry(struct ref_file *ref, const struct ref_entry *entry)
{
	/* The array grows at powers of two, so n_entries implies its capacity. */
	if ((ref->n_entries & (ref->n_entries - 1)) == 0) {
		if (memory_resize(&ref->entries, ref->n_entries ? ref->n_entries * 2 : 1, sizeof(*entry)))
			return ERR_SYSTEM;
	}
	ref->entries[ref->n_entries++] = *entry;
	return 0;
}

static int unreadable(const struct ref_file *ref, int code)
{
	return err_report(code, ref->path, "cannot be read: %s", strerror(errno));
}

/* Warn that a file is cut short. @param lost  the frame of the cut record, or UINT64_MAX: not known */
static void warn_cut(const struct ref_file *ref, uint64_t lost)
{
	uint64_t last = 0;

	for (size_t i = 0; i < ref->n_entries; i++)
		last = ref->entries[i].frame > last ? ref->entries[i].frame : last;
	if (!ref->n_entries)
		err_warn(ref->path, "is cut short in its first frame; record again, or copy the file again");
	else
		err_warn(ref->path, "is cut short %s frame %llu; record again, or copy the file again",
		         lost == last ? "in" : "after", (unsigned long long)last);
}

/* Reads records up to the last whole one; a truncated file is not an error. */
static int list_records(struct ref_file *ref, uint64_t file_bytes)
{
	uint64_t at = REF_MAGIC_BYTES;
	uint64_t lost = UINT64_MAX;
	struct ref_head head;
	int rc;

	while (file_bytes - at >= sizeof(head)) {
		struct ref_entry entry;

		if (fseeko(ref->stream, (off_t)at, SEEK_SET) || fread(&head, sizeof(head), 1, ref->stream) != 1)
			return unreadable(ref, ERR_INPUT);
		at += sizeof(head);
		entry = (struct ref_entry){
			(enum ref_kind)(head.kind & ~REF_CHANGED), head.width, head.height, head.frame, at, head.packed_bytes,
			(head.kind & REF_CHANGED) != 0
		};
		if ((entry.kind != REF_COLOR && entry.kind != REF_DEPTH) || !entry.width || !entry.height ||
		    entry.width > MAX_SIDE || entry.height > MAX_SIDE)
			return err_report(ERR_INPUT, ref->path, "record %zu is damaged", ref->n_entries);
		if (entry.packed_bytes > file_bytes - at) {
			lost = entry.frame;
			ref->is_cut = 1;
			break;
		}
		at += entry.packed_bytes;
		if ((rc = add_entry(ref, &entry)))
			return rc;
	}
	ref->is_cut |= at != file_bytes;
	if (ref->is_cut)
		warn_cut(ref, lost);
	return 0;
}

static int compare_entries(const void *one, const void *other)
{
	const struct ref_entry *a = one, *b = other;

	return a->frame != b->frame ? (a->frame > b->frame) - (a->frame < b->frame) :
	                              (a->offset > b->offset) - (a->offset < b->offset);
}

int ref_begins(const void *head)
{
	return memcmp(head, REF_MAGIC, REF_MAGIC_BYTES) == 0 || memcmp(head, REF_MAGIC_WHOLE, REF_MAGIC_BYTES) == 0;
}

int ref_beside(const char *trace, char *out, size_t size)
{
	return sidecar_name(out, size, trace, ".ref") ? 0 : err_report(ERR_USAGE, trace, "the name is too long");
}

int ref_open(struct ref_file *ref, const char *path)
{
	char magic[REF_MAGIC_BYTES];
	off_t end;
	int rc;

	ref->path = strdup(path);
	if (!ref->path)
		return err_report(ERR_SYSTEM, path, "out of memory");
	ref->stream = fopen(path, "rb");
	if (!ref->stream) {
		rc = err_report(ERR_INPUT, path, "cannot open: %s", strerror(errno));
		goto fail;
	}
	if (fread(magic, sizeof(magic), 1, ref->stream) != 1 || !ref_begins(magic)) {
		rc = ferror(ref->stream) ? unreadable(ref, ERR_INPUT) : err_report(ERR_INPUT, path, "not a file of reference frames");
		goto fail;
	}
	if (fseeko(ref->stream, 0, SEEK_END) || (end = ftello(ref->stream)) < 0) {
		rc = unreadable(ref, ERR_INPUT);
		goto fail;
	}
	rc = list_records(ref, (uint64_t)end);
	if (rc)
		goto fail;
	if (ref->n_entries)
		qsort(ref->entries, ref->n_entries, sizeof(*ref->entries), compare_entries);
	return 0;

fail:
	ref_close(ref);
	return rc;
}

void ref_close(struct ref_file *ref)
{
	if (ref->stream)
		fclose(ref->stream);
	free(ref->path);
	free(ref->entries);
	memset(ref, 0, sizeof(*ref));
}

const struct ref_entry *ref_find(const struct ref_file *ref, enum ref_kind kind, uint64_t frame)
{
	size_t low = 0, high = ref->n_entries;

	/* Frames ascend: find the frame's first record by bisection. */
	while (low < high) {
		size_t mid = low + (high - low) / 2;

		if (ref->entries[mid].frame < frame)
			low = mid + 1;
		else
			high = mid;
	}
	for (; low < ref->n_entries && ref->entries[low].frame == frame; low++)
		if (ref->entries[low].kind == kind)
			return &ref->entries[low];
	return NULL;
}

static int damaged(const struct ref_file *ref, const struct ref_entry *entry)
{
	return err_report(ERR_INPUT, ref->path, "the reference of frame %llu is damaged", (unsigned long long)entry->frame);
}

/* pread all of a record. @return 0, ERR_INPUT (the file is too short) or ERR_SYSTEM (the disk failed), reported */
static int read_at(const struct ref_file *ref, const struct ref_entry *entry, uint64_t offset, void *to, size_t n)
{
	char *out = to;

	while (n) {
		ssize_t got = pread(fileno(ref->stream), out, n, (off_t)offset);

		if (got < 0 && errno == EINTR)
			continue;
		if (got <= 0)
			return got ? unreadable(ref, ERR_SYSTEM) : damaged(ref, entry);
		out += got;
		offset += (uint64_t)got;
		n -= (size_t)got;
	}
	return 0;
}

/*
 * Xor a block's pixels to those in *out.
 * planes: 1: the block holds four planes of bytes. *out: if NULL, receives a buffer that the caller frees.
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported)
 */
static int add_block(const struct ref_file *ref, const struct ref_entry *entry, uint64_t offset, uint64_t packed_bytes,
                     int planes, uint32_t **out)
{
	const size_t n = (size_t)entry->width * entry->height;
	char *packed = malloc(packed_bytes ? packed_bytes : 1);
	uint8_t *bytes = NULL;
	size_t unpacked = 0;
	int rc = packed ? read_at(ref, entry, offset, packed, packed_bytes) :
	                  err_report(ERR_SYSTEM, ref->path, "out of memory");

	if (!rc && (snappy_uncompressed_length(packed, packed_bytes, &unpacked) != SNAPPY_OK || unpacked != 4 * n))
		rc = damaged(ref, entry);
	else if (!rc && (!(bytes = malloc(4 * n)) || !(*out = *out ? *out : calloc(n, sizeof(**out)))))
		rc = err_report(ERR_SYSTEM, ref->path, "out of memory");
	else if (!rc && snappy_uncompress(packed, packed_bytes, (char *)bytes, &unpacked) != SNAPPY_OK)
		rc = damaged(ref, entry);
	for (size_t i = 0; i < n && !rc; i++) {
		uint32_t whole;

		memcpy(&whole, bytes + 4 * i, sizeof(whole));
		(*out)[i] ^= planes ? bytes[i] | (uint32_t)bytes[n + i] << 8 | (uint32_t)bytes[2 * n + i] << 16 |
		                              (uint32_t)bytes[3 * n + i] << 24 :
		                      whole;
	}
	free(bytes);
	free(packed);
	return rc;
}

/* The record that a changed one builds on. @return 0, ERR_INPUT or ERR_SYSTEM (reported) */
static int find_base(const struct ref_file *ref, struct ref_entry *entry)
{
	struct ref_head head;
	uint64_t base;
	int rc = entry->packed_bytes < sizeof(base) ? damaged(ref, entry) :
	                                              read_at(ref, entry, entry->offset, &base, sizeof(base));

	if (!rc)
		rc = base >= entry->offset ? damaged(ref, entry) : read_at(ref, entry, base, &head, sizeof(head));
	if (rc)
		return rc;
	if ((head.kind & ~REF_CHANGED) != (uint32_t)entry->kind || head.width != entry->width ||
	    head.height != entry->height || head.packed_bytes > entry->offset - base)
		return damaged(ref, entry);
	entry->offset = base + sizeof(head);
	entry->packed_bytes = head.packed_bytes;
	entry->is_changed = (head.kind & REF_CHANGED) != 0;
	return 0;
}

int ref_read(const struct ref_file *ref, const struct ref_entry *entry, void **out)
{
	const size_t ahead = sizeof(uint64_t); /* bytes before a changed block */
	struct ref_entry at = *entry;
	uint32_t *pixels = NULL;
	int rc = 0;

	for (unsigned changed = 0; at.is_changed && !rc; changed++) {
		if (changed == REF_MOST_CHANGED || at.packed_bytes < ahead)
			rc = damaged(ref, entry);
		rc = rc ? rc : add_block(ref, entry, at.offset + ahead, at.packed_bytes - ahead, 1, &pixels);
		rc = rc ? rc : find_base(ref, &at);
	}
	rc = rc ? rc : add_block(ref, entry, at.offset, at.packed_bytes, 0, &pixels);
	if (rc)
		free(pixels);
	else
		*out = pixels;
	return rc;
}

/* A file that is being written. */
struct copy {
	FILE *out;
	const char *path;
	uint64_t at;
	struct ref_last last[2];
	void *before[2]; /* the last records' pixels */
};

static int copy_record(const struct ref_file *ref, const struct ref_entry *entry, uint64_t frame, struct copy *c)
{
	const struct ref_head head = { entry->kind, entry->width, entry->height, frame, 0 };
	const size_t n = (size_t)entry->width * entry->height;
	const unsigned k = entry->kind == REF_DEPTH;
	uint8_t *planes = NULL, *record = NULL;
	void *pixels = NULL;
	size_t bytes = 0;
	int rc = ref_read(ref, entry, &pixels);

	if (!rc && (!(planes = malloc(4 * n)) || !(record = malloc(ref_pack_room(n))) ||
	            !(bytes = ref_pack(&c->last[k], &head, c->at, pixels, c->before[k], planes, record))))
		rc = err_report(ERR_SYSTEM, ref->path, "out of memory");
	/* NOLINTNEXTLINE(clang-analyzer-unix.Malloc): c->before, which ref_copy frees */
	if (!rc && fwrite(record, 1, bytes, c->out) != bytes)
		rc = err_report(ERR_SYSTEM, c->path, "cannot be written: %s", strerror(errno));
	free(record);
	free(planes);
	free(c->before[k]);
	c->before[k] = pixels;
	c->at += bytes;
	return rc;
}

int ref_copy(struct ref_file *ref, uint64_t first, uint64_t last, const char *path)
{
	struct copy c = { .path = path, .at = REF_MAGIC_BYTES };
	char part[PATH_MAX];
	int rc = part_begin(path, part, sizeof(part));

	if (rc)
		return rc;
	c.out = fopen(part, "wb");
	if (!c.out || fwrite(REF_MAGIC, REF_MAGIC_BYTES, 1, c.out) != 1)
		rc = err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(errno));
	for (size_t i = 0; i < ref->n_entries && !rc; i++)
		if (ref->entries[i].frame >= first && ref->entries[i].frame <= last)
			rc = copy_record(ref, &ref->entries[i], ref->entries[i].frame - first, &c);
	if (c.out && fclose(c.out) && !rc)
		rc = err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(errno));
	free(c.before[0]);
	free(c.before[1]);
	if (rc)
		part_drop(part);
	return rc ? rc : part_finish(part, path);
}
