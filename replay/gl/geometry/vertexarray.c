/*
 * Vertex array objects (GL 3.0 sec. 2.10, ARB_vertex_array_object, APPLE_vertex_array_object). The arrays and the
 * element buffer of the bound object are the context's own state; those of all other objects, 0 included, are in a
 * table. Deleting a buffer does not affect the bound object; the others look its name up when they draw.
 */
#include "replay/gl/geometry/vertexarray.h"

#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/table.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"

void gls_arrays_init(struct gls_array arrays[N_GLS_ARRAYS])
{
	for (unsigned i = 0; i < N_GLS_ARRAYS; i++) {
		arrays[i].size = 4;
		arrays[i].type = GL_FLOAT;
	}
}

void gls_vertex_array_free(struct gls_vertex_array *object)
{
	for (unsigned i = 0; object && i < N_GLS_ARRAYS; i++)
		free(object->arrays[i].client);
	free(object);
}

static struct gls_vertex_array *find_or_make(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_vertex_array *object = table_find(&st->vertex_arrays, name);

	if (object)
		return object;
	object = gls_object_create(x, &st->vertex_arrays, name, sizeof(*object));
	if (object)
		gls_arrays_init(object->arrays);
	return object;
}

void gls_vertex_array_bind(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_client_attribs *now = &st->client;
	struct gls_vertex_array *old, *object;

	if (name == now->vertex_array || !(old = find_or_make(x, st, now->vertex_array)) ||
	    !(object = find_or_make(x, st, name)))
		return;
	memcpy(old->arrays, now->arrays, sizeof(old->arrays));
	old->element_buffer = now->element_buffer;
	memcpy(now->arrays, object->arrays, sizeof(now->arrays));
	now->element_buffer = object->element_buffer;
	memset(object, 0, sizeof(*object)); /* the context has taken over its memory */
	now->vertex_array = name;
}

GLS_HANDLER(glBindVertexArray, CLIENT) { gls_vertex_array_bind(x, st, arg_u(c, 0)); }
GLS_HANDLER(glBindVertexArrayAPPLE, CLIENT) { gls_vertex_array_bind(x, st, arg_u(c, 0)); }

GLS_HANDLER(glDeleteVertexArrays, CLIENT)
{
	uint64_t at = 0;

	for (uint32_t name; (name = arg_next_name(c, 1, &at));) {
		if (name == st->client.vertex_array)
			gls_vertex_array_bind(x, st, 0);
		gls_vertex_array_free(table_remove(&st->vertex_arrays, name));
	}
}
