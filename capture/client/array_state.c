/* Runs inside the traced program. */
#include "capture/client/array_state.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <string.h>

#include "capture/format/sizes.h"
#include "capture/gl/context.h"
#include "real.h"

/* OES_point_size_array, which desktop headers lack. */
enum {
	POINT_SIZE_ARRAY_OES = 0x8B9C, POINT_SIZE_ARRAY_TYPE_OES = 0x898A, POINT_SIZE_ARRAY_STRIDE_OES = 0x898B,
	POINT_SIZE_ARRAY_POINTER_OES = 0x898C, POINT_SIZE_ARRAY_BUFFER_BINDING_OES = 0x8B9F
};

/* NAMES(slot, GL_name_ARRAY, command, size token, type token, size where it is fixed, feature) */
#define NAMES(slot, name, command, size, type, fixed, feature) \
	[ARRAY_##slot] = { GL_##name##_ARRAY, size, type, GL_##name##_ARRAY_STRIDE, GL_##name##_ARRAY_BUFFER_BINDING, \
	                   GL_##name##_ARRAY_POINTER, CMD_##command, fixed, feature }
#define SIZED(slot, name, command, feature) \
	NAMES(slot, name, command, GL_##name##_ARRAY_SIZE, GL_##name##_ARRAY_TYPE, 0, feature)
#define UNSIZED(slot, name, command, fixed, feature) \
	NAMES(slot, name, command, 0, GL_##name##_ARRAY_TYPE, fixed, feature)
static const struct array_names names[] = {
	UNSIZED(NORMAL, NORMAL, glNormalPointer, 3, 0),
	SIZED(COLOR, COLOR, glColorPointer, 0),
	UNSIZED(INDEX, INDEX, glIndexPointer, 1, HAS_FIXED_FUNCTION),
	NAMES(EDGE_FLAG, EDGE_FLAG, glEdgeFlagPointer, 0, 0, 1, HAS_FIXED_FUNCTION),
	UNSIZED(FOG_COORD, FOG_COORD, glFogCoordPointer, 1, HAS_FOG_COORD),
	SIZED(SECONDARY_COLOR, SECONDARY_COLOR, glSecondaryColorPointer, HAS_SECONDARY_COLOR),
	[ARRAY_POINT_SIZE] = { POINT_SIZE_ARRAY_OES, 0, POINT_SIZE_ARRAY_TYPE_OES, POINT_SIZE_ARRAY_STRIDE_OES,
	                       POINT_SIZE_ARRAY_BUFFER_BINDING_OES, POINT_SIZE_ARRAY_POINTER_OES, CMD_glPointSizePointerOES, 1,
	                       HAS_POINT_SIZES },
	SIZED(TEXTURE, TEXTURE_COORD, glTexCoordPointer, 0),
	SIZED(VERTEX, VERTEX, glVertexPointer, 0),
};

/* Asked for only once used: most programs have no texture units beyond the first and no generic attributes. */
static _Atomic unsigned units_used = 1, attributes_used;

__thread struct array_state array_state __attribute__((tls_model("initial-exec"), visibility("hidden")));

void array_state_changed(void)
{
	array_state.known = 0;
}

void array_state_attributes_used(void)
{
	attributes_used = 1;
	array_state_changed();
}

void array_state_unit_used(unsigned texture)
{
	if (texture >= GL_TEXTURE0 && texture < GL_TEXTURE0 + ARRAY_MAX_UNITS)
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

	for (int i = 0; i < ARRAY_MAX_UNITS; i++) {
		if (!(units_used & (1u << i)) || (i && !context_has(HAS_MULTITEXTURE)))
			continue;
		if (now != GL_TEXTURE0 + i) {
			now = GL_TEXTURE0 + i;
			real_glClientActiveTexture((unsigned)now);
		}
		ask_fixed(&array_state.arrays[ARRAY_TEXTURE + i], &names[ARRAY_TEXTURE]);
	}
	if (now != active)
		real_glClientActiveTexture((unsigned)active);
}

void array_state_refresh(void)
{
	if (array_state.known && array_state.turn == context_turn())
		return;
	if (context_has(HAS_CONVENTIONAL)) {
		for (int slot = 0; slot < ARRAY_TEXTURE; slot++)
			ask_fixed(&array_state.arrays[slot], &names[slot]);
		ask_fixed(&array_state.arrays[ARRAY_VERTEX], &names[ARRAY_VERTEX]);
		ask_units();
	}
	for (unsigned i = 0; attributes_used && context_has(HAS_ATTRIBUTES) && i < ARRAY_MAX_ATTRIBUTES; i++)
		ask_attribute(&array_state.arrays[ARRAY_ATTRIBUTE + i], i);
	array_state.n_client = array_state.n_buffered = 0;
	for (int slot = 0; slot < N_ARRAYS; slot++) {
		const struct array *a = &array_state.arrays[slot];

		array_state.n_buffered += a->enabled && a->buffer;
		array_state.n_client += a->enabled && !a->buffer && a->pointer;
	}
	array_state.known = 1;
	array_state.turn = context_turn();
}

unsigned array_state_buffer(void)
{
	return context_has(HAS_BUFFERS) ? (unsigned)context_get(GL_ARRAY_BUFFER_BINDING) : 0;
}

int array_state_pointer_is_offset(void)
{
	return array_state_buffer() != 0;
}

unsigned array_state_unit(void)
{
	return context_has(HAS_MULTITEXTURE) && context_has(HAS_CONVENTIONAL) ?
	               (unsigned)context_get(GL_CLIENT_ACTIVE_TEXTURE) :
	               GL_TEXTURE0;
}

const struct array_names *array_names_of(int slot)
{
	return &names[array_is_unit(slot) ? ARRAY_TEXTURE : slot];
}

long array_element_bytes(const struct array *a)
{
	int size = a->size == GL_BGRA ? 4 : a->size;

	if (a->type == GL_INT_2_10_10_10_REV || a->type == GL_UNSIGNED_INT_2_10_10_10_REV ||
	    a->type == GL_UNSIGNED_INT_10F_11F_11F_REV)
		return 4;
	return size * type_bytes(a->type);
}

int array_is_client(const struct array *a)
{
	return a->enabled && !a->buffer && a->pointer && array_element_bytes(a);
}
