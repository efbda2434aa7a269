/* Unpacks the containers of traces: Snappy chunks, gzip and Brotli. */
#include "replay/trace/container.h"

#include <brotli/decode.h>
#include <errno.h>
#include <snappy-c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <zlib.h>

#include "base/err.h"
#include "base/hash.h"
#include "base/memory.h"

#define PIECE_BYTES (1u << 20)
#define READ_BYTES (64u << 10) /* minimum size of a read from the file */
#define SMALL_BYTES (64u << 10) /* chunks up to this unpacked size are delivered together */
#define CHUNK_MAX_BYTES (64u << 20) /* unpacked size; recorders write 1 MiB */

enum container_kind { CONTAINER_SNAPPY, CONTAINER_GZIP, CONTAINER_BROTLI };

struct container {
	char *path;
	FILE *file;
	uint64_t size, offset;
	uint64_t piece; /* offset of the first chunk in the last piece */
	enum container_kind kind;
	int cut, ended;
	int delivered; /* Brotli: some data was delivered, so the file is a trace */
	uint8_t *packed, *unpacked;
	size_t packed_room, unpacked_room;
	uint64_t behind; /* bytes of the file after the end of the trace */
	size_t at, end; /* Snappy: range of `packed` that was read and not unpacked yet */
	XXH3_state_t *hash; /* hash of all bytes read from the file; NULL: not wanted, or the file was not read in order */
	z_stream gzip;
	BrotliDecoderState *brotli;
	const uint8_t *brotli_next;
	size_t brotli_left;
};

static int reserve(uint8_t **buffer, size_t *room, size_t bytes)
{
	if (bytes <= *room)
		return 0;
	if (memory_resize(buffer, bytes, 1))
		return ERR_SYSTEM;
	*room = bytes;
	return 0;
}

/* Recognize files that are mistaken for traces. */
static const char *foreign_kind(const uint8_t *head, size_t n)
{
	static const struct {
		const char *magic;
		size_t n;
		const char *kind;
	} kinds[] = {
		{ "\x89PNG", 4, "a PNG picture" },
		{ "\xff\xd8\xff", 3, "a JPEG picture" },
		{ "\x76\x2f\x31\x01", 4, "an OpenEXR picture" },
		{ "\x7f""ELF", 4, "a program" },
		{ "#!", 2, "a script" },
		{ "PK\x03\x04", 4, "a ZIP archive" },
		{ "RELREF", 6, "a file of reference frames (the trace is beside it)" },
		{ "\x28\xb5\x2f\xfd", 4, "a trace packed with zstd, which Relume cannot read; "
		  "'apitrace repack' without options converts it" },
	};

	for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++)
		if (n >= kinds[i].n && memcmp(head, kinds[i].magic, kinds[i].n) == 0)
			return kinds[i].kind;
	return NULL;
}

/*
 * Read the file's next bytes; fewer: it ends. @return 0, or ERR_SYSTEM (reported): a failing disk is neither the end of
 * the file nor damage
 */
static int read_file(struct container *c, void *to, size_t most, size_t *n)
{
	*n = fread(to, 1, most, c->file);
	return ferror(c->file) ? err_report(ERR_SYSTEM, c->path, "cannot be read: %s", strerror(errno)) : 0;
}

static int detect(struct container *c)
{
	uint8_t head[16];
	const char *foreign;
	size_t n;

	if (read_file(c, head, sizeof(head), &n))
		return ERR_SYSTEM;
	foreign = foreign_kind(head, n);
	if (n == 0)
		return err_report(ERR_INPUT, c->path, "the file is empty; nothing was recorded into it");
	if (foreign)
		return err_report(ERR_INPUT, c->path, "not a trace but %s", foreign);
	rewind(c->file);
	if (n >= 2 && head[0] == 'a' && head[1] == 't') {
		c->kind = CONTAINER_SNAPPY;
		c->offset = 2;
		return fseek(c->file, 2, SEEK_SET) ? err_report(ERR_SYSTEM, c->path, "%s", strerror(errno)) : 0;
	}
	if (reserve(&c->packed, &c->packed_room, PIECE_BYTES) || reserve(&c->unpacked, &c->unpacked_room, PIECE_BYTES))
		return ERR_SYSTEM;
	if (n >= 2 && head[0] == 0x1f && head[1] == 0x8b) {
		c->kind = CONTAINER_GZIP;
		if (inflateInit2(&c->gzip, 15 + 16) != Z_OK)
			return err_report(ERR_SYSTEM, c->path, "out of memory");
		return 0;
	}
	c->kind = CONTAINER_BROTLI; /* Brotli has no magic number: it is assumed for everything else */
	c->brotli = BrotliDecoderCreateInstance(NULL, NULL, NULL);
	return c->brotli ? 0 : err_report(ERR_SYSTEM, c->path, "out of memory");
}

int container_open(struct container **out, const char *path)
{
	struct container *c = calloc(1, sizeof(*c));
	struct stat info;
	int rc = ERR_SYSTEM;

	*out = NULL;
	if (!c || !(c->path = strdup(path))) {
		err_report(ERR_SYSTEM, path, "out of memory");
		goto fail;
	}
	c->file = fopen(path, "rb");
	if (!c->file || fstat(fileno(c->file), &info)) {
		rc = err_report(ERR_INPUT, path, "cannot be read: %s", strerror(errno));
		goto fail;
	}
	if (!S_ISREG(info.st_mode)) {
		rc = err_report(ERR_INPUT, path, S_ISDIR(info.st_mode) ? "is a folder, not a trace"
		                                                       : "is not a plain file");
		goto fail;
	}
	setvbuf(c->file, NULL, _IONBF, 0); /* reads are large anyway */
	c->size = (uint64_t)info.st_size;
	rc = detect(c);
	if (rc)
		goto fail;
	*out = c;
	return 0;
fail:
	container_close(&c);
	return rc;
}

void container_close(struct container **c)
{
	if (!*c)
		return;
	if ((*c)->file)
		fclose((*c)->file);
	if ((*c)->kind == CONTAINER_GZIP)
		inflateEnd(&(*c)->gzip);
	if ((*c)->brotli)
		BrotliDecoderDestroyInstance((*c)->brotli);
	XXH3_freeState((*c)->hash);
	free((*c)->packed);
	free((*c)->unpacked);
	free((*c)->path);
	free(*c);
	*c = NULL;
}

/*
 * Unpack a truncated raw Snappy block as far as it goes (format_description.txt of Snappy: tags, literals, copies).
 * Snappy's own decoder unpacks complete blocks only.
 */
static size_t unpack_cut_block(const uint8_t *in, size_t n, uint8_t *out, size_t room)
{
	size_t at = 0, made = 0;

	while (at < n && in[at++] & 0x80) /* the unpacked size, LEB128 */
		;
	while (at < n) {
		unsigned tag = in[at++], kind = tag & 3;
		size_t length, distance, extra;

		if (kind == 0) {
			length = (tag >> 2) + 1;
			extra = length > 60 ? length - 60 : 0;
			if (extra > n - at)
				break;
			if (extra) {
				length = 0;
				for (size_t i = 0; i < extra; i++)
					length |= (size_t)in[at + i] << (8 * i);
				length++;
			}
			at += extra;
			if (length > n - at)
				length = n - at;
			if (length > room - made)
				break;
			memcpy(out + made, in + at, length);
			at += length;
			made += length;
			continue;
		}
		extra = kind == 3 ? 4 : kind;
		if (extra > n - at)
			break;
		length = kind == 1 ? ((tag >> 2) & 7) + 4 : (tag >> 2) + 1;
		distance = kind == 1 ? (size_t)(tag >> 5) << 8 : 0;
		for (size_t i = 0; i < extra; i++)
			distance |= (size_t)in[at + i] << (8 * i);
		at += extra;
		if (distance == 0 || distance > made || length > room - made)
			break;
		for (size_t i = 0; i < length; i++, made++)
			out[made] = out[made - distance];
	}
	return made;
}

/*
 * Make n bytes of the file available at packed + at. @return n, or fewer if the file ends; 0 with *rc set: ERR_SYSTEM
 * (reported)
 */
static size_t have(struct container *c, size_t n, int *rc)
{
	size_t left = c->end - c->at, got;

	if (left >= n)
		return n;
	*rc = reserve(&c->packed, &c->packed_room, n > READ_BYTES ? n : READ_BYTES);
	if (*rc)
		return 0;
	memmove(c->packed, c->packed + c->at, left);
	c->at = 0;
	*rc = read_file(c, c->packed + left, c->packed_room - left, &got);
	c->end = left + got;
	if (*rc)
		return 0;
	if (c->hash)
		XXH3_128bits_update(c->hash, c->packed + left, got);
	return c->end < n ? c->end : n;
}

/* Does another trace begin here instead of a chunk? Checks for the magic number and a chunk. *rc as of have() */
static int begins_trace(struct container *c, int *rc)
{
	const size_t got = have(c, 11, rc); /* a 32-bit varint takes five */
	const uint8_t *p = c->packed + c->at;
	size_t unpacked;

	return got == 11 && p[0] == 'a' && p[1] == 't' &&
		(p[2] | (size_t)p[3] << 8 | (size_t)p[4] << 16 | (size_t)p[5] << 24) <= c->size - c->offset - 6 &&
		snappy_uncompressed_length((const char *)p + 6, 5, &unpacked) == SNAPPY_OK && unpacked <= CHUNK_MAX_BYTES;
}

/*
 * Unpack the chunk at c->offset, and append it to what is unpacked already.
 * @param made  number of bytes unpacked; increased
 * @param why   receives what is wrong with the chunk
 * @return 1; 0 there is none; ERR_INPUT (not reported: nothing was read); ERR_SYSTEM
 */
static int add_chunk(struct container *c, size_t *made, const char **why)
{
	int rc = 0;
	size_t length, unpacked, got = have(c, 4, &rc);
	const uint8_t *head = c->packed + c->at;
	const char *packed;

	if (got < 4) {
		c->cut = got > 0;
		return rc;
	}
	length = head[0] | (size_t)head[1] << 8 | (size_t)head[2] << 16 | (size_t)head[3] << 24;
	if (length == 0)
		return 0;
	if (length > c->size - c->offset - 4 && begins_trace(c, &rc)) {
		c->behind = c->size - c->offset;
		return rc;
	}
	if (length > c->size - c->offset - 4) {
		c->cut = 1;
		length = c->size - c->offset - 4;
	}
	got = have(c, 4 + length, &rc);
	if (rc)
		return rc;
	length = got - 4;
	packed = (const char *)c->packed + c->at + 4;
	*why = "not a Snappy chunk";
	if (snappy_uncompressed_length(packed, length, &unpacked) != SNAPPY_OK)
		return c->cut ? 0 : ERR_INPUT;
	*why = "a Snappy chunk with an impossible size";
	if (unpacked > CHUNK_MAX_BYTES)
		return ERR_INPUT;
	if (reserve(&c->unpacked, &c->unpacked_room, *made + unpacked + 1))
		return ERR_SYSTEM;
	*why = "a Snappy chunk that cannot be unpacked";
	if (c->cut)
		unpacked = unpack_cut_block((const uint8_t *)packed, length, c->unpacked + *made, unpacked);
	else if (snappy_uncompress(packed, length, (char *)c->unpacked + *made, &unpacked) != SNAPPY_OK)
		return ERR_INPUT;
	c->offset += got;
	c->at += got;
	*made += unpacked;
	return 1;
}

/* Join chunks to pieces of a reasonable size: our recorder ends a chunk with each frame, and many frames are short. */
static int next_snappy(struct container *c, const uint8_t **data, size_t *size)
{
	const char *why = "";
	size_t made = 0;
	int rc, failed = 0;

	c->piece = c->offset;
	do
		rc = add_chunk(c, &made, &why);
	while (rc == 1 && made < SMALL_BYTES && !c->cut);
	*data = c->unpacked;
	*size = made;
	if (rc == ERR_INPUT && made) /* deliver the data before the damage; the next call reports it */
		return 1;
	c->ended = rc <= 0 || c->cut;
	if (rc == ERR_INPUT && begins_trace(c, &failed)) {
		c->behind = c->size - c->offset;
		return 0;
	}
	if (failed)
		return failed;
	if (rc == ERR_INPUT)
		return err_report(ERR_INPUT, c->path, "damaged at byte %llu: %s", (unsigned long long)c->offset, why);
	return rc < 0 ? rc : made > 0;
}

/* Refill a stream decoder's input. @return 0, or ERR_SYSTEM (reported) */
static int read_packed(struct container *c, size_t *got)
{
	const int rc = read_file(c, c->packed, PIECE_BYTES, got);

	c->offset += *got;
	c->cut = !*got;
	return rc;
}

static int next_gzip(struct container *c, const uint8_t **data, size_t *size)
{
	z_stream *z = &c->gzip;
	int rc = Z_OK;

	z->next_out = c->unpacked;
	z->avail_out = PIECE_BYTES;
	while (z->avail_out && rc != Z_STREAM_END) {
		if (z->avail_in == 0) {
			size_t got;

			if (read_packed(c, &got))
				return ERR_SYSTEM;
			if (c->cut)
				break;
			z->next_in = c->packed;
			z->avail_in = (uInt)got;
		}
		rc = inflate(z, Z_NO_FLUSH);
		if (rc != Z_OK && rc != Z_STREAM_END && z->avail_out < PIECE_BYTES)
			break; /* deliver the data before the damage; the next call reports it */
		if (rc != Z_OK && rc != Z_STREAM_END)
			return err_report(ERR_INPUT, c->path, "damaged before byte %llu: the gzip stream cannot be unpacked (%s)",
			                  (unsigned long long)c->offset, z->msg ? z->msg : "no reason given");
	}
	c->ended = rc == Z_STREAM_END || c->cut;
	c->behind = rc == Z_STREAM_END ? z->avail_in + (c->size - c->offset) : 0;
	*data = c->unpacked;
	*size = PIECE_BYTES - z->avail_out;
	return *size > 0;
}

static int next_brotli(struct container *c, const uint8_t **data, size_t *size)
{
	uint8_t *out = c->unpacked;
	size_t room = PIECE_BYTES;
	BrotliDecoderResult rc = BROTLI_DECODER_RESULT_NEEDS_MORE_INPUT;

	while (room && rc != BROTLI_DECODER_RESULT_SUCCESS) {
		if (c->brotli_left == 0 && rc == BROTLI_DECODER_RESULT_NEEDS_MORE_INPUT &&
		    !BrotliDecoderHasMoreOutput(c->brotli)) {
			c->brotli_next = c->packed;
			if (read_packed(c, &c->brotli_left))
				return ERR_SYSTEM;
			if (c->cut)
				break;
		}
		rc = BrotliDecoderDecompressStream(c->brotli, &c->brotli_left, &c->brotli_next, &room, &out, NULL);
		if (rc == BROTLI_DECODER_RESULT_ERROR && room < PIECE_BYTES)
			break; /* as with gzip */
		if (rc == BROTLI_DECODER_RESULT_ERROR && c->delivered)
			return err_report(ERR_INPUT, c->path, "damaged before byte %llu: the Brotli stream cannot be unpacked",
			                  (unsigned long long)c->offset);
		if (rc == BROTLI_DECODER_RESULT_ERROR)
			return err_report(ERR_INPUT, c->path, "not a trace: neither Snappy chunks nor gzip, and no Brotli stream "
			                  "before byte %llu", (unsigned long long)c->offset);
	}
	c->ended = rc == BROTLI_DECODER_RESULT_SUCCESS || c->cut;
	c->behind = rc == BROTLI_DECODER_RESULT_SUCCESS ? c->brotli_left + (c->size - c->offset) : 0;
	*data = c->unpacked;
	*size = PIECE_BYTES - room;
	c->delivered |= *size > 0;
	return *size > 0;
}

int container_next(struct container *c, const uint8_t **data, size_t *size)
{
	if (c->ended)
		return 0;
	switch (c->kind) {
	case CONTAINER_SNAPPY: return next_snappy(c, data, size);
	case CONTAINER_GZIP: return next_gzip(c, data, size);
	default: return next_brotli(c, data, size);
	}
}

uint64_t container_piece(const struct container *c)
{
	return c->kind == CONTAINER_SNAPPY ? c->piece : UINT64_MAX;
}

static int restart_gzip(struct container *c)
{
	c->gzip.avail_in = 0;
	return inflateReset(&c->gzip) == Z_OK;
}

static int restart_brotli(struct container *c)
{
	BrotliDecoderDestroyInstance(c->brotli);
	c->brotli = BrotliDecoderCreateInstance(NULL, NULL, NULL);
	c->brotli_left = 0;
	return c->brotli != NULL;
}

int container_seek(struct container *c, uint64_t offset)
{
	if (offset == 0)
		offset = c->kind == CONTAINER_SNAPPY ? 2 : 0;
	XXH3_freeState(c->hash);
	c->hash = NULL;
	c->cut = c->ended = 0;
	c->behind = 0;
	c->at = c->end = 0;
	c->offset = offset;
	if (fseeko(c->file, (off_t)offset, SEEK_SET))
		return err_report(ERR_SYSTEM, c->path, "%s", strerror(errno));
	if ((c->kind == CONTAINER_GZIP && !restart_gzip(c)) || (c->kind == CONTAINER_BROTLI && !restart_brotli(c)))
		return err_report(ERR_SYSTEM, c->path, "out of memory");
	return 0;
}

int container_hash_begin(struct container *c)
{
	if (c->kind != CONTAINER_SNAPPY || !(c->hash = XXH3_createState()))
		return 0; /* container_hash_end will read the file again */
	XXH3_128bits_reset(c->hash);
	return hash_file(c->path, c->offset + (c->end - c->at), c->hash);
}

int container_hash_end(struct container *c, uint64_t out[2])
{
	XXH128_hash_t hash;
	int rc = 0;

	if (!c->hash)
		return hash_whole(c->path, out);
	do
		c->at = c->end = 0;
	while (have(c, 1, &rc));
	hash = XXH3_128bits_digest(c->hash);
	out[0] = hash.low64;
	out[1] = hash.high64;
	c->ended = 1;
	return rc;
}

int container_is_cut(const struct container *c)
{
	return c->cut;
}

uint64_t container_behind(const struct container *c)
{
	return c->behind;
}

uint64_t container_offset(const struct container *c)
{
	return c->offset;
}

uint64_t container_size(const struct container *c)
{
	return c->size;
}
