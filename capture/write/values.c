/* Runs inside the traced program. */
#include "capture/write/values.h"

#include "capture/write/pages.h"
#include "tables/enums.h"

/* Signatures that the trace has; under the writer's lock. */
static uint8_t enum_known[N_ENUM_ENTRIES], bits_known[N_BITS_ENTRIES], visual_known;

void values_forget(void)
{
	memset(enum_known, 0, sizeof(enum_known));
	memset(bits_known, 0, sizeof(bits_known));
	visual_known = 0;
}

/* Scalars */

uint8_t *put_uint(uint8_t *p, uint64_t v)
{
	*p++ = TRACE_UINT;
	return put_varint(p, v);
}

uint8_t *put_sint(uint8_t *p, int64_t v)
{
	*p++ = v < 0 ? TRACE_SINT : TRACE_UINT;
	return put_varint(p, v < 0 ? 0 - (uint64_t)v : (uint64_t)v);
}

uint8_t *put_address(uint8_t *p, uintptr_t v)
{
	if (!v)
		return put_null(p);
	*p++ = TRACE_OPAQUE;
	return put_varint(p, v);
}

uint8_t *put_chars(uint8_t *p, const char *s)
{
	size_t n = strlen(s);

	p = put_varint(p, n);
	/* NOLINTNEXTLINE(bugprone-not-null-terminated-result): its length is before it */
	memcpy(p, s, n);
	return p + n;
}

/* A signature holds one name. The first value that needs it writes it. */
static uint8_t *put_enum_entry(uint8_t *p, unsigned number)
{
	*p++ = TRACE_ENUM;
	p = put_varint(p, number);
	if (!enum_known[number]) {
		enum_known[number] = 1;
		*p++ = 1;
		p = put_chars(p, enum_entries[number].name);
		p = put_uint(p, enum_entries[number].value);
	}
	return put_uint(p, enum_entries[number].value);
}

uint8_t *put_enum(uint8_t *p, uint32_t v)
{
	unsigned number = v < 0x10000 ? enum_index[v] : 0;

	return number ? put_enum_entry(p, number) : put_uint(p, v);
}

uint8_t *put_enum_small(uint8_t *p, uint32_t v, const uint16_t group[16])
{
	return v < 16 && group[v] ? put_enum_entry(p, group[v]) : put_enum(p, v);
}

uint8_t *put_symbol(uint8_t *p, int64_t v)
{
	return v >= 0x200 && v < 0x10000 && enum_index[v] ? put_enum(p, (uint32_t)v) : put_sint(p, v);
}

uint8_t *put_bits(uint8_t *p, uint32_t v, const struct bits_entry *bits)
{
	*p++ = TRACE_BITMASK;
	p = put_varint(p, bits->number);
	if (!bits_known[bits->number]) {
		bits_known[bits->number] = 1;
		p = put_varint(p, bits->n_flags);
		for (unsigned i = 0; i < bits->n_flags; i++) {
			p = put_chars(p, bits->flags[i].name);
			p = put_varint(p, bits->flags[i].value);
		}
		p = put_room(p);
	}
	return put_varint(p, v);
}

uint8_t *put_bool8(uint8_t *p, unsigned v)
{
	return v < 2 ? put_enum_entry(p, enums_Boolean[v]) : put_uint(p, v);
}

uint8_t *put_bool32(uint8_t *p, unsigned v)
{
	*p++ = v ? TRACE_TRUE : TRACE_FALSE;
	return p;
}

/* Bulk values */

uint8_t *put_memory(uint8_t *p, const void *data, size_t bytes)
{
	uintptr_t from = (uintptr_t)data;

	while (bytes) {
		size_t n = (size_t)(recording.end - p);

		if (n > bytes)
			n = bytes;
		pages_read(p, (const void *)from, n);
		p += n;
		from += n;
		bytes -= n;
		p = put_room(p);
	}
	return put_room(p);
}

/* A longer array or blob that leaves the program's memory has a garbage length: write nothing, not a disk of zeros. */
enum { LONG_ARRAY = 256, LONG_BLOB = 65536 };

static int has_end(const void *at, long n, size_t size)
{
	uintptr_t end;
	size_t bytes;
	char last;

	return !__builtin_mul_overflow((size_t)n, size, &bytes) && !__builtin_add_overflow((uintptr_t)at, bytes, &end) &&
	       !pages_read(&last, (const void *)(end - 1), 1);
}

static uint8_t *put_sized(uint8_t *p, unsigned tag, const void *data, long bytes)
{
	if (!data)
		return put_null(p);
	if (bytes > LONG_BLOB && !has_end(data, bytes, 1))
		bytes = 0;
	*p++ = (uint8_t)tag;
	p = put_varint(p, bytes > 0 ? (uint64_t)bytes : 0);
	return put_memory(p, data, bytes > 0 ? (size_t)bytes : 0);
}

uint8_t *put_string(uint8_t *p, const char *s, long bytes)
{
	return put_sized(p, TRACE_STRING, s, s && bytes < 0 ? (long)pages_text_bytes(s) : bytes);
}

uint8_t *put_text(uint8_t *p, const char *s, long size)
{
	return put_sized(p, TRACE_STRING, s, s && size > 0 ? (long)strnlen(s, (size_t)size) : 0);
}

uint8_t *put_blob(uint8_t *p, const void *data, long bytes)
{
	return put_sized(p, TRACE_BLOB, data, bytes);
}

uint8_t *put_own_blob(uint8_t *p, const void *data, long bytes)
{
	const uint8_t *from = data;

	if (!data)
		return put_null(p);
	*p++ = TRACE_BLOB;
	p = put_varint(p, (uint64_t)bytes);
	while (bytes) {
		long n = recording.end - p < bytes ? recording.end - p : bytes;

		memcpy(p, from, (size_t)n);
		p = put_room(p + n);
		from += n;
		bytes -= n;
	}
	return put_room(p);
}

uint8_t *put_array_head(uint8_t *p, long n)
{
	*p++ = TRACE_ARRAY;
	return put_varint(p, n > 0 ? (uint64_t)n : 0);
}

enum { MAX_TEXT = 1 << 24 }; /* bytes; a longer one has a garbage length, and would fill the disk */

uint8_t *put_strings(uint8_t *p, const char *const *strings, long count, const int *lengths)
{
	if (!strings)
		return put_null(p);
	p = put_array_head(p, count);
	for (long i = 0; i < count; i++) { /* in a call that GL refuses, anything may be here */
		const char *text;
		int length = -1;

		pages_read(&text, (const void *)((uintptr_t)strings + (size_t)i * sizeof(text)), sizeof(text));
		if (lengths)
			pages_read(&length, (const void *)((uintptr_t)lengths + (size_t)i * sizeof(length)), sizeof(length));
		p = put_string(p, text, length > MAX_TEXT ? 0 : length);
	}
	return p;
}

uint8_t *put_zeros(uint8_t *p, const void *data, long n)
{
	if (!data)
		return put_null(p);
	p = put_array_head(p, n);
	for (long i = 0; i < n; i++) {
		p = put_uint(p, 0);
		if (i % 256 == 255)
			p = put_room(p);
	}
	return put_room(p);
}

/*
 * Arrays of a call that GL refuses or ignores may have any address and length. Vectors and matrices, which a program
 * passes thousands of times a frame, are read directly, as GL does, unless their address cannot be valid: copying them
 * through the kernel would cost more than they do. Longer arrays are copied.
 */
enum { SHORT_ARRAY = 16, PIECE = 256 };

/* Linux maps nothing below vm.mmap_min_addr, and no program's memory takes addresses of more than 56 bits. */
static int may_be_mapped(const void *at)
{
	return (uintptr_t)at >= 0x10000 && (uint64_t)(uintptr_t)at >> 56 == 0;
}

/* n elements: their address, or a copy in `piece`. @param all  elements of the array */
static const void *elements(void *piece, const void *from, long n, size_t size, long all)
{
	if (all <= SHORT_ARRAY && may_be_mapped(from))
		return from;
	pages_read(piece, from, (size_t)n * size);
	return piece;
}

/* Elements of one type: `value` writes v[i], in 128 bytes at most, so 16 fit the margin. */
#define DEFINE_PUT_ARRAY(suffix, type, value) \
	uint8_t *put_array_##suffix(uint8_t *p, type const *array, long n)                                                    \
	{                                                                                                                     \
		type piece[PIECE];                                                                                            \
 \
		if (!array)                                                                                                   \
			return put_null(p);                                                                                   \
		n = n > LONG_ARRAY && !has_end(array, n, sizeof(piece[0])) ? 0 : n;                                           \
		p = put_array_head(p, n);                                                                                     \
		for (long at = 0; at < n; at += PIECE) {                                                                      \
			const long part = n - at < PIECE ? n - at : PIECE;                                                    \
			type const *v = elements(piece, array + at, part, sizeof(piece[0]), n);                               \
 \
			for (long i = 0; i < part; i++) {                                                                     \
				p = value;                                                                                    \
				if (i % 16 == 15)                                                                             \
					p = put_room(p);                                                                      \
			}                                                                                                     \
		}                                                                                                             \
		return put_room(p);                                                                                           \
	}

DEFINE_PUT_ARRAY(s8, int8_t, put_sint(p, v[i]))
DEFINE_PUT_ARRAY(u8, uint8_t, put_uint(p, v[i]))
DEFINE_PUT_ARRAY(s16, int16_t, put_sint(p, v[i]))
DEFINE_PUT_ARRAY(u16, uint16_t, put_uint(p, v[i]))
DEFINE_PUT_ARRAY(s32, int32_t, put_sint(p, v[i]))
DEFINE_PUT_ARRAY(u32, uint32_t, put_uint(p, v[i]))
DEFINE_PUT_ARRAY(s64, int64_t, put_sint(p, v[i]))
DEFINE_PUT_ARRAY(u64, uint64_t, put_uint(p, v[i]))
DEFINE_PUT_ARRAY(f32, float, put_float(p, v[i]))
DEFINE_PUT_ARRAY(f64, double, put_double(p, v[i]))
DEFINE_PUT_ARRAY(enum, uint32_t, put_enum(p, v[i]))
DEFINE_PUT_ARRAY(bool8, uint8_t, put_bool8(p, v[i]))
DEFINE_PUT_ARRAY(bool32, uint32_t, put_bool32(p, v[i]))
DEFINE_PUT_ARRAY(ptr, const void *, put_opaque(p, v[i]))

/* Xutil.h's XVisualInfo, laid out by hand: the recorder needs no X11 headers for one struct. */
struct visual_info {
	void *visual;
	unsigned long visualid;
	int screen, depth, c_class;
	unsigned long red_mask, green_mask, blue_mask;
	int colormap_size, bits_per_rgb;
};

uint8_t *put_visual(uint8_t *p, const void *visual)
{
	static const char *const members[] = { "visual", "visualid", "screen", "depth", "c_class", "red_mask",
		                               "green_mask", "blue_mask", "colormap_size", "bits_per_rgb" };
	const struct visual_info *info = visual;

	if (!info)
		return put_null(p);
	*p++ = TRACE_STRUCT;
	p = put_varint(p, 0);
	if (!visual_known) {
		visual_known = 1;
		p = put_chars(p, "XVisualInfo");
		p = put_varint(p, sizeof(members) / sizeof(members[0]));
		for (size_t i = 0; i < sizeof(members) / sizeof(members[0]); i++)
			p = put_chars(p, members[i]);
	}
	p = put_opaque(p, info->visual);
	p = put_uint(p, info->visualid);
	p = put_sint(p, info->screen);
	p = put_sint(p, info->depth);
	p = put_sint(p, info->c_class);
	p = put_uint(p, info->red_mask);
	p = put_uint(p, info->green_mask);
	p = put_uint(p, info->blue_mask);
	p = put_sint(p, info->colormap_size);
	return put_sint(p, info->bits_per_rgb);
}

/* Lists of attributes */

enum { MAX_ATTRIBS = 512 };

uint8_t *put_attribs(uint8_t *p, const int *list, int end)
{
	long n = 0;

	while (list && n < MAX_ATTRIBS && list[n] != end)
		n += 2;
	return put_array_s32(p, list, n + 1);
}

uint8_t *put_attribs_wide(uint8_t *p, const long *list, long end)
{
	long n = 0;

	while (list && n < MAX_ATTRIBS && list[n] != end)
		n += 2;
	return put_array_s64(p, (const int64_t *)list, n + 1);
}
