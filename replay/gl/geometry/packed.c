#include "replay/gl/geometry/packed.h"

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "replay/gl/geometry/pending.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

int gls_is_packed(uint32_t type)
{
	return type == GL_INT_2_10_10_10_REV || type == GL_UNSIGNED_INT_2_10_10_10_REV;
}

void gls_unpack_packed(uint32_t value, uint32_t type, uint32_t normalized, float out[4])
{
	const int is_signed = type == GL_INT_2_10_10_10_REV;

	for (unsigned i = 0; i < 4; i++) {
		const unsigned bits = i < 3 ? 10 : 2;
		const int32_t n = (int32_t)(value >> 10 * i & ((1u << bits) - 1));
		const int32_t number = is_signed && n >> (bits - 1) ? n - (1 << bits) : n;

		out[i] = (float)number;
		if (normalized)
			out[i] /= (float)((1 << (bits - (is_signed ? 1 : 0))) - 1);
		if (normalized && out[i] < -1)
			out[i] = -1;
	}
}

/* Arguments from `first` on: the type, then the number or an array of one. @return 0: not a valid type (GL error) */
static int read_packed(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned first, unsigned value,
                       uint32_t normalized, float out[4])
{
	uint32_t bits = 0;

	if (gls_refuses(x, st, !gls_is_packed(arg_u(c, first)), GL_INVALID_ENUM))
		return 0;
	arg_uints(c, value, &bits, 1);
	gls_unpack_packed(bits, arg_u(c, first), normalized, out);
	for (unsigned i = gls_commands[x->command].suffix.n; i < 4; i++)
		out[i] = i == 3;
	return 1;
}

static void attribute(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned a, uint32_t normalized)
{
	float value[4];

	if (read_packed(x, st, c, 0, 1, normalized, value))
		gls_set_attribute(x, st, a, value);
}

GLS_FAMILY(glColorP, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 1); }
GLS_FAMILY(glSecondaryColorP, VERTEX) { attribute(x, st, c, GLS_ATTR_SECONDARY, 1); }
GLS_FAMILY(glNormalP, VERTEX) { attribute(x, st, c, GLS_ATTR_NORMAL, 1); }
GLS_FAMILY(glTexCoordP, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 0); }

GLS_FAMILY(glMultiTexCoordP, VERTEX)
{
	uint32_t unit = arg_u(c, 0) - GL_TEXTURE0;
	float value[4];

	if (unit < GLS_MAX_UNITS && read_packed(x, st, c, 1, 2, 0, value))
		gls_set_attribute(x, st, GLS_ATTR_TEXCOORD + unit, value);
}

GLS_FAMILY(glVertexP, VERTEX)
{
	float value[4];

	if (read_packed(x, st, c, 0, 1, 0, value))
		gls_vertex(x, st, value);
}

GLS_FAMILY(glVertexAttribP, VERTEX, VERTEX_ATTRIB)
{
	float value[4];

	if (read_packed(x, st, c, 1, 3, arg_u(c, 2), value))
		gls_set_generic(x, st, arg_u(c, 0), value);
}
