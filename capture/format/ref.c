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

enum { MAGIC_BYTES = 8, HEADER_BYTES = 28, MAX_SIDE = 65536 };

static uint64_t get_le(const uint8_t *p, unsigned n)
{
	uint64_t v = 0;

	while (n--)
		v = v << 8 | p[n];
	return v;
}

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
	uint8_t header[HEADER_BYTES];
	int rc;

	while (file_bytes - at >= HEADER_BYTES) {
		struct ref_entry entry;

		if (fseeko(ref->stream, (off_t)at, SEEK_SET) || fread(header, sizeof(header), 1, ref->stream) != 1)
			return err_report(ERR_INPUT, ref->path, "cannot read: %s", strerror(errno));
		entry.kind = (enum ref_kind)get_le(header, 4);
		entry.width = (uint32_t)get_le(header + 4, 4);
		entry.height = (uint32_t)get_le(header + 8, 4);
		entry.frame = get_le(header + 12, 8);
		entry.packed_bytes = get_le(header + 20, 8);
		at += HEADER_BYTES;
		entry.offset = at;
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

int ref_read(const struct ref_file *ref, const struct ref_entry *entry, void **out)
{
	size_t bytes = (size_t)entry->width * entry->height * 4, unpacked = 0;
	char *packed = NULL, *pixels = NULL;
	int rc;

	packed = malloc(entry->packed_bytes ? entry->packed_bytes : 1);
	if (!packed) {
		rc = err_report(ERR_SYSTEM, ref->path, "out of memory");
		goto fail;
	}
	if (!read_at(fileno(ref->stream), entry->offset, packed, entry->packed_bytes) ||
	    snappy_uncompressed_length(packed, entry->packed_bytes, &unpacked) != SNAPPY_OK || unpacked != bytes) {
		rc = err_report(ERR_INPUT, ref->path, "the reference of frame %llu is damaged",
		                (unsigned long long)entry->frame);
		goto fail;
	}
	pixels = malloc(bytes);
	if (!pixels) {
		rc = err_report(ERR_SYSTEM, ref->path, "out of memory");
		goto fail;
	}
	if (snappy_uncompress(packed, entry->packed_bytes, pixels, &unpacked) != SNAPPY_OK) {
		rc = err_report(ERR_INPUT, ref->path, "the reference of frame %llu is damaged",
		                (unsigned long long)entry->frame);
		goto fail;
	}
	free(packed);
	*out = pixels;
	return 0;

fail:
	free(packed);
	free(pixels);
	return rc;
}

static void put_le(uint8_t *p, uint64_t v, unsigned n)
{
	for (unsigned i = 0; i < n; i++)
		p[i] = (uint8_t)(v >> (8 * i));
}

static int copy_record(struct ref_file *ref, const struct ref_entry *entry, uint64_t frame, FILE *out, const char *path)
{
	uint8_t bytes[1 << 16];
	uint64_t left = entry->packed_bytes;

	put_le(bytes, entry->kind, 4);
	put_le(bytes + 4, entry->width, 4);
	put_le(bytes + 8, entry->height, 4);
	put_le(bytes + 12, frame, 8);
	put_le(bytes + 20, left, 8);
	if (fwrite(bytes, HEADER_BYTES, 1, out) != 1)
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
