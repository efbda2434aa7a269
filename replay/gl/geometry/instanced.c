/*
 * Draws with several instances (GL 3.1 sec. 2.8.3, ARB_base_instance) and draws with parameters in memory
 * (ARB_draw_indirect, ARB_multi_draw_indirect), turned into direct draws. Fixed function does not know which instance
 * it draws: all are equal.
 */
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "replay/gl/geometry/array_draw.h"
#include "replay/machine/args.h"
#include "replay/machine/buffer.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/state.h"

/* Number of times to draw; 0: an error, or beyond any reasonable number (counted). */
static int64_t count_instances(struct gls_exec *x, struct gls_state *st, int64_t instances)
{
	if (instances < 0)
		gls_error(x, st, GL_INVALID_VALUE);
	return instances > 0 && !gls_is_beyond_measure(x, (uint64_t)instances, "draws of instances without end") ?
	               instances :
	               0;
}

static void draw_arrays(struct gls_exec *x, struct gls_state *st, uint32_t mode, int64_t first, int64_t count,
                        int64_t instances)
{
	for (int64_t n = count_instances(x, st, instances); n > 0; n--)
		gls_draw_arrays(x, st, mode, first, count);
}

static void draw_elements(struct gls_exec *x, struct gls_state *st, const struct call *c, int64_t count, uint32_t type,
                          const struct trace_value *indices, int64_t instances, int32_t base)
{
	for (int64_t n = count_instances(x, st, instances); n > 0; n--)
		gls_draw_elements(x, st, arg_u(c, 0), count, type, indices, base);
}

GLS_HANDLER(glDrawArraysInstanced, ARRAY) { draw_arrays(x, st, arg_u(c, 0), arg_i(c, 1), arg_i(c, 2), arg_i(c, 3)); }
GLS_HANDLER(glDrawArraysInstancedBaseInstance, ARRAY)
{
	draw_arrays(x, st, arg_u(c, 0), arg_i(c, 1), arg_i(c, 2), arg_i(c, 3));
}
GLS_HANDLER(glDrawElementsInstanced, ARRAY)
{
	draw_elements(x, st, c, arg_i(c, 1), arg_u(c, 2), arg(c, 3), arg_i(c, 4), 0);
}
GLS_HANDLER(glDrawElementsInstancedBaseInstance, ARRAY)
{
	draw_elements(x, st, c, arg_i(c, 1), arg_u(c, 2), arg(c, 3), arg_i(c, 4), 0);
}
GLS_HANDLER(glDrawElementsInstancedBaseVertex, ARRAY)
{
	draw_elements(x, st, c, arg_i(c, 1), arg_u(c, 2), arg(c, 3), arg_i(c, 4), (int32_t)arg_i(c, 5));
}
GLS_HANDLER(glDrawElementsInstancedBaseVertexBaseInstance, ARRAY)
{
	draw_elements(x, st, c, arg_i(c, 1), arg_u(c, 2), arg(c, 3), arg_i(c, 4), (int32_t)arg_i(c, 5));
}

/* ---- parameters in memory ---- */

enum { ARRAYS_WORDS = 4, ELEMENTS_WORDS = 5 }; /* words per command */

/* The bytes of draw commands: in the recording, or in the bound buffer. NULL: unknown (counted). */
static const uint8_t *find_commands(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned argument,
                                    uint64_t bytes)
{
	size_t n = 0;
	const uint8_t *found = arg_blob(c, argument, &n);
	struct gls_buffer *b = gls_buffer_find(st, st->client.indirect_buffer);

	if (!found && b && arg_is_offset(c, argument)) {
		uint64_t offset = (uint64_t)gls_value_int(arg(c, argument));

		found = offset < b->bytes ? b->data + offset : NULL;
		n = found ? b->bytes - offset : 0;
		gls_buffer_lacks(x, b);
	}
	if (found && n >= bytes)
		return found;
	gls_unsupported(x, "indirect draws whose parameters are not in the recording");
	return NULL;
}

static void draw_indirect(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned argument,
                          int elements, int64_t draws, int64_t stride)
{
	const uint64_t size = 4 * (elements ? ELEMENTS_WORDS : ARRAYS_WORDS);
	const uint8_t *commands;

	if (gls_refuses(x, st, draws < 0 || stride < 0 || stride % 4, GL_INVALID_VALUE))
		return;
	stride = stride ? stride : (int64_t)size;
	commands = draws && draws <= INT32_MAX && stride <= INT32_MAX ?
	           find_commands(x, st, c, argument, (uint64_t)(draws - 1) * (uint64_t)stride + size) : NULL;
	for (int64_t i = 0; commands && i < draws; i++) {
		uint32_t word[ELEMENTS_WORDS]; /* count, instances, first, [base vertex,] base instance */
		struct trace_value indices = { .type = TRACE_UINT };

		memcpy(word, commands + i * stride, size);
		if (!elements) {
			draw_arrays(x, st, arg_u(c, 0), word[2], word[0], word[1]);
			continue;
		}
		indices.i = (int64_t)word[2] * (arg_u(c, 1) == GL_UNSIGNED_BYTE ? 1 : arg_u(c, 1) == GL_UNSIGNED_SHORT ? 2 : 4);
		draw_elements(x, st, c, word[0], arg_u(c, 1), &indices, word[1], (int32_t)word[3]);
	}
}

GLS_HANDLER(glDrawArraysIndirect, ARRAY) { draw_indirect(x, st, c, 1, 0, 1, 0); }
GLS_HANDLER(glDrawElementsIndirect, ARRAY) { draw_indirect(x, st, c, 2, 1, 1, 0); }
GLS_HANDLER(glMultiDrawArraysIndirect, ARRAY) { draw_indirect(x, st, c, 1, 0, arg_i(c, 2), arg_i(c, 3)); }
GLS_HANDLER(glMultiDrawElementsIndirect, ARRAY) { draw_indirect(x, st, c, 2, 1, arg_i(c, 3), arg_i(c, 4)); }
