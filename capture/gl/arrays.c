/*
 * Runs inside the traced program. Vertex arrays in client memory: what they hold is known only when it is drawn.
 *
 * Before each draw every enabled array without a buffer object is written as a made-up gl*Pointer call whose pointer is a
 * blob of the elements 0 .. highest used, or an offset in a buffer that holds the same bytes (content.h). The driver is the authority on array state: it is asked again after any command
 * that can have changed it. Array state cannot be asked between Begin and End, where ArrayElement is legal, so it is asked
 * before Begin, and ArrayElement of client memory is written as the immediate-mode calls that it stands for (GL 2.1 sec. 2.8);
 * where other arrays lie in buffers the call itself is written, too, and for that time the trace has only those enabled.
 */
#include <GL/gl.h>
#include <GL/glext.h>
#include <limits.h>
#include <stdlib.h>

#include "capture/write/content.h"
#include "capture/gl/memory.h"
#include "capture/gl/mirror.h"
#include "capture/gl/wrap.h"

enum { MAX_UNITS = 8, MAX_ATTRIBUTES = 16, INDEX_BATCH = 16384 };
enum { MAX_ARRAY_BYTES = 1 << 30 }; /* a larger one comes from an index that is garbage */

enum slot {
	SLOT_NORMAL, SLOT_COLOR, SLOT_INDEX, SLOT_EDGE_FLAG, SLOT_FOG_COORD, SLOT_SECONDARY_COLOR, SLOT_TEXTURE,
	SLOT_ATTRIBUTE = SLOT_TEXTURE + MAX_UNITS,
	SLOT_VERTEX = SLOT_ATTRIBUTE + MAX_ATTRIBUTES, /* last: with ArrayElement it makes the vertex */
	N_SLOTS
};

struct array {
	int enabled, size, stride, buffer, normalized, integer, divisor;
	unsigned type;
	const uint8_t *pointer;
};

/* How the fixed-function arrays are asked for. 0: not asked, the value is `fixed_size` or the type is a byte. */
static const struct array_names {
	unsigned enable, size, type, stride, buffer, pointer, command;
	int fixed_size;
	unsigned feature;
} names[] = {
	[SLOT_NORMAL] = { GL_NORMAL_ARRAY, 0, GL_NORMAL_ARRAY_TYPE, GL_NORMAL_ARRAY_STRIDE, GL_NORMAL_ARRAY_BUFFER_BINDING,
	                  GL_NORMAL_ARRAY_POINTER, CMD_glNormalPointer, 3, 0 },
	[SLOT_COLOR] = { GL_COLOR_ARRAY, GL_COLOR_ARRAY_SIZE, GL_COLOR_ARRAY_TYPE, GL_COLOR_ARRAY_STRIDE,
	                 GL_COLOR_ARRAY_BUFFER_BINDING, GL_COLOR_ARRAY_POINTER, CMD_glColorPointer, 0, 0 },
	[SLOT_INDEX] = { GL_INDEX_ARRAY, 0, GL_INDEX_ARRAY_TYPE, GL_INDEX_ARRAY_STRIDE, GL_INDEX_ARRAY_BUFFER_BINDING,
	                 GL_INDEX_ARRAY_POINTER, CMD_glIndexPointer, 1, 0 },
	[SLOT_EDGE_FLAG] = { GL_EDGE_FLAG_ARRAY, 0, 0, GL_EDGE_FLAG_ARRAY_STRIDE, GL_EDGE_FLAG_ARRAY_BUFFER_BINDING,
	                     GL_EDGE_FLAG_ARRAY_POINTER, CMD_glEdgeFlagPointer, 1, 0 },
	[SLOT_FOG_COORD] = { GL_FOG_COORD_ARRAY, 0, GL_FOG_COORD_ARRAY_TYPE, GL_FOG_COORD_ARRAY_STRIDE,
	                     GL_FOG_COORD_ARRAY_BUFFER_BINDING, GL_FOG_COORD_ARRAY_POINTER, CMD_glFogCoordPointer, 1,
	                     HAS_FOG_COORD },
	[SLOT_SECONDARY_COLOR] = { GL_SECONDARY_COLOR_ARRAY, GL_SECONDARY_COLOR_ARRAY_SIZE, GL_SECONDARY_COLOR_ARRAY_TYPE,
	                           GL_SECONDARY_COLOR_ARRAY_STRIDE, GL_SECONDARY_COLOR_ARRAY_BUFFER_BINDING,
	                           GL_SECONDARY_COLOR_ARRAY_POINTER, CMD_glSecondaryColorPointer, 0, HAS_SECONDARY_COLOR },
	[SLOT_TEXTURE] = { GL_TEXTURE_COORD_ARRAY, GL_TEXTURE_COORD_ARRAY_SIZE, GL_TEXTURE_COORD_ARRAY_TYPE,
	                   GL_TEXTURE_COORD_ARRAY_STRIDE, GL_TEXTURE_COORD_ARRAY_BUFFER_BINDING,
	                   GL_TEXTURE_COORD_ARRAY_POINTER, CMD_glTexCoordPointer, 0, 0 },
	[SLOT_VERTEX] = { GL_VERTEX_ARRAY, GL_VERTEX_ARRAY_SIZE, GL_VERTEX_ARRAY_TYPE, GL_VERTEX_ARRAY_STRIDE,
	                  GL_VERTEX_ARRAY_BUFFER_BINDING, GL_VERTEX_ARRAY_POINTER, CMD_glVertexPointer, 0, 0 },
};

/* Asked for only once used: most programs have no texture units beyond the first and no generic attributes. */
static _Atomic unsigned units_used = 1, attributes_used, arrays_used;

/* What the trace has set for a slot: nothing need be written where it is what the draw needs. */
struct written {
	struct array array;
	unsigned buffer; /* the recorder's own; 0: not known */
	long offset;     /* in it */
};

static __thread struct {
	struct array arrays[N_SLOTS];
	struct written written[N_SLOTS];
	int own_indices; /* the trace has a buffer of ours bound for the indices of the draw to come */
	int known;      /* the driver's state, since nothing that changes it was called */
	unsigned epoch; /* of the trace that has what is in `written` */
	int n_client;   /* enabled arrays without a buffer */
	int n_buffered; /* enabled arrays with one */
	int apart;      /* between Begin and End of arrays of both kinds: the trace has those without disabled */
} self __attribute__((tls_model("initial-exec")));

/* Asking the driver */

void arrays_changed(void)
{
	self.known = 0;
	arrays_used = 1;
}

void arrays_forget(void)
{
	memset(self.written, 0, sizeof(self.written));
	arrays_changed();
}

/* A pointer into client memory is not written and changes nothing in the trace; an offset is and does. */
void arrays_pointer_set(void)
{
	if (arrays_pointer_is_offset())
		arrays_forget();
	else
		arrays_changed();
}

void arrays_attributes_used(void)
{
	attributes_used = 1;
	arrays_changed();
}

void arrays_unit_used(unsigned texture)
{
	if (texture >= GL_TEXTURE0 && texture < GL_TEXTURE0 + MAX_UNITS)
		units_used |= 1u << (texture - GL_TEXTURE0);
}

static void ask_fixed(struct array *a, const struct array_names *n)
{
	memset(a, 0, sizeof(*a));
	if (n->feature && !context_has((enum context_feature)n->feature))
		return;
	a->enabled = real_glIsEnabled(n->enable);
	if (!a->enabled)
		return;
	a->size = n->size ? context_get(n->size) : n->fixed_size;
	a->type = n->type ? (unsigned)context_get(n->type) : GL_UNSIGNED_BYTE;
	a->stride = context_get(n->stride);
	a->buffer = context_has(HAS_BUFFERS) ? context_get(n->buffer) : 0;
	real_glGetPointerv(n->pointer, (void **)&a->pointer);
}

static int attribute_get(unsigned index, unsigned pname)
{
	int value = 0;

	real_glGetVertexAttribiv(index, pname, &value);
	return value;
}

static void ask_attribute(struct array *a, unsigned index)
{
	memset(a, 0, sizeof(*a));
	a->enabled = attribute_get(index, GL_VERTEX_ATTRIB_ARRAY_ENABLED);
	if (!a->enabled)
		return;
	a->size = attribute_get(index, GL_VERTEX_ATTRIB_ARRAY_SIZE);
	a->type = (unsigned)attribute_get(index, GL_VERTEX_ATTRIB_ARRAY_TYPE);
	a->stride = attribute_get(index, GL_VERTEX_ATTRIB_ARRAY_STRIDE);
	a->normalized = attribute_get(index, GL_VERTEX_ATTRIB_ARRAY_NORMALIZED);
	a->buffer = context_has(HAS_BUFFERS) ? attribute_get(index, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING) : 0;
	a->integer = context_has(HAS_INTEGER_ATTRIBUTES) ? attribute_get(index, GL_VERTEX_ATTRIB_ARRAY_INTEGER) : 0;
	a->divisor = context_has(HAS_DIVISOR) ? attribute_get(index, GL_VERTEX_ATTRIB_ARRAY_DIVISOR) : 0;
	real_glGetVertexAttribPointerv(index, GL_VERTEX_ATTRIB_ARRAY_POINTER, (void **)&a->pointer);
}

static void ask_units(void)
{
	int active = context_has(HAS_MULTITEXTURE) ? context_get(GL_CLIENT_ACTIVE_TEXTURE) : GL_TEXTURE0, now = active;

	for (int i = 0; i < MAX_UNITS; i++) {
		if (!(units_used & (1u << i)) || (i && !context_has(HAS_MULTITEXTURE)))
			continue;
		if (now != GL_TEXTURE0 + i) {
			now = GL_TEXTURE0 + i;
			real_glClientActiveTexture((unsigned)now);
		}
		ask_fixed(&self.arrays[SLOT_TEXTURE + i], &names[SLOT_TEXTURE]);
	}
	if (now != active)
		real_glClientActiveTexture((unsigned)active);
}

/* Outside Begin/End only. */
static void refresh(void)
{
	if (self.known)
		return;
	if (context_has(HAS_FIXED_FUNCTION)) {
		for (int slot = 0; slot < SLOT_TEXTURE; slot++)
			ask_fixed(&self.arrays[slot], &names[slot]);
		ask_fixed(&self.arrays[SLOT_VERTEX], &names[SLOT_VERTEX]);
		ask_units();
	}
	for (unsigned i = 0; attributes_used && context_has(HAS_ATTRIBUTES) && i < MAX_ATTRIBUTES; i++)
		ask_attribute(&self.arrays[SLOT_ATTRIBUTE + i], i);
	self.n_client = self.n_buffered = 0;
	for (int slot = 0; slot < N_SLOTS; slot++) {
		const struct array *a = &self.arrays[slot];

		self.n_buffered += a->enabled && a->buffer;
		self.n_client += a->enabled && !a->buffer && a->pointer;
	}
	self.known = 1;
}

static int array_buffer(void)
{
	return context_has(HAS_BUFFERS) ? context_get(GL_ARRAY_BUFFER_BINDING) : 0;
}

int arrays_pointer_is_offset(void)
{
	return array_buffer() != 0;
}

/* Writing made-up calls */

static void record_enum(unsigned command, unsigned value)
{
	uint8_t *p = writer_enter_fake(command);

	if (!p)
		return;
	p = put_enum(put_argument(p, 0), value);
	writer_call_end(p);
}

/* Bytes of one element; 0 for a size or type that is none. */
static long element_bytes(const struct array *a)
{
	int size = a->size == GL_BGRA ? 4 : a->size;

	if (a->type == GL_INT_2_10_10_10_REV || a->type == GL_UNSIGNED_INT_2_10_10_10_REV ||
	    a->type == GL_UNSIGNED_INT_10F_11F_11F_REV)
		return 4;
	return size * type_bytes(a->type);
}

/* `own`: the buffer, bound in the trace, that holds the array at `offset`; 0: its bytes are written here. */
static void record_array(int slot, const struct array *a, long bytes, unsigned own, long offset)
{
	int attribute = slot >= SLOT_ATTRIBUTE && slot < SLOT_ATTRIBUTE + MAX_ATTRIBUTES;
	const struct array_names *n = &names[slot >= SLOT_TEXTURE && slot < SLOT_ATTRIBUTE ? SLOT_TEXTURE : slot];
	unsigned index = 0;
	uint8_t *p = writer_enter_fake(!attribute ? n->command : a->integer ? CMD_glVertexAttribIPointer :
	                                                                       CMD_glVertexAttribPointer);

	if (!p)
		return;
	if (attribute)
		p = put_uint(put_argument(p, index++), (unsigned)(slot - SLOT_ATTRIBUTE));
	if (attribute || n->size)
		p = put_sint(put_argument(p, index++), a->size);
	if (attribute || n->type)
		p = put_enum(put_argument(p, index++), a->type);
	if (attribute && !a->integer)
		p = put_bool8(put_argument(p, index++), (unsigned)a->normalized);
	p = put_sint(put_argument(p, index++), a->stride);
	p = put_argument(p, index);
	p = own ? put_opaque(p, offset) : put_blob(p, a->pointer, bytes);
	writer_call_end(p);
	self.written[slot].array = *a;
	self.written[slot].buffer = own;
	self.written[slot].offset = offset;
}

/* 1 where the trace's array is already this one. */
static int is_written(int slot, const struct array *a, unsigned own, long offset)
{
	const struct written *w = &self.written[slot];

	return own && w->buffer == own && w->offset == offset && w->array.size == a->size && w->array.type == a->type &&
	       w->array.stride == a->stride && w->array.normalized == a->normalized && w->array.integer == a->integer;
}

/* What the trace has bound and active while arrays are written. */
struct bindings {
	unsigned buffer, unit;
};

static void bind(struct bindings *b, unsigned buffer)
{
	if (b->buffer != buffer)
		content_bind(GL_ARRAY_BUFFER, buffer);
	b->buffer = buffer;
}

/* Elements of a draw; of arrays that advance by instance, `instances` counted from `base_instance` on. */
struct drawn {
	long first, last, base_instance, instances;
};

static int is_client(const struct array *a)
{
	return a->enabled && !a->buffer && a->pointer && element_bytes(a);
}

/* Arrays that lie in one another (structs of position, normal, colour) share memory: where it starts, and where an element ends. */
static const uint8_t *shared_start(const struct array *a, long *element_end)
{
	const uint8_t *start = a->pointer, *end = a->pointer + element_bytes(a);

	for (int slot = 0; slot < N_SLOTS && a->stride; slot++) {
		const struct array *other = &self.arrays[slot];

		if (!is_client(other) || other->stride != a->stride || other->divisor != a->divisor)
			continue;
		if (labs(other->pointer - a->pointer) >= a->stride)
			continue;
		start = other->pointer < start ? other->pointer : start;
		end = other->pointer + element_bytes(other) > end ? other->pointer + element_bytes(other) : end;
	}
	if (end - start > a->stride) /* they overlap otherwise than as members of a struct */
		start = a->pointer, end = a->pointer + element_bytes(a);
	*element_end = end - start;
	return start;
}

static void write_array(int slot, const struct array *a, const struct drawn *d, struct bindings *b)
{
	unsigned own = 0, unit = GL_TEXTURE0 + (unsigned)(slot - SLOT_TEXTURE);
	long element = element_bytes(a), stride = a->stride ? a->stride : element, element_end, bytes;
	long first = a->divisor ? d->base_instance : d->first;
	long last = a->divisor ? d->base_instance + (d->instances - 1) / a->divisor : d->last;
	const uint8_t *start = shared_start(a, &element_end);
	int bound = 0;

	bytes = stride * last + element;
	if (bytes > MAX_ARRAY_BYTES) {
		static _Atomic int said;

		if (!said++)
			writer_say("a draw reaches beyond %d bytes of a client array; its arrays are not recorded",
			           MAX_ARRAY_BYTES);
		return;
	}
	if (bytes >= CONTENT_MIN_BYTES && context_has(HAS_BUFFERS))
		own = mirror_buffer(context_mirrors(), GL_ARRAY_BUFFER, start, stride * first, stride * last + element_end, &bound,
		                    NULL);
	if (bound)
		b->buffer = own;
	if (is_written(slot, a, own, a->pointer - start))
		return;
	if (slot >= SLOT_TEXTURE && slot < SLOT_ATTRIBUTE && b->unit != unit) {
		b->unit = unit;
		record_enum(CMD_glClientActiveTexture, unit);
	}
	bind(b, own);
	record_array(slot, a, bytes, own, own ? a->pointer - start : 0);
}

/* All client arrays, for the elements drawn. */
static void record_arrays(const struct drawn *d)
{
	struct bindings program, now;

	if (!self.n_client || d->last < 0)
		return;
	program.buffer = (unsigned)array_buffer();
	program.unit = context_has(HAS_MULTITEXTURE) && context_has(HAS_FIXED_FUNCTION) ?
	               (unsigned)context_get(GL_CLIENT_ACTIVE_TEXTURE) : GL_TEXTURE0;
	now = program;
	for (int slot = 0; slot < N_SLOTS; slot++)
		if (is_client(&self.arrays[slot]))
			write_array(slot, &self.arrays[slot], d, &now);
	if (now.unit != program.unit)
		record_enum(CMD_glClientActiveTexture, program.unit);
	bind(&now, program.buffer);
}

/* Draws */

/* 1 where a draw has client arrays that must be written. */
static int needed(void)
{
	if (!arrays_used || !writer_active() || skip_draws())
		return 0;
	if (self.epoch != writer_epoch()) {
		self.epoch = writer_epoch();
		arrays_forget(); /* another trace, which has nothing of what was written to the one before */
	}
	refresh();
	return self.n_client > 0;
}

void arrays_draw(int first, int count, int instances, unsigned base_instance)
{
	struct drawn d = { first, (long)first + count - 1, base_instance, instances };

	if (count > 0 && first >= 0 && needed())
		record_arrays(&d);
}

void arrays_multi_draw(const int *first, const int *count, int draws)
{
	struct drawn d = { LONG_MAX, -1, 0, 1 };

	if (!first || !count || !needed())
		return;
	for (int i = 0; i < draws; i++) {
		if (count[i] <= 0 || first[i] < 0)
			continue;
		d.first = first[i] < d.first ? first[i] : d.first;
		d.last = (long)first[i] + count[i] - 1 > d.last ? (long)first[i] + count[i] - 1 : d.last;
	}
	record_arrays(&d);
}

/* The index that starts a new primitive and is no vertex; -1 for none. */
static long restart_index(unsigned type)
{
	if (context_has(HAS_FIXED_RESTART) && real_glIsEnabled(GL_PRIMITIVE_RESTART_FIXED_INDEX))
		return (1L << (8 * type_bytes(type))) - 1;
	if (context_has(HAS_RESTART) && real_glIsEnabled(GL_PRIMITIVE_RESTART))
		return (long)(unsigned)context_get(GL_PRIMITIVE_RESTART_INDEX);
	if (context_has(HAS_RESTART_NV) && real_glIsEnabled(GL_PRIMITIVE_RESTART_NV))
		return (long)(unsigned)context_get(GL_PRIMITIVE_RESTART_INDEX_NV);
	return -1;
}

/* Widens `d` by the lowest and highest of `count` indices in client memory or, as an offset, in the element array buffer. */
static void find_range(const void *indices, int count, unsigned type, long restart, long base, struct drawn *d)
{
	uint8_t batch[INDEX_BATCH];
	long size = type_bytes(type), lowest = LONG_MAX, highest = -1, bytes = count * size;
	int buffered = context_has(HAS_BUFFERS) && context_get(GL_ELEMENT_ARRAY_BUFFER_BINDING);

	if ((size != 1 && size != 2 && size != 4) || (!buffered && !indices))
		return;
	for (long at = 0; at < bytes; at += INDEX_BATCH) {
		long n = bytes - at < INDEX_BATCH ? bytes - at : INDEX_BATCH;

		if (buffered)
			real_glGetBufferSubData(GL_ELEMENT_ARRAY_BUFFER, (long)(uintptr_t)indices + at, n, batch);
		else
			memory_read(batch, (const uint8_t *)indices + at, (size_t)n);
		for (long i = 0; i < n / size; i++) {
			long index = size == 1 ? batch[i] : size == 2 ? ((uint16_t *)batch)[i] : ((uint32_t *)batch)[i];

			if (index == restart)
				continue;
			highest = index > highest ? index : highest;
			lowest = index < lowest ? index : lowest;
		}
	}
	if (highest < 0)
		return;
	d->first = lowest + base < d->first ? lowest + base : d->first;
	d->last = highest + base > d->last ? highest + base : d->last;
}

/* Indices in client memory have a buffer in the trace: for the time of the draw it is bound. Returns what is known of them. */
static struct mirror_indices *bind_indices(const void *indices, long bytes)
{
	struct mirror_indices *known;
	unsigned own;
	int bound = 0;

	if (!indices || bytes < CONTENT_MIN_BYTES || bytes > MAX_ARRAY_BYTES || !context_has(HAS_BUFFERS) ||
	    context_get(GL_ELEMENT_ARRAY_BUFFER_BINDING))
		return NULL;
	own = mirror_buffer(context_mirrors(), GL_ELEMENT_ARRAY_BUFFER, indices, 0, bytes, &bound, &known);
	if (own && !bound)
		content_bind(GL_ELEMENT_ARRAY_BUFFER, own);
	self.own_indices = own != 0;
	return known;
}

void arrays_draw_elements(int count, unsigned type, const void *indices, int base_vertex, int instances,
                          unsigned base_instance)
{
	struct drawn d = { LONG_MAX, -1, base_instance, instances };
	struct mirror_indices *known, found = { 0 };

	if (count <= 0 || skip_draws())
		return;
	if (!needed()) {
		if (writer_active())
			bind_indices(indices, count * type_bytes(type));
		return;
	}
	found.bytes = count * type_bytes(type);
	found.type = type;
	found.restart = restart_index(type);
	known = bind_indices(indices, found.bytes);
	if (known && known->bytes == found.bytes && known->type == type && known->restart == found.restart) {
		found = *known;
	} else {
		find_range(indices, count, type, found.restart, 0, &d);
		found.lowest = d.first;
		found.highest = d.last;
		if (known)
			*known = found;
	}
	if (found.highest < 0)
		return;
	d.first = found.lowest + base_vertex;
	d.last = found.highest + base_vertex;
	d.first = d.first < 0 ? 0 : d.first;
	record_arrays(&d);
}

int arrays_own_indices(void)
{
	return self.own_indices;
}

void arrays_drawn(void)
{
	if (self.own_indices)
		content_bind(GL_ELEMENT_ARRAY_BUFFER, 0);
	self.own_indices = 0;
}

void arrays_multi_draw_elements(const int *count, unsigned type, const void *const *indices, int draws,
                                const int *base_vertex)
{
	struct drawn d = { LONG_MAX, -1, 0, 1 };
	long restart;

	if (!count || !indices || !needed())
		return;
	restart = restart_index(type);
	for (int i = 0; i < draws; i++)
		find_range(indices[i], count[i], type, restart, base_vertex ? base_vertex[i] : 0, &d);
	d.first = d.first < 0 ? 0 : d.first;
	record_arrays(&d);
}

/*
 * Draws whose parameters lie in memory (ARB_draw_indirect): calls `put` with each. Where a buffer of them cannot be read, the draw is
 * an error, too.
 */
enum { ARRAYS_WORDS = 4, ELEMENTS_WORDS = 5 };

static void for_each_indirect(const void *indirect, int words, int draws, int stride,
                              void (*put)(const uint32_t *command, unsigned type, struct drawn *d), unsigned type, struct drawn *d)
{
	int buffered = context_has(HAS_INDIRECT) && context_get(GL_DRAW_INDIRECT_BUFFER_BINDING);

	context_errors_before();
	for (long i = 0; i < draws && stride >= 0; i++) {
		long at = i * (stride ? stride : 4 * words);
		uint32_t command[ELEMENTS_WORDS] = { 0 };

		if (buffered)
			real_glGetBufferSubData(GL_DRAW_INDIRECT_BUFFER, (long)(uintptr_t)indirect + at, 4 * words, command);
		else if (indirect)
			memory_read(command, (const uint8_t *)indirect + at, 4 * (size_t)words);
		if (command[0] && command[1])
			put(command, type, d);
	}
	context_errors_after();
}

static void add_instances(struct drawn *d, long instances, long base)
{
	d->instances = base + instances > d->instances ? base + instances : d->instances;
}

/* count, instances, first, base instance */
static void add_arrays(const uint32_t *command, unsigned type, struct drawn *d)
{
	(void)type;
	d->first = (long)command[2] < d->first ? (long)command[2] : d->first;
	d->last = (long)command[2] + command[0] - 1 > d->last ? (long)command[2] + command[0] - 1 : d->last;
	add_instances(d, command[1], command[3]);
}

/* count, instances, first index, base vertex, base instance */
static void add_elements(const uint32_t *command, unsigned type, struct drawn *d)
{
	long offset = (long)command[2] * type_bytes(type);

	find_range((const void *)(uintptr_t)offset, (int)command[0], type, restart_index(type), (int)command[3], d);
	add_instances(d, command[1], command[4]);
}

void arrays_draw_indirect(const void *indirect, int draws, int stride)
{
	struct drawn d = { LONG_MAX, -1, 0, 1 };

	if (!needed())
		return;
	for_each_indirect(indirect, ARRAYS_WORDS, draws, stride, add_arrays, 0, &d);
	record_arrays(&d);
}

void arrays_draw_elements_indirect(unsigned type, const void *indirect, int draws, int stride)
{
	struct drawn d = { LONG_MAX, -1, 0, 1 };

	/* Without an element buffer it is an error (GL 4.0 sec. 2.8.3). */
	if (!needed() || !context_has(HAS_BUFFERS) || !context_get(GL_ELEMENT_ARRAY_BUFFER_BINDING))
		return;
	for_each_indirect(indirect, ELEMENTS_WORDS, draws, stride, add_elements, type, &d);
	d.first = d.first < 0 ? 0 : d.first;
	record_arrays(&d);
}

/* InterleavedArrays sets pointers, which are written when drawn, and which arrays are enabled, which is written here. */

int arrays_interleave_is_offset(unsigned format)
{
	(void)format;
	return arrays_pointer_is_offset();
}

void arrays_interleaved(unsigned format)
{
	(void)format;
	arrays_pointer_set();
	if (!writer_active() || arrays_pointer_is_offset())
		return;
	for (int slot = 0; slot <= SLOT_VERTEX; slot++) {
		const struct array_names *n = slot <= SLOT_TEXTURE || slot == SLOT_VERTEX ? &names[slot] : NULL;

		if (n && (!n->feature || context_has((enum context_feature)n->feature)))
			record_enum(real_glIsEnabled(n->enable) ? CMD_glEnableClientState : CMD_glDisableClientState,
			            n->enable);
	}
}

/* ArrayElement */

/* The trace's array is enabled or disabled. */
static void record_enabled(int slot, int on)
{
	uint8_t *p;

	if (slot < SLOT_ATTRIBUTE || slot == SLOT_VERTEX) {
		record_enum(on ? CMD_glEnableClientState : CMD_glDisableClientState,
		            names[slot >= SLOT_TEXTURE && slot != SLOT_VERTEX ? SLOT_TEXTURE : slot].enable);
		return;
	}
	p = writer_enter_fake(on ? CMD_glEnableVertexAttribArray : CMD_glDisableVertexAttribArray);
	if (p)
		writer_call_end(put_uint(put_argument(p, 0), (unsigned)(slot - SLOT_ATTRIBUTE)));
}

/* All arrays in client memory, so that the trace's ArrayElement takes from buffers only. */
static void record_client_enabled(int on)
{
	unsigned active = context_has(HAS_MULTITEXTURE) && context_has(HAS_FIXED_FUNCTION) ?
	                  (unsigned)context_get(GL_CLIENT_ACTIVE_TEXTURE) : GL_TEXTURE0, now = active;

	for (int slot = 0; slot < N_SLOTS; slot++) {
		const struct array *a = &self.arrays[slot];
		unsigned unit = slot >= SLOT_TEXTURE && slot < SLOT_ATTRIBUTE ? GL_TEXTURE0 + (unsigned)(slot - SLOT_TEXTURE) : now;

		if (!a->enabled || a->buffer)
			continue;
		if (unit != now)
			record_enum(CMD_glClientActiveTexture, unit);
		now = unit;
		record_enabled(slot, on);
	}
	if (now != active)
		record_enum(CMD_glClientActiveTexture, active);
}

void arrays_begin(void)
{
	if (!arrays_used || !writer_active())
		return;
	refresh();
	self.apart = self.n_client && self.n_buffered;
	if (self.apart)
		record_client_enabled(0);
}

void arrays_ended(void)
{
	if (self.apart && writer_active())
		record_client_enabled(1);
	self.apart = 0;
}

enum { N_TYPES = 8, TYPE_NONE = -1 };

/* Order of the columns below. */
static int type_column(unsigned type)
{
	static const unsigned columns[N_TYPES] = { GL_BYTE, GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE, GL_UNSIGNED_BYTE,
		                                   GL_UNSIGNED_SHORT, GL_UNSIGNED_INT };

	for (int i = 0; i < N_TYPES; i++)
		if (columns[i] == type)
			return i;
	return TYPE_NONE;
}

/* Immediate-mode commands by the type and size of an array. 0: GL has none, as no array is so. */
static const unsigned short vertex_commands[][N_TYPES] = {
	{ 0, CMD_glVertex2sv, CMD_glVertex2iv, CMD_glVertex2fv, CMD_glVertex2dv },
	{ 0, CMD_glVertex3sv, CMD_glVertex3iv, CMD_glVertex3fv, CMD_glVertex3dv },
	{ 0, CMD_glVertex4sv, CMD_glVertex4iv, CMD_glVertex4fv, CMD_glVertex4dv },
};
static const unsigned short color_commands[][N_TYPES] = {
	{ CMD_glColor3bv, CMD_glColor3sv, CMD_glColor3iv, CMD_glColor3fv, CMD_glColor3dv, CMD_glColor3ubv, CMD_glColor3usv,
	  CMD_glColor3uiv },
	{ CMD_glColor4bv, CMD_glColor4sv, CMD_glColor4iv, CMD_glColor4fv, CMD_glColor4dv, CMD_glColor4ubv, CMD_glColor4usv,
	  CMD_glColor4uiv },
};
static const unsigned short texture_commands[][N_TYPES] = {
	{ 0, CMD_glMultiTexCoord1sv, CMD_glMultiTexCoord1iv, CMD_glMultiTexCoord1fv, CMD_glMultiTexCoord1dv },
	{ 0, CMD_glMultiTexCoord2sv, CMD_glMultiTexCoord2iv, CMD_glMultiTexCoord2fv, CMD_glMultiTexCoord2dv },
	{ 0, CMD_glMultiTexCoord3sv, CMD_glMultiTexCoord3iv, CMD_glMultiTexCoord3fv, CMD_glMultiTexCoord3dv },
	{ 0, CMD_glMultiTexCoord4sv, CMD_glMultiTexCoord4iv, CMD_glMultiTexCoord4fv, CMD_glMultiTexCoord4dv },
};
static const unsigned short normal_commands[N_TYPES] = { CMD_glNormal3bv, CMD_glNormal3sv, CMD_glNormal3iv, CMD_glNormal3fv,
	                                                 CMD_glNormal3dv };
static const unsigned short index_commands[N_TYPES] = { 0, CMD_glIndexsv, CMD_glIndexiv, CMD_glIndexfv, CMD_glIndexdv,
	                                                CMD_glIndexubv };
static const unsigned short fog_commands[N_TYPES] = { 0, 0, 0, CMD_glFogCoordfv, CMD_glFogCoorddv };
static const unsigned short secondary_commands[N_TYPES] = {
	CMD_glSecondaryColor3bv, CMD_glSecondaryColor3sv,  CMD_glSecondaryColor3iv,  CMD_glSecondaryColor3fv,
	CMD_glSecondaryColor3dv, CMD_glSecondaryColor3ubv, CMD_glSecondaryColor3usv, CMD_glSecondaryColor3uiv
};
static const unsigned short attribute_commands[] = { CMD_glVertexAttrib1fv, CMD_glVertexAttrib2fv, CMD_glVertexAttrib3fv,
	                                             CMD_glVertexAttrib4fv };

static unsigned element_command(int slot, const struct array *a)
{
	int column = type_column(a->type);

	if (column == TYPE_NONE)
		return 0;
	switch (slot) {
	case SLOT_NORMAL:
		return normal_commands[column];
	case SLOT_COLOR:
		return a->size == 3 || a->size == 4 ? color_commands[a->size - 3][column] : 0;
	case SLOT_INDEX:
		return index_commands[column];
	case SLOT_EDGE_FLAG:
		return CMD_glEdgeFlagv;
	case SLOT_FOG_COORD:
		return fog_commands[column];
	case SLOT_SECONDARY_COLOR:
		return secondary_commands[column];
	case SLOT_VERTEX:
		return a->size >= 2 && a->size <= 4 ? vertex_commands[a->size - 2][column] : 0;
	default:
		if (a->size < 1 || a->size > 4)
			return 0;
		if (slot >= SLOT_ATTRIBUTE)
			return a->type == GL_FLOAT ? attribute_commands[a->size - 1] : 0;
		return texture_commands[a->size - 1][column];
	}
}

static uint8_t *put_element(uint8_t *p, const struct array *a, const void *data)
{
	switch (a->type) {
	case GL_BYTE:
		return put_array_s8(p, data, a->size);
	case GL_SHORT:
		return put_array_s16(p, data, a->size);
	case GL_INT:
		return put_array_s32(p, data, a->size);
	case GL_FLOAT:
		return put_array_f32(p, data, a->size);
	case GL_DOUBLE:
		return put_array_f64(p, data, a->size);
	case GL_UNSIGNED_SHORT:
		return put_array_u16(p, data, a->size);
	case GL_UNSIGNED_INT:
		return put_array_u32(p, data, a->size);
	default:
		return put_array_u8(p, data, a->size);
	}
}

static void record_element(int slot, const struct array *a, int index)
{
	unsigned command = element_command(slot, a), argument = 0;
	long element = element_bytes(a);
	double data[4]; /* of any type */
	uint8_t *p;

	if (!command || element <= 0 || element > (long)sizeof(data))
		return;
	memory_read(data, a->pointer + (a->stride ? a->stride : element) * index, (size_t)element);
	p = writer_enter_fake(command);
	if (!p)
		return;
	if (slot >= SLOT_TEXTURE && slot < SLOT_ATTRIBUTE)
		p = put_enum(put_argument(p, argument++), (unsigned)(GL_TEXTURE0 + slot - SLOT_TEXTURE));
	else if (slot >= SLOT_ATTRIBUTE && slot < SLOT_VERTEX)
		p = put_uint(put_argument(p, argument++), (unsigned)(slot - SLOT_ATTRIBUTE));
	p = put_element(put_argument(p, argument), a, data);
	writer_call_end(p);
}

static void record_index(int index)
{
	uint8_t *p = writer_enter_fake(CMD_glArrayElement);

	if (p)
		writer_call_end(put_sint(put_argument(p, 0), index));
}

/* 1 where the call itself is to be written. */
int arrays_element_is_offset(int index)
{
	if (!writer_active() || !self.known || !self.n_client)
		return 1; /* all of it in buffers: readers can do it themselves */
	for (int slot = 0; slot < N_SLOTS && index >= 0; slot++) {
		const struct array *a = &self.arrays[slot];

		/* What is in buffers comes before a vertex of client memory, and after all else. */
		if (self.apart && slot == SLOT_VERTEX && a->enabled && !a->buffer)
			record_index(index);
		if (a->enabled && !a->buffer && a->pointer)
			record_element(slot, a, index);
	}
	return self.apart && (!self.arrays[SLOT_VERTEX].enabled || self.arrays[SLOT_VERTEX].buffer);
}
