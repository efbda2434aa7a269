/* Vertex arrays (GL 2.1 sec. 2.8): pointers, and copies of client memory. */
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "replay/gl/geometry/packed.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/state.h"

/* Set the contents of an array in client memory, as a copy. */
static void set_client(struct gls_exec *x, struct gls_array *array, const uint8_t *data, size_t n)
{
	uint64_t hash = XXH3_64bits(data, n);

	array->buffer = 0;
	array->offset = 0;
	if (array->version == hash && array->client_bytes == n)
		return;
	if (n > array->client_room) {
		uint8_t *grown = realloc(array->client, n);
		if (!grown) {
			gls_out_of_memory(x, n);
			return;
		}
		array->client = grown;
		array->client_room = n;
	}
	if (n)
		memcpy(array->client, data, n);
	array->client_bytes = n;
	array->version = hash;
}

static void set_pointer(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned index, int32_t size,
                        uint32_t type, int32_t stride, unsigned pointer)
{
	struct gls_array *array = &st->client.arrays[index];
	const struct trace_value *v = arg(c, pointer);

	if (gls_refuses(x, st, stride < 0, GL_INVALID_VALUE))
		return;
	/* GL 3.3 sec. 2.8. Mesa (22.3.6) gives normals three components, so it refuses them as well. */
	if (gls_refuses(x, st, gls_is_packed(type) && size != 4 && size != GL_BGRA, GL_INVALID_OPERATION))
		return;
	array->size = size;
	array->type = type;
	array->stride = stride;
	array->normalized = index == GLS_ATTR_NORMAL || index == GLS_ATTR_COLOR || index == GLS_ATTR_SECONDARY;
	if (v->type == TRACE_BLOB) {
		set_client(x, array, v->blob, v->count);
	} else if (arg_is_offset(c, pointer)) {
		array->buffer = st->client.array_buffer;
		array->offset = (uint64_t)gls_value_int(v);
		if (!array->buffer) { /* an address in the program: its contents are recorded before the draw, or were lost */
			array->client_bytes = 0;
			array->version = 0;
		}
	}
}

/* The array of a generic attribute; -1: there is none (GL error). */
static int generic_array(struct gls_exec *x, struct gls_state *st, uint32_t number)
{
	if (gls_refuses(x, st, number > SCENE_MAX_GENERICS, GL_INVALID_VALUE))
		return -1;
	return number ? (int)(GLS_ATTR_GENERIC + number - 1) : GLS_ARRAY_GENERIC0;
}

static void enable_generic(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t on)
{
	const int array = generic_array(x, st, arg_u(c, 0));

	if (array >= 0)
		st->client.arrays[array].enabled = on;
}

GLS_HANDLER(glEnableVertexAttribArray, CLIENT) { enable_generic(x, st, c, 1); }
GLS_HANDLER(glDisableVertexAttribArray, CLIENT) { enable_generic(x, st, c, 0); }

GLS_HANDLER(glVertexAttribPointer, CLIENT)
{
	const int array = generic_array(x, st, arg_u(c, 0));

	if (array < 0)
		return;
	set_pointer(x, st, c, (unsigned)array, (int32_t)arg_i(c, 1), arg_u(c, 2), (int32_t)arg_i(c, 4), 5);
	st->client.arrays[array].normalized = arg_u(c, 3) != 0;
}

/* Arguments: size, type, stride, possibly others, and the pointer. */
static void set_sized(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned index, unsigned pointer)
{
	set_pointer(x, st, c, index, (int32_t)arg_i(c, 0), arg_u(c, 1), (int32_t)arg_i(c, 2), pointer);
}

/* As set_sized, without a size. */
static void set_unsized(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned index, int32_t size,
                        unsigned pointer)
{
	set_pointer(x, st, c, index, size, arg_u(c, 0), (int32_t)arg_i(c, 1), pointer);
}

GLS_HANDLER(glVertexPointer, CLIENT) { set_sized(x, st, c, GLS_ARRAY_VERTEX, 3); }
GLS_HANDLER(glColorPointer, CLIENT) { set_sized(x, st, c, GLS_ATTR_COLOR, 3); }
GLS_HANDLER(glSecondaryColorPointer, CLIENT) { set_sized(x, st, c, GLS_ATTR_SECONDARY, 3); }
GLS_HANDLER(glTexCoordPointer, CLIENT) { set_sized(x, st, c, GLS_ATTR_TEXCOORD + st->client.active_texture, 3); }
GLS_HANDLER(glNormalPointer, CLIENT) { set_unsized(x, st, c, GLS_ATTR_NORMAL, 3, 2); }
GLS_HANDLER(glFogCoordPointer, CLIENT) { set_unsized(x, st, c, GLS_ATTR_FOG_COORD, 1, 2); }
GLS_HANDLER(glIndexPointer, CLIENT) { set_unsized(x, st, c, GLS_ARRAY_INDEX, 1, 2); }
GLS_HANDLER(glPointSizePointerOES, CLIENT) { set_unsized(x, st, c, GLS_ARRAY_POINT_SIZE, 1, 2); }
GLS_HANDLER(glEdgeFlagPointer, CLIENT)
{
	set_pointer(x, st, c, GLS_ARRAY_EDGE_FLAG, 1, GL_UNSIGNED_BYTE, (int32_t)arg_i(c, 0), 1);
}

/* EXT_vertex_array: a count precedes the pointer. */
GLS_HANDLER(glVertexPointerEXT, CLIENT) { set_sized(x, st, c, GLS_ARRAY_VERTEX, 4); }
GLS_HANDLER(glColorPointerEXT, CLIENT) { set_sized(x, st, c, GLS_ATTR_COLOR, 4); }
GLS_HANDLER(glTexCoordPointerEXT, CLIENT) { set_sized(x, st, c, GLS_ATTR_TEXCOORD + st->client.active_texture, 4); }
GLS_HANDLER(glNormalPointerEXT, CLIENT) { set_unsized(x, st, c, GLS_ATTR_NORMAL, 3, 3); }

GLS_HANDLER(glClientActiveTexture, CLIENT)
{
	uint32_t unit = arg_u(c, 0) - GL_TEXTURE0;

	if (!gls_refuses(x, st, unit >= GLS_MAX_UNITS, GL_INVALID_ENUM))
		st->client.active_texture = unit;
}

/* Table 2.5. Strides and offsets in bytes. */
GLS_HANDLER(glInterleavedArrays, CLIENT)
{
	static const struct interleaved {
		uint32_t format;
		int tex, color, normal, vertex; /* components; 0: none */
		uint32_t color_type;
		unsigned color_at, normal_at, vertex_at, stride;
	} formats[] = {
		{ GL_V2F, 0, 0, 0, 2, 0, 0, 0, 0, 8 },
		{ GL_V3F, 0, 0, 0, 3, 0, 0, 0, 0, 12 },
		{ GL_C4UB_V2F, 0, 4, 0, 2, GL_UNSIGNED_BYTE, 0, 0, 4, 12 },
		{ GL_C4UB_V3F, 0, 4, 0, 3, GL_UNSIGNED_BYTE, 0, 0, 4, 16 },
		{ GL_C3F_V3F, 0, 3, 0, 3, GL_FLOAT, 0, 0, 12, 24 },
		{ GL_N3F_V3F, 0, 0, 3, 3, 0, 0, 0, 12, 24 },
		{ GL_C4F_N3F_V3F, 0, 4, 3, 3, GL_FLOAT, 0, 16, 28, 40 },
		{ GL_T2F_V3F, 2, 0, 0, 3, 0, 0, 0, 8, 20 },
		{ GL_T4F_V4F, 4, 0, 0, 4, 0, 0, 0, 16, 32 },
		{ GL_T2F_C4UB_V3F, 2, 4, 0, 3, GL_UNSIGNED_BYTE, 8, 0, 12, 24 },
		{ GL_T2F_C3F_V3F, 2, 3, 0, 3, GL_FLOAT, 8, 0, 20, 32 },
		{ GL_T2F_N3F_V3F, 2, 0, 3, 3, 0, 0, 8, 20, 32 },
		{ GL_T2F_C4F_N3F_V3F, 2, 4, 3, 3, GL_FLOAT, 8, 24, 36, 48 },
		{ GL_T4F_C4F_N3F_V4F, 4, 4, 3, 4, GL_FLOAT, 16, 32, 44, 60 },
	};
	const struct interleaved *f = NULL;
	const struct trace_value *v = arg(c, 2);
	int32_t stride = (int32_t)arg_i(c, 1);

	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
		if (formats[i].format == arg_u(c, 0))
			f = &formats[i];
	if (!f || stride < 0) {
		gls_error(x, st, f ? GL_INVALID_VALUE : GL_INVALID_ENUM);
		return;
	}
	const struct { unsigned index; int size; uint32_t type; unsigned at; } parts[] = {
		{ GLS_ATTR_TEXCOORD + st->client.active_texture, f->tex, GL_FLOAT, 0 },
		{ GLS_ATTR_COLOR, f->color, f->color_type, f->color_at },
		{ GLS_ATTR_NORMAL, f->normal, GL_FLOAT, f->normal_at },
		{ GLS_ARRAY_VERTEX, f->vertex, GL_FLOAT, f->vertex_at },
	};
	st->client.arrays[GLS_ARRAY_EDGE_FLAG].enabled = st->client.arrays[GLS_ARRAY_INDEX].enabled = 0;
	st->client.arrays[GLS_ATTR_SECONDARY].enabled = st->client.arrays[GLS_ATTR_FOG_COORD].enabled = 0;
	for (unsigned i = 0; i < 4; i++) {
		struct gls_array *array = &st->client.arrays[parts[i].index];
		array->enabled = parts[i].size != 0;
		if (!parts[i].size)
			continue;
		array->size = parts[i].size;
		array->type = parts[i].type;
		array->stride = stride ? stride : (int32_t)f->stride;
		array->normalized = parts[i].index == GLS_ATTR_NORMAL || parts[i].index == GLS_ATTR_COLOR;
		if (v->type == TRACE_BLOB && v->count > parts[i].at) {
			set_client(x, array, v->blob + parts[i].at, v->count - parts[i].at);
		} else if (arg_is_offset(c, 2)) {
			array->buffer = st->client.array_buffer;
			array->offset = (uint64_t)gls_value_int(v) + parts[i].at;
		}
	}
}

GLS_HANDLER(glLockArraysEXT, CLIENT)
{
	st->client.lock_first = arg_u(c, 0);
	st->client.lock_count = arg_u(c, 1);
}
GLS_HANDLER(glUnlockArraysEXT, CLIENT) { st->client.lock_count = 0; }
