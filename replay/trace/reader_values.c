#include "replay/trace/reader_values.h"

#define MAX_DEPTH 16 /* arrays in structs in arrays; recorders need 3 */

static const struct trace_value *read_items(struct trace_reader *r, struct arena *a, uint64_t n, unsigned depth)
{
	/* Memory for no more items than there can be: an item takes at least one byte, and the count is not trusted. */
	size_t room = n < 4096 ? (size_t)n : 4096;
	struct trace_value *items = reader_alloc(r, a, (room + !room) * sizeof(*items));

	if (depth > MAX_DEPTH)
		reader_fail(r, "values nested too deep");
	for (uint64_t i = 0; items && i < n && r->status == 0; i++) {
		if (i == room) {
			struct trace_value *grown;
			room = n - i < room ? (size_t)n : 2 * room;
			grown = reader_alloc(r, a, room * sizeof(*items));
			if (grown)
				memcpy(grown, items, (size_t)i * sizeof(*items));
			items = grown;
			if (!items)
				break;
		}
		reader_value(r, a, &items[i], depth + 1);
	}
	return items;
}

static void read_wide(struct trace_reader *r, struct arena *a, struct trace_value *v)
{
	uint32_t *wide;

	v->count = reader_uint(r);
	if (v->count > (1u << 20)) {
		reader_fail(r, "a wide string of impossible size");
		return;
	}
	v->wide = wide = reader_alloc(r, a, (v->count + 1) * sizeof(*wide));
	for (uint64_t i = 0; wide && i < v->count && r->status == 0; i++)
		wide[i] = (uint32_t)reader_uint(r);
}

void reader_value(struct trace_reader *r, struct arena *a, struct trace_value *v, unsigned depth)
{
	unsigned tag = reader_byte(r);

	v->type = (enum trace_type)tag;
	v->sig = NULL;
	v->count = 0;
	v->u = 0;
	switch (tag) {
	case TRACE_NULL:
	case TRACE_FALSE:
		break;
	case TRACE_TRUE: v->u = 1; break;
	case TRACE_SINT: v->i = (int64_t)-reader_uint(r); break;
	case TRACE_UINT: case TRACE_OPAQUE: v->u = reader_uint(r); break;
	case TRACE_FLOAT: reader_bytes(r, &v->f, 4); break;
	case TRACE_DOUBLE: reader_bytes(r, &v->d, 8); break;
	case TRACE_STRING: v->str = reader_string(r, a, &v->count); break;
	case TRACE_BLOB:
		v->count = reader_uint(r);
		if (r->status == 0)
			v->blob = reader_block(r, a, v->count);
		break;
	case TRACE_ENUM:
		v->sig = reader_values_sig(r, TRACE_SIG_ENUM);
		if (v->sig && r->version < 3)
			v->i = (int64_t)((const struct trace_values_sig *)v->sig)->values[0];
		else if (v->sig)
			v->i = reader_tagged_int(r);
		break;
	case TRACE_BITMASK:
		v->sig = reader_values_sig(r, TRACE_SIG_BITMASK);
		if (v->sig)
			v->u = reader_uint(r);
		break;
	case TRACE_ARRAY:
		v->count = reader_uint(r);
		if (r->status == 0)
			v->items = read_items(r, a, v->count, depth);
		break;
	case TRACE_STRUCT:
		v->sig = reader_struct_sig(r);
		if (!v->sig)
			break;
		v->count = ((const struct trace_struct_sig *)v->sig)->n;
		v->items = read_items(r, a, v->count, depth);
		break;
	case TRACE_REPR:
		v->count = 2;
		v->items = read_items(r, a, 2, depth);
		break;
	case TRACE_WSTRING:
		read_wide(r, a, v);
		break;
	default:
		reader_fail(r, "a value of unknown type");
	}
}

const uint8_t *reader_quick_array(struct trace_reader *r, const uint8_t *p, struct arena *a, struct trace_value *v)
{
	struct trace_value *items;
	uint64_t n = p[1];

	if (n == 0 || n > 16)
		return NULL;
	items = arena_alloc(a, n * sizeof(*items));
	p += 2;
	for (uint64_t i = 0; i < n && items && p; i++)
		p = r->end - p >= READER_QUICK_BYTES ? reader_quick_scalar(r, p, &items[i]) : NULL;
	if (items && p)
		*v = (struct trace_value){ .type = TRACE_ARRAY, .count = n, .items = items };
	return items ? p : NULL;
}
