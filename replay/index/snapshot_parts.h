/*
 * Shared by the parts of a snapshot (snapshot.c, _state, _objects, _lists). Each part saves and loads in the same
 * order. layout.txt lists how each pointer is treated.
 */
#pragma once

#include "capture/format/call.h"
#include "replay/build/mesh.h"
#include "replay/machine/buffer.h"
#include "replay/gl/geometry/list.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/texture/texture.h"
#include "replay/index/snapshot.h"
#include "replay/glsl/object.h"
#include "replay/programs/program.h"

/* ---- saving ---- */

struct saver {
	struct gls_exec *x;
	const struct snapshot_blobs *blobs;
	struct bytes *out;
	uint64_t held; /* total size of blobs so far */
	int has_pixels; /* snapshot_save_pixels */
	int err;
	size_t wanted; /* for snapshot_place: position of the byte that it describes; SIZE_MAX: none */
	char place[96];
};

/** Name the section that follows, so that snapshot_place can describe a byte. */
void saver_section(struct saver *s, const char *what, uint64_t number);

/** Save data as a blob. */
void saver_blob(struct saver *s, const void *data, size_t n);
/** Save a blob whose name (hash_bytes) is known. */
void saver_named_blob(struct saver *s, const uint64_t name[2], const void *data, size_t n);

/* ---- loading: all data is validated ---- */

struct loader {
	struct gls_exec *x;
	const struct snapshot_blobs *blobs;
	struct cursor in;
	int has_pixels;
	int err; /* ERR_SYSTEM: no memory (reported) */
};

/** 1 if loading has failed. */
int loader_is_bad(const struct loader *l);

/** n zeroed bytes, to be freed with free(); NULL: the loader is bad, or becomes so. */
void *loader_alloc(struct loader *l, size_t n);

/** Read a count of things of at least `bytes` bytes each; fails if more than the data can hold. */
uint64_t loader_count(struct loader *l, size_t bytes);

/** @return a blob's bytes, to be freed with free(), or NULL if there are none; *n receives their number */
uint8_t *loader_blob(struct loader *l, size_t *n);

/* ---- tables, in ascending order of keys, so that equal tables are equal bytes ---- */

struct snapshot_table {
	const char *what;   /* for snapshot_place; NULL: values are not named individually */
	size_t least_bytes; /* minimum size of an entry */
	void (*put)(struct saver *s, void *value);
	void *(*get)(struct loader *l); /* NULL: the loader is bad, or there is nothing to keep */
	void (*drop)(void *value);      /* frees a value that cannot be kept */
};
void saver_table(struct saver *s, const struct table *t, const struct snapshot_table *how);
void loader_table(struct loader *l, struct table *t, const struct snapshot_table *how);

extern const struct snapshot_table snapshot_numbers; /* values are numbers, not pointers */
