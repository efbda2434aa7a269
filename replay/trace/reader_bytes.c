#include "replay/trace/reader_bytes.h"

#include "base/err.h"
#include "replay/trace/container.h"

int reader_fail(struct trace_reader *r, const char *what)
{
	if (r->status == 0)
		r->status = err_report(ERR_INPUT, r->path,
		                       "damaged in call %llu, byte %llu of the file (%llu unpacked): %s; the calls before it can "
		                       "be used",
		                       (unsigned long long)r->next_number, (unsigned long long)container_offset(r->container),
		                       (unsigned long long)(r->piece_start + (uint64_t)(r->p - r->piece)), what);
	return r->status;
}

void *reader_alloc(struct trace_reader *r, struct arena *a, size_t n)
{
	void *out = arena_alloc(a, n);

	if (!out && r->status == 0)
		r->status = err_report(ERR_SYSTEM, r->path, "out of memory for %zu bytes of one call", n);
	return out;
}

int reader_refill(struct trace_reader *r)
{
	size_t n;
	int rc;

	if (r->status)
		return 0;
	r->piece_start += (uint64_t)(r->end - r->piece);
	rc = container_next(r->container, &r->piece, &n);
	if (rc != 1) {
		r->status = rc < 0 ? rc : 1;
		r->piece = r->p = r->end = NULL;
		return 0;
	}
	r->p = r->piece;
	r->end = r->piece + n;
	return 1;
}

uint64_t reader_long_uint(struct trace_reader *r)
{
	uint64_t value = 0;
	unsigned shift = 0, byte;

	if (__builtin_expect(r->end - r->p >= 8, 1)) {
		const uint8_t *behind = reader_quick_uint(r->p, &value);

		if (behind) {
			r->p = behind;
			return value;
		}
		value = 0;
	}
	do {
		byte = reader_byte(r);
		if (shift == 63 && byte > 1) {
			reader_fail(r, "a number of more than 64 bits");
			return 0;
		}
		value |= (uint64_t)(byte & 0x7f) << shift;
		shift += 7;
	} while (byte & 0x80);
	return value;
}

void reader_bytes_over_pieces(struct trace_reader *r, uint8_t *to, size_t n)
{
	while (n) {
		size_t here = (size_t)(r->end - r->p);
		if (here == 0) {
			if (!reader_refill(r))
				return;
			continue;
		}
		if (here > n)
			here = n;
		memcpy(to, r->p, here);
		r->p += here;
		to += here;
		n -= here;
	}
}

uint8_t *reader_block(struct trace_reader *r, struct arena *a, uint64_t n)
{
	size_t room = n < (4u << 20) ? (size_t)n : 4u << 20, got = 0;
	uint8_t *out;

	if (n > (uint64_t)1 << 40) {
		reader_fail(r, "a string or blob of impossible size");
		return NULL;
	}
	out = reader_alloc(r, a, room + 1);
	while (out && r->status == 0) {
		reader_bytes(r, out + got, room - got);
		got = room;
		if (room == n)
			break;
		room = n - room < room ? (size_t)n : 2 * room;
		uint8_t *grown = reader_alloc(r, a, room + 1);
		if (grown)
			memcpy(grown, out, got);
		out = grown;
	}
	if (!out || r->status)
		return NULL;
	out[n] = 0;
	return out;
}

const char *reader_string(struct trace_reader *r, struct arena *a, uint64_t *count)
{
	uint64_t n = reader_uint(r);

	if (r->status)
		return NULL;
	if (count)
		*count = n;
	return (const char *)reader_block(r, a, n);
}
