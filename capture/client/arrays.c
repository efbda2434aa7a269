/* Runs inside the traced program. */
#include "capture/client/arrays.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "capture/client/array_state.h"
#include "capture/client/content.h"
#include "capture/client/indices.h"
#include "capture/client/mirror.h"
#include "capture/format/sizes.h"
#include "capture/gl/context.h"
#include "capture/gl/skip.h"
#include "capture/write/fake.h"
#include "capture/write/pages.h"
#include "capture/write/report.h"
#include "capture/write/values.h"
#include "capture/write/writer.h"
#include "real.h"

enum { MAX_ARRAY_BYTES = 1 << 30 }; /* a larger size comes from a garbage index */

/* A slot's array as last set in the trace. Nothing is written if the draw needs the same one. */
struct written {
	struct array array;
	unsigned buffer; /* the recorder's own; 0: not known */
	long offset;     /* in it */
};

static __thread struct {
	struct written written[N_ARRAYS];
	unsigned epoch, turn; /* the trace and the context that have it */
} self __attribute__((tls_model("initial-exec")));

void arrays_forget(void)
{
	memset(self.written, 0, sizeof(self.written));
	array_state_changed();
}

/* The trace gets offsets, but no pointers into client memory. */
void arrays_pointer_set(void)
{
	if (array_state_pointer_is_offset())
		arrays_forget();
	else
		array_state_changed();
}

/* Writing arrays */

/* `own`: the buffer, bound in the trace, that holds the array at `offset`; 0: its bytes are written here. */
static void record_array(int slot, const struct array *a, long bytes, unsigned own, long offset)
{
	int attribute = array_is_attribute(slot);
	const struct array_names *n = array_names_of(slot);
	unsigned index = 0;
	uint8_t *p = writer_enter_fake(!attribute ? n->command : a->integer ? CMD_glVertexAttribIPointer :
	                                                                       CMD_glVertexAttribPointer);

	if (!p)
		return;
	if (attribute)
		p = put_uint(put_argument(p, index++), (unsigned)(slot - ARRAY_ATTRIBUTE));
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

/* 1 if the trace has this array already. */
static int is_written(int slot, const struct array *a, unsigned own, long offset)
{
	const struct written *w = &self.written[slot];

	return own && w->buffer == own && w->offset == offset && w->array.size == a->size && w->array.type == a->type &&
	       w->array.stride == a->stride && w->array.normalized == a->normalized && w->array.integer == a->integer;
}

/* The trace's bindings and active unit while arrays are written. */
struct bindings {
	unsigned buffer, unit;
};

static void bind(struct bindings *b, unsigned buffer)
{
	if (b->buffer != buffer)
		content_bind(GL_ARRAY_BUFFER, buffer);
	b->buffer = buffer;
}

/* Elements of a draw. Arrays that advance by instance use `instances` elements from `base_instance` on. */
struct drawn {
	struct indices_range range;
	long base_instance, instances;
};

static const struct drawn nothing = { { LONG_MAX, -1 }, 0, 1 };

/* Members of one struct (position, normal, colour) share memory: returns its start, and where an element ends. */
static const uint8_t *shared_start(const struct array *a, long *element_end)
{
	const uint8_t *start = a->pointer, *end = a->pointer + array_element_bytes(a);

	for (int slot = 0; slot < N_ARRAYS && a->stride; slot++) {
		const struct array *other = &array_state.arrays[slot];

		if (!array_is_client(other) || other->stride != a->stride || other->divisor != a->divisor)
			continue;
		if (labs(other->pointer - a->pointer) >= a->stride)
			continue;
		start = other->pointer < start ? other->pointer : start;
		end = other->pointer + array_element_bytes(other) > end ? other->pointer + array_element_bytes(other) : end;
	}
	if (end - start > a->stride) /* they overlap, but not as members of a struct */
		start = a->pointer, end = a->pointer + array_element_bytes(a);
	*element_end = end - start;
	return start;
}

static void write_array(int slot, const struct array *a, const struct drawn *d, struct bindings *b)
{
	unsigned own = 0, unit = GL_TEXTURE0 + (unsigned)(slot - ARRAY_TEXTURE);
	long element = array_element_bytes(a), stride = a->stride ? a->stride : element, element_end, bytes;
	long first = a->divisor ? d->base_instance : d->range.first;
	long last = a->divisor ? d->base_instance + (d->instances - 1) / a->divisor : d->range.last;
	const uint8_t *start = shared_start(a, &element_end);
	int bound = 0;

	bytes = stride * last + element;
	if (bytes > MAX_ARRAY_BYTES) {
		static _Atomic int said;

		if (!said++)
			report_say("a draw reaches beyond %d bytes of a client array; its arrays are not recorded",
			           MAX_ARRAY_BYTES);
		return;
	}
	if (bytes >= CONTENT_MIN_BYTES && context_has(HAS_BUFFERS))
		own = mirror_buffer(GL_ARRAY_BUFFER, start, stride * first, stride * last + element_end, &bound,
		                    NULL);
	if (bound)
		b->buffer = own;
	if (is_written(slot, a, own, a->pointer - start))
		return;
	if (array_is_unit(slot) && b->unit != unit) {
		b->unit = unit;
		fake_call(CMD_glClientActiveTexture, "e", unit);
	}
	bind(b, own);
	record_array(slot, a, bytes, own, own ? a->pointer - start : 0);
}

/* All client arrays, for the elements drawn. */
static void record_arrays(struct drawn *d)
{
	struct bindings program, now;

	if (!array_state.n_client || d->range.last < 0)
		return;
	if (d->range.first < 0)
		d->range.first = 0;
	program.buffer = array_state_buffer();
	program.unit = array_state_unit();
	now = program;
	for (int slot = 0; slot < N_ARRAYS; slot++)
		if (array_is_client(&array_state.arrays[slot]))
			write_array(slot, &array_state.arrays[slot], d, &now);
	if (now.unit != program.unit)
		fake_call(CMD_glClientActiveTexture, "e", program.unit);
	bind(&now, program.buffer);
}

/* Draws */

/* 1 if a draw has client arrays that must be written. */
static int needed(void)
{
	if (!writer_active() || skip_draws())
		return 0;
	if (self.epoch != writer_epoch() || self.turn != context_turn()) {
		self.epoch = writer_epoch();
		self.turn = context_turn();
		arrays_forget(); /* another trace or context has none of the arrays written so far */
	}
	array_state_refresh();
	return array_state.n_client > 0;
}

static void widen(struct indices_range *range, long first, long count)
{
	range->first = first < range->first ? first : range->first;
	range->last = first + count - 1 > range->last ? first + count - 1 : range->last;
}

void arrays_draw(int first, int count, int instances, unsigned base_instance)
{
	struct drawn d = { { first, (long)first + count - 1 }, base_instance, instances };

	if (count > 0 && first >= 0 && needed())
		record_arrays(&d);
}

void arrays_multi_draw(const int *first, const int *count, int draws)
{
	struct drawn d = nothing;

	if (!first || !count || !needed())
		return;
	for (int i = 0; i < draws; i++)
		if (count[i] > 0 && first[i] >= 0)
			widen(&d.range, first[i], count[i]);
	record_arrays(&d);
}

void arrays_draw_elements(int count, unsigned type, const void *indices, int base_vertex, int instances,
                          unsigned base_instance)
{
	struct drawn d = { { 0, -1 }, base_instance, instances };

	if (count <= 0 || skip_draws())
		return;
	if (!needed()) {
		if (writer_active())
			indices_bind(indices, count, type, NULL);
		return;
	}
	indices_bind(indices, count, type, &d.range);
	if (d.range.last < 0)
		return;
	d.range.first += base_vertex;
	d.range.last += base_vertex;
	record_arrays(&d);
}

void arrays_multi_draw_elements(const int *count, unsigned type, const void *const *indices, int draws,
                                const int *base_vertex)
{
	struct drawn d = nothing;
	long restart;

	if (!count || !indices || !needed())
		return;
	restart = indices_restart(type);
	for (int i = 0; i < draws; i++)
		indices_widen(&d.range, indices[i], count[i], type, restart, base_vertex ? base_vertex[i] : 0);
	record_arrays(&d);
}

/* Indirect draws */

long indirect_bytes(int elements, int draws, int stride)
{
	long size = elements ? 20 : 16;

	return draws > 0 && stride >= 0 ? (draws - 1L) * (stride ? stride : size) + size : 0;
}

static int indirect_in_buffer(void)
{
	return context_has(HAS_INDIRECT) && context_get(GL_DRAW_INDIRECT_BUFFER_BINDING);
}

uint8_t *put_indirect(uint8_t *p, const void *indirect, long bytes)
{
	if (!indirect || indirect_in_buffer())
		return put_opaque(p, indirect);
	return put_blob(p, indirect, bytes);
}

enum { MAX_WORDS = 5 };

/* One draw's parameters: count, instances, first index, for elements the base vertex, base instance. */
static void add_indirect(struct drawn *d, const uint32_t *words, int elements, unsigned type)
{
	long instances = words[elements ? 4 : 3] + (long)words[1], offset = (long)words[2] * type_bytes(type);

	if (elements)
		indices_widen(&d->range, (const void *)(uintptr_t)offset, (int)words[0], type, indices_restart(type), (int)words[3]);
	else
		widen(&d->range, words[2], words[0]);
	d->instances = instances > d->instances ? instances : d->instances;
}

/* ARB_draw_indirect: parameters in memory. If their buffer cannot be read, the draw is an error as well. */
static void add_all_indirect(struct drawn *d, const void *indirect, int draws, int stride, int elements, unsigned type)
{
	int buffered = indirect_in_buffer();
	long bytes = indirect_bytes(elements, 1, 0);

	context_errors_before();
	for (long i = 0; i < draws && stride >= 0; i++) {
		long at = i * (stride ? stride : bytes);
		uint32_t words[MAX_WORDS] = { 0 };

		if (buffered)
			real_glGetBufferSubData(GL_DRAW_INDIRECT_BUFFER, (long)(uintptr_t)indirect + at, bytes, words);
		else if (indirect)
			pages_read(words, (const uint8_t *)indirect + at, (size_t)bytes);
		if (words[0] && words[1])
			add_indirect(d, words, elements, type);
	}
	context_errors_after();
}

void arrays_draw_indirect(const void *indirect, int draws, int stride)
{
	struct drawn d = nothing;

	if (!needed())
		return;
	add_all_indirect(&d, indirect, draws, stride, 0, GL_UNSIGNED_INT);
	record_arrays(&d);
}

void arrays_draw_elements_indirect(unsigned type, const void *indirect, int draws, int stride)
{
	struct drawn d = nothing;

	/* Without an element buffer it is an error (GL 4.0 sec. 2.8.3). */
	if (!needed() || !context_has(HAS_BUFFERS) || !context_get(GL_ELEMENT_ARRAY_BUFFER_BINDING))
		return;
	add_all_indirect(&d, indirect, draws, stride, 1, type);
	record_arrays(&d);
}

/* InterleavedArrays sets pointers, which are written at the draw, and enables arrays, which is written here. */
void arrays_interleaved(void)
{
	arrays_pointer_set();
	if (!writer_active() || array_state_pointer_is_offset())
		return;
	for (int slot = 0; slot <= ARRAY_VERTEX; slot++) {
		const struct array_names *n = slot <= ARRAY_TEXTURE || slot == ARRAY_VERTEX ? array_names_of(slot) : NULL;

		if (n && (!n->feature || context_has((enum context_feature)n->feature)))
			fake_call(real_glIsEnabled(n->enable) ? CMD_glEnableClientState : CMD_glDisableClientState, "e", n->enable);
	}
}
