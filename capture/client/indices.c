/* Runs inside the traced program. */
#include "capture/client/indices.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <limits.h>
#include <stddef.h>

#include "capture/client/content.h"
#include "capture/client/mirror.h"
#include "capture/format/sizes.h"
#include "capture/gl/context.h"
#include "capture/write/pages.h"
#include "capture/write/values.h"
#include "real.h"

enum { BATCH = 16384 };

/* The trace has a buffer of ours bound for the indices of the next draw. */
static __thread int own_indices __attribute__((tls_model("initial-exec")));

static int are_in_buffer(void)
{
	return context_has(HAS_BUFFERS) && context_get(GL_ELEMENT_ARRAY_BUFFER_BINDING);
}

long indices_restart(unsigned type)
{
	if (context_has(HAS_FIXED_RESTART) && real_glIsEnabled(GL_PRIMITIVE_RESTART_FIXED_INDEX))
		return (1L << (8 * type_bytes(type))) - 1;
	if (context_has(HAS_RESTART) && real_glIsEnabled(GL_PRIMITIVE_RESTART))
		return (long)(unsigned)context_get(GL_PRIMITIVE_RESTART_INDEX);
	if (context_has(HAS_RESTART_NV) && real_glIsEnabled(GL_PRIMITIVE_RESTART_NV))
		return (long)(unsigned)context_get(GL_PRIMITIVE_RESTART_INDEX_NV);
	return -1;
}

void indices_widen(struct indices_range *range, const void *indices, int count, unsigned type, long restart, long base)
{
	uint8_t batch[BATCH];
	long size = type_bytes(type), lowest = LONG_MAX, highest = -1, bytes = count * size;
	int buffered = are_in_buffer();

	if ((size != 1 && size != 2 && size != 4) || (!buffered && !indices))
		return;
	for (long at = 0; at < bytes; at += BATCH) {
		long n = bytes - at < BATCH ? bytes - at : BATCH;

		if (buffered)
			real_glGetBufferSubData(GL_ELEMENT_ARRAY_BUFFER, (long)(uintptr_t)indices + at, n, batch);
		else
			pages_read(batch, (const uint8_t *)indices + at, (size_t)n);
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
	range->first = lowest + base < range->first ? lowest + base : range->first;
	range->last = highest + base > range->last ? highest + base : range->last;
}

/* Returns where to keep the range of these indices, or NULL. */
static struct mirror_indices *bind_own(const void *indices, long bytes)
{
	struct mirror_indices *known;
	unsigned own;
	int bound = 0;

	if (!indices || bytes < CONTENT_MIN_BYTES || bytes > INDICES_MAX_BYTES || !context_has(HAS_BUFFERS) ||
	    context_get(GL_ELEMENT_ARRAY_BUFFER_BINDING))
		return NULL;
	own = mirror_buffer(GL_ELEMENT_ARRAY_BUFFER, indices, 0, bytes, &bound, &known);
	if (own && !bound)
		content_bind(GL_ELEMENT_ARRAY_BUFFER, own);
	own_indices = own != 0;
	return known;
}

void indices_bind(const void *indices, int count, unsigned type, struct indices_range *range)
{
	struct mirror_indices *known, found = { .bytes = count * type_bytes(type), .type = type };

	if (!range) {
		bind_own(indices, found.bytes);
		return;
	}
	found.restart = indices_restart(type);
	known = bind_own(indices, found.bytes);
	if (known && known->bytes == found.bytes && known->type == type && known->restart == found.restart) {
		*range = (struct indices_range){ known->lowest, known->highest };
		return;
	}
	*range = (struct indices_range){ LONG_MAX, -1 };
	indices_widen(range, indices, count, type, found.restart, 0);
	found.lowest = range->first;
	found.highest = range->last;
	if (known)
		*known = found;
}

void indices_drawn(void)
{
	if (own_indices)
		content_bind(GL_ELEMENT_ARRAY_BUFFER, 0);
	own_indices = 0;
}

uint8_t *put_indices(uint8_t *p, const void *indices, int count, unsigned type)
{
	if (own_indices)
		return put_null(p);
	if (!indices || are_in_buffer())
		return put_opaque(p, indices);
	return put_blob(p, indices, count * type_bytes(type));
}

uint8_t *put_multi_indices(uint8_t *p, const void *const *indices, const int *counts, unsigned type, int draws)
{
	int offsets = are_in_buffer();

	if (!indices || !counts)
		return put_null(p);
	p = put_array_head(p, draws);
	for (int i = 0; i < draws; i++) {
		p = offsets ? put_opaque(p, indices[i]) : put_blob(p, indices[i], counts[i] * type_bytes(type));
		p = put_room(p);
	}
	return p;
}
