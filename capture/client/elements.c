/* Runs inside the traced program. */
#include "capture/client/elements.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include "capture/client/array_state.h"
#include "capture/write/fake.h"
#include "capture/write/pages.h"
#include "capture/write/values.h"
#include "capture/write/writer.h"
#include "tables/commands.h"

/* 1: between Begin and End, with arrays in client memory, which the trace has disabled, and arrays in buffers. */
static __thread int apart __attribute__((tls_model("initial-exec")));

/* The trace's array is enabled or disabled. */
static void record_enabled(int slot, int on)
{
	if (array_is_attribute(slot))
		fake_call(on ? CMD_glEnableVertexAttribArray : CMD_glDisableVertexAttribArray, "u",
		          (unsigned)(slot - ARRAY_ATTRIBUTE));
	else
		fake_call(on ? CMD_glEnableClientState : CMD_glDisableClientState, "e", array_names_of(slot)->enable);
}

/* Enable or disable all arrays in client memory, so that the trace's ArrayElement reads only buffers. */
static void record_client_enabled(int on)
{
	unsigned active = array_state_unit(), now = active;

	for (int slot = 0; slot < N_ARRAYS; slot++) {
		const struct array *a = &array_state.arrays[slot];
		unsigned unit = array_is_unit(slot) ? GL_TEXTURE0 + (unsigned)(slot - ARRAY_TEXTURE) : now;

		if (!a->enabled || a->buffer)
			continue;
		if (unit != now)
			fake_call(CMD_glClientActiveTexture, "e", unit);
		now = unit;
		record_enabled(slot, on);
	}
	if (now != active)
		fake_call(CMD_glClientActiveTexture, "e", active);
}

void elements_begin(void)
{
	if (!writer_active())
		return;
	array_state_refresh();
	apart = array_state.n_client && array_state.n_buffered;
	if (apart)
		record_client_enabled(0);
}

void elements_ended(void)
{
	if (apart && writer_active())
		record_client_enabled(1);
	apart = 0;
}

/* Immediate-mode commands */

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

/* By kind, size - 1 and type of an array. 0: GL has no such array. */
enum { KIND_ATTRIBUTE = ARRAY_TEXTURE + 1, KIND_VERTEX, N_KINDS };
static const unsigned short element_commands[N_KINDS][4][N_TYPES] = {
	[ARRAY_NORMAL] = { [2] = { CMD_glNormal3bv, CMD_glNormal3sv, CMD_glNormal3iv, CMD_glNormal3fv, CMD_glNormal3dv } },
	[ARRAY_COLOR] = {
		[2] = { CMD_glColor3bv, CMD_glColor3sv, CMD_glColor3iv, CMD_glColor3fv, CMD_glColor3dv, CMD_glColor3ubv,
		        CMD_glColor3usv, CMD_glColor3uiv },
		[3] = { CMD_glColor4bv, CMD_glColor4sv, CMD_glColor4iv, CMD_glColor4fv, CMD_glColor4dv, CMD_glColor4ubv,
		        CMD_glColor4usv, CMD_glColor4uiv } },
	[ARRAY_INDEX] = { { 0, CMD_glIndexsv, CMD_glIndexiv, CMD_glIndexfv, CMD_glIndexdv, CMD_glIndexubv } },
	[ARRAY_EDGE_FLAG] = { { 0, 0, 0, 0, 0, CMD_glEdgeFlagv } },
	[ARRAY_FOG_COORD] = { { 0, 0, 0, CMD_glFogCoordfv, CMD_glFogCoorddv } },
	[ARRAY_SECONDARY_COLOR] = {
		[2] = { CMD_glSecondaryColor3bv, CMD_glSecondaryColor3sv, CMD_glSecondaryColor3iv, CMD_glSecondaryColor3fv,
		        CMD_glSecondaryColor3dv, CMD_glSecondaryColor3ubv, CMD_glSecondaryColor3usv, CMD_glSecondaryColor3uiv } },
	[ARRAY_TEXTURE] = {
		{ 0, CMD_glMultiTexCoord1sv, CMD_glMultiTexCoord1iv, CMD_glMultiTexCoord1fv, CMD_glMultiTexCoord1dv },
		{ 0, CMD_glMultiTexCoord2sv, CMD_glMultiTexCoord2iv, CMD_glMultiTexCoord2fv, CMD_glMultiTexCoord2dv },
		{ 0, CMD_glMultiTexCoord3sv, CMD_glMultiTexCoord3iv, CMD_glMultiTexCoord3fv, CMD_glMultiTexCoord3dv },
		{ 0, CMD_glMultiTexCoord4sv, CMD_glMultiTexCoord4iv, CMD_glMultiTexCoord4fv, CMD_glMultiTexCoord4dv } },
	[KIND_ATTRIBUTE] = { { [3] = CMD_glVertexAttrib1fv }, { [3] = CMD_glVertexAttrib2fv }, { [3] = CMD_glVertexAttrib3fv },
	                     { [3] = CMD_glVertexAttrib4fv } },
	[KIND_VERTEX] = {
		[1] = { 0, CMD_glVertex2sv, CMD_glVertex2iv, CMD_glVertex2fv, CMD_glVertex2dv },
		[2] = { 0, CMD_glVertex3sv, CMD_glVertex3iv, CMD_glVertex3fv, CMD_glVertex3dv },
		[3] = { 0, CMD_glVertex4sv, CMD_glVertex4iv, CMD_glVertex4fv, CMD_glVertex4dv } },
};

static unsigned element_command(int slot, const struct array *a)
{
	int column = type_column(a->type), kind = slot < ARRAY_TEXTURE      ? slot :
	                                          array_is_unit(slot)      ? (int)ARRAY_TEXTURE :
	                                          array_is_attribute(slot) ? (int)KIND_ATTRIBUTE :
	                                                                     (int)KIND_VERTEX;

	return column == TYPE_NONE || a->size < 1 || a->size > 4 ? 0 : element_commands[kind][a->size - 1][column];
}

static uint8_t *put_element(uint8_t *p, const struct array *a, const void *data)
{
	switch (a->type) {
	case GL_BYTE: return put_array_s8(p, data, a->size);
	case GL_SHORT: return put_array_s16(p, data, a->size);
	case GL_INT: return put_array_s32(p, data, a->size);
	case GL_FLOAT: return put_array_f32(p, data, a->size);
	case GL_DOUBLE: return put_array_f64(p, data, a->size);
	case GL_UNSIGNED_SHORT: return put_array_u16(p, data, a->size);
	case GL_UNSIGNED_INT: return put_array_u32(p, data, a->size);
	default: return put_array_u8(p, data, a->size);
	}
}

static void record_element(int slot, const struct array *a, int index)
{
	unsigned command = element_command(slot, a), argument = 0;
	long element = array_element_bytes(a);
	double data[4]; /* holds any type */
	uint8_t *p;

	if (!command || element <= 0 || element > (long)sizeof(data))
		return;
	pages_read(data, a->pointer + (a->stride ? a->stride : element) * index, (size_t)element);
	p = writer_enter_fake(command);
	if (!p)
		return;
	if (array_is_unit(slot))
		p = put_enum(put_argument(p, argument++), (unsigned)(GL_TEXTURE0 + slot - ARRAY_TEXTURE));
	else if (array_is_attribute(slot))
		p = put_uint(put_argument(p, argument++), (unsigned)(slot - ARRAY_ATTRIBUTE));
	p = put_element(put_argument(p, argument), a, data);
	writer_call_end(p);
}

/* 1 if the call itself must be written. */
int elements_in_buffer(int index)
{
	if (!writer_active() || !array_state.known || !array_state.n_client)
		return 1; /* all arrays are in buffers: readers can execute the call themselves */
	for (int slot = 0; slot < N_ARRAYS && index >= 0; slot++) {
		const struct array *a = &array_state.arrays[slot];

		/* Write arrays in buffers before a vertex from client memory, and after everything else. */
		if (apart && slot == ARRAY_VERTEX && a->enabled && !a->buffer)
			fake_call(CMD_glArrayElement, "i", index);
		if (a->enabled && !a->buffer && a->pointer)
			record_element(slot, a, index);
	}
	return apart && (!array_state.arrays[ARRAY_VERTEX].enabled || array_state.arrays[ARRAY_VERTEX].buffer);
}
