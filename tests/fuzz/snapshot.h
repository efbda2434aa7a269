/*
 * A snapshot of the state machine (replay/index/snapshot.h) as one file: records with a name (16 bytes), a size (32
 * bits, low byte first) and that number of bytes. The first is the snapshot, the others are its blobs; a record whose
 * name is all 0xff holds calls (calls.h) to execute after loading.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

struct snapshot_record {
	uint64_t name[2];
	uint32_t n;
	const uint8_t *bytes;
};

#define SNAPSHOT_HEAD 20 /* size of a record's header */

/** The next record. @param data, size  advanced past it. @return 0: there is none; the last may be cut */
static inline int snapshot_record_next(const uint8_t **data, size_t *size, struct snapshot_record *out)
{
	if (*size < SNAPSHOT_HEAD)
		return 0;
	memcpy(out->name, *data, sizeof(out->name));
	memcpy(&out->n, *data + sizeof(out->name), sizeof(out->n));
	*data += SNAPSHOT_HEAD;
	*size -= SNAPSHOT_HEAD;
	out->n = out->n < *size ? out->n : (uint32_t)*size;
	out->bytes = *data;
	*data += out->n;
	*size -= out->n;
	return 1;
}
