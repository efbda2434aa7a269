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

enum { MAGIC_BYTES = 8, MAX_SIDE = 65536 };

static int add_entry(struct ref_file *ref, const struct ref_entry *entry)
{
	/* Grows at powers of two, so n_entries tells the capacity. */
	if ((ref->n_entries & (ref->n_entries - 1)) == 0) {
		if (memory_resize(&ref->entries, ref->n_entries ? ref->n_entries * 2 : 1, sizeof(*entry)))
			return ERR_SYSTEM;
	}
	ref->entries[ref->n_entries++] = *entry;
	return 0;
}

/* Reads records up to the last whole one; a cut is no error. */
static int list_records(struct ref_file *ref, uint64_t file_bytes)
{
	uint64_t at = MAGIC_BYTES;
	struct ref_head head;
	int rc;

	while (file_bytes - at >= sizeof(head)) {
		struct ref_entry entry;

		if (fseeko(ref->stream, (off_t)at, SEEK_SET) || fread(&head, sizeof(head), 1, ref->stream) != 1)
			return err_report(ERR_INPUT, ref->path, "cannot read: %s", strerror(errno));
		at += sizeof(head);
		entry = (struct ref_entry){ (enum ref_kind)head.kind, head.width, head.height, head.frame, at, head.packed_bytes };
		if ((entry.kind != REF_COLOR && entry.kind != REF_DEPTH) || !entry.width || !entry.height ||
		    entry.width > MAX_SIDE || entry.height > MAX_SIDE)
			return err_report(ERR_INPUT, ref->path, "record %zu is damaged", ref->n_entries);
		if (entry.packed_bytes > file_bytes - at)
			break;
		at += entry.packed_bytes;
		if ((rc = add_entry(ref, &entry)))
			return rc;
	}
	return 0;
}

static int compare_entries(const void *one, const void *other)
{
	const struct ref_entry *a = one, *b = other;

	return a->frame != b->frame ? (a->frame > b->frame) - (a->frame < b->frame) : (a->offset > b->offset) - (a->offset < b->offset);
}

int ref_open(struct ref_file *ref, const char *path)
{
	char magic[MAGIC_BYTES];
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
	if (fread(magic, sizeof(magic), 1, ref->stream) != 1 || memcmp(magic, REF_MAGIC, sizeof(magic)) != 0) {
		rc = err_report(ERR_INPUT, path, "not a file of reference frames");
		goto fail;
	}
	if (fseeko(ref->stream, 0, SEEK_END) || (end = ftello(ref->stream)) < 0) {
		rc = err_report(ERR_INPUT, path, "cannot read: %s", strerror(errno));
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

/** pread, whole. @return 1, or 0 where the file has less or cannot be read */
static int read_at(int fd, uint64_t offset, char *out, size_t n)
{
	while (n) {
		ssize_t got = pread(fd, out, n, (off_t)offset);

		if (got < 0 && errno == EINTR)
			continue;
		if (got <= 0)
			return 0;
		out += got;
		offset += (uint64_t)got;
		n -= (size_t)got;
	}
	return 1;
}

static int damaged(const struct ref_file *ref, const struct ref_entry *entry)
{
	return err_report(ERR_INPUT, ref->path, "the reference of frame %llu is damaged", (unsigned long long)entry->frame);
}

int ref_read(const struct ref_file *ref, const struct ref_entry *entry, void **out)
{
	size_t bytes = (size_t)entry->width * entry->height * 4, unpacked = 0;
	char *packed = malloc(entry->packed_bytes ? entry->packed_bytes : 1), *pixels = NULL;
	int rc = 0;

	if (!packed)
		rc = err_report(ERR_SYSTEM, ref->path, "out of memory");
	else if (!read_at(fileno(ref->stream), entry->offset, packed, entry->packed_bytes) ||
	         snappy_uncompressed_length(packed, entry->packed_bytes, &unpacked) != SNAPPY_OK || unpacked != bytes)
		rc = damaged(ref, entry);
	else if (!(pixels = malloc(bytes)))
		rc = err_report(ERR_SYSTEM, ref->path, "out of memory");
	else if (snappy_uncompress(packed, entry->packed_bytes, pixels, &unpacked) != SNAPPY_OK)
		rc = damaged(ref, entry);
	free(packed);
	if (rc)
		free(pixels);
	else
		*out = pixels;
	return rc;
}

static int copy_record(struct ref_file *ref, const struct ref_entry *entry, uint64_t frame, FILE *out, const char *path)
{
	struct ref_head head = { entry->kind, entry->width, entry->height, frame, entry->packed_bytes };
	uint64_t left = entry->packed_bytes;
	uint8_t bytes[1 << 16];

	if (fwrite(&head, sizeof(head), 1, out) != 1)
		return err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(errno));
	if (fseeko(ref->stream, (off_t)entry->offset, SEEK_SET))
		return err_report(ERR_INPUT, ref->path, "cannot read: %s", strerror(errno));
	while (left) {
		size_t n = left < sizeof(bytes) ? (size_t)left : sizeof(bytes);

		if (fread(bytes, 1, n, ref->stream) != n)
			return err_report(ERR_INPUT, ref->path, "cannot read: %s", strerror(errno));
		if (fwrite(bytes, 1, n, out) != n)
			return err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(errno));
		left -= n;
	}
	return 0;
}

int ref_copy(struct ref_file *ref, uint64_t first, uint64_t last, const char *path)
{
	char part[PATH_MAX];
	FILE *out;
	int rc = part_begin(path, part, sizeof(part));

	if (rc)
		return rc;
	out = fopen(part, "wb");
	if (!out || fwrite(REF_MAGIC, MAGIC_BYTES, 1, out) != 1)
		rc = err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(errno));
	for (size_t i = 0; i < ref->n_entries && !rc; i++)
		if (ref->entries[i].frame >= first && ref->entries[i].frame <= last)
			rc = copy_record(ref, &ref->entries[i], ref->entries[i].frame - first, out, path);
	if (out && fclose(out) && !rc)
		rc = err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(errno));
	if (rc)
		part_drop(part);
	return rc ? rc : part_finish(part, path);
}
