#include "verbs/film/matroska.h"

#include <string.h>

/* Elements (RFC 9559, section 5). */
enum {
	EBML = 0x1a45dfa3, DOC_TYPE = 0x4282, DOC_TYPE_VERSION = 0x4287, DOC_TYPE_READ_VERSION = 0x4285,
	SEGMENT = 0x18538067, INFO = 0x1549a966, TIMESTAMP_SCALE = 0x2ad7b1, TRACKS = 0x1654ae6b, TRACK_ENTRY = 0xae,
	TRACK_NUMBER = 0xd7, TRACK_UID = 0x73c5, TRACK_TYPE = 0x83, CODEC_ID = 0x86, VIDEO = 0xe0, PIXEL_WIDTH = 0xb0,
	PIXEL_HEIGHT = 0xba, STEREO_MODE = 0x53b8, UNCOMPRESSED_FOURCC = 0x2eb524, PROJECTION = 0x7670,
	PROJECTION_TYPE = 0x7671, PROJECTION_PRIVATE = 0x7672, CLUSTER = 0x1f43b675, TIMESTAMP = 0xe7, SIMPLE_BLOCK = 0xa3
};

#define MILLISECOND 1000000u /* the unit of times, nanoseconds */

struct bytes {
	uint8_t *at;
	size_t n;
};

static void put_number(struct bytes *b, uint64_t value, unsigned n)
{
	while (n--)
		b->at[b->n++] = (uint8_t)(value >> 8 * n);
}

static void put_id(struct bytes *b, uint32_t id)
{
	put_number(b, id, id >> 24 ? 4 : id >> 16 ? 3 : id >> 8 ? 2 : 1);
}

/* An element's head; its size takes 8 bytes. */
static void put_head(struct bytes *b, uint32_t id, uint64_t size)
{
	put_id(b, id);
	put_number(b, size | (uint64_t)1 << 56, 8);
}

static void put(struct bytes *b, uint32_t id, const void *data, size_t n)
{
	put_head(b, id, n);
	memcpy(b->at + b->n, data, n);
	b->n += n;
}

static void put_unsigned(struct bytes *b, uint32_t id, uint64_t value)
{
	put_head(b, id, 8);
	put_number(b, value, 8);
}

/* Begin an element that holds others. @return for end */
static size_t begin(struct bytes *b, uint32_t id)
{
	put_head(b, id, 0);
	return b->n;
}

static void end(struct bytes *b, size_t first)
{
	struct bytes size = { b->at, first - 8 };

	put_number(&size, (b->n - first) | (uint64_t)1 << 56, 8);
}

static void put_video(struct bytes *b, uint32_t width, uint32_t height, const struct matroska_view *view)
{
	const size_t video = begin(b, VIDEO);

	put_unsigned(b, PIXEL_WIDTH, width);
	put_unsigned(b, PIXEL_HEIGHT, height);
	if (view->stereo != MATROSKA_MONO)
		put_unsigned(b, STEREO_MODE, view->stereo);
	put(b, UNCOMPRESSED_FOURCC, "RGB\x18", 4);
	if (view->is_panorama) {
		const size_t projection = begin(b, PROJECTION);

		put_unsigned(b, PROJECTION_TYPE, 1);
		put(b, PROJECTION_PRIVATE, (const uint8_t[20]){ 0 }, 20); /* version 0, and no edge is cut off */
		end(b, projection);
	}
	end(b, video);
}

size_t matroska_begin(uint8_t out[MATROSKA_HEADER_BYTES], uint32_t width, uint32_t height,
                      const struct matroska_view *view)
{
	struct bytes b = { out, 0 };
	size_t outer = begin(&b, EBML), inner;

	put(&b, DOC_TYPE, "matroska", 8);
	put_unsigned(&b, DOC_TYPE_VERSION, 4);
	put_unsigned(&b, DOC_TYPE_READ_VERSION, 2);
	end(&b, outer);
	put_head(&b, SEGMENT, ((uint64_t)1 << 56) - 1); /* up to the stream's end */
	outer = begin(&b, INFO);
	put_unsigned(&b, TIMESTAMP_SCALE, MILLISECOND);
	end(&b, outer);
	outer = begin(&b, TRACKS);
	inner = begin(&b, TRACK_ENTRY);
	put_unsigned(&b, TRACK_NUMBER, 1);
	put_unsigned(&b, TRACK_UID, 1);
	put_unsigned(&b, TRACK_TYPE, 1); /* video */
	put(&b, CODEC_ID, "V_UNCOMPRESSED", 14);
	put_video(&b, width, height, view);
	end(&b, inner);
	end(&b, outer);
	return b.n;
}

size_t matroska_picture(uint8_t out[MATROSKA_PICTURE_BYTES], size_t picture_bytes, double seconds)
{
	const uint8_t block[4] = { 0x81, 0, 0, 0x80 }; /* track 1, at the cluster's time, a key frame */
	struct bytes b = { out, 0 };
	const size_t cluster = begin(&b, CLUSTER);

	put_unsigned(&b, TIMESTAMP, (uint64_t)(seconds * 1000 + 0.5));
	put_head(&b, SIMPLE_BLOCK, sizeof(block) + picture_bytes);
	memcpy(b.at + b.n, block, sizeof(block));
	b.n += sizeof(block);
	put_number(&(struct bytes){ out, cluster - 8 }, (b.n - cluster + picture_bytes) | (uint64_t)1 << 56, 8);
	return b.n;
}
