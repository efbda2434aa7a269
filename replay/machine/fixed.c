#include "replay/machine/fixed.h"

#include "gl_tokens.h"
#include "replay/machine/args.h"

/* 1 if a parameter's value is not a number (OpenGL ES 1.1 sec. 2.3: it is not converted). */
static int is_unscaled(uint32_t pname)
{
	switch (pname) {
	case GL_FOG_MODE:
	case GL_LIGHT_MODEL_TWO_SIDE:
	case GL_TEXTURE_ENV_MODE:
	case GL_COORD_REPLACE:
	case GL_TEXTURE_GEN_MODE:
	case GL_COMBINE_RGB: case GL_COMBINE_ALPHA: case GL_SRC0_RGB: case GL_SRC1_RGB: case GL_SRC2_RGB: case GL_SRC0_ALPHA:
	case GL_SRC1_ALPHA: case GL_SRC2_ALPHA: case GL_OPERAND0_RGB: case GL_OPERAND1_RGB: case GL_OPERAND2_RGB:
	case GL_OPERAND0_ALPHA:
	case GL_OPERAND1_ALPHA:
	case GL_OPERAND2_ALPHA:
	case GL_TEXTURE_MIN_FILTER:
	case GL_TEXTURE_MAG_FILTER:
	case GL_TEXTURE_WRAP_S:
	case GL_TEXTURE_WRAP_T:
	case GL_TEXTURE_WRAP_R:
	case GL_GENERATE_MIPMAP:
	case GL_TEXTURE_CROP_RECT_OES:
		return 1;
	default:
		return 0;
	}
}

static struct trace_value as_float(const struct trace_value *v)
{
	return (struct trace_value){ .type = TRACE_FLOAT, .f = (float)gls_value_int(v) / 65536.0f };
}

const struct call *gls_fixed_to_float(struct gls_fixed *room, const struct call *c, unsigned fixed)
{
	const unsigned first = (unsigned)__builtin_ctz(fixed);
	uint64_t n;

	if (c->n_args > GLS_FIXED_ARGS || (first && is_unscaled(arg_u(c, first - 1))))
		return c;
	room->call = *c;
	room->call.args = room->args;
	for (unsigned i = 0; i < c->n_args; i++) {
		room->args[i] = c->args[i];
		if (!(fixed >> i & 1))
			continue;
		if (c->args[i].type != TRACE_ARRAY) {
			if (c->args[i].type != TRACE_NONE && c->args[i].type != TRACE_NULL)
				room->args[i] = as_float(&c->args[i]);
			continue;
		}
		n = c->args[i].count < GLS_FIXED_ITEMS ? c->args[i].count : GLS_FIXED_ITEMS;
		for (uint64_t k = 0; k < n; k++)
			room->items[k] = as_float(&c->args[i].items[k]);
		room->args[i].items = room->items;
		room->args[i].count = n;
	}
	return &room->call;
}
