/* Begin/End and vertex attributes (GL 2.1 sec. 2.6, 2.7). */

#include "gl_tokens.h"
#include "base/norm.h"
#include "capture/format/call.h"
#include "replay/gl/geometry/pending.h"
#include "replay/gl/geometry/waiting.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

GLS_HANDLER(glBegin, INSIDE, BEGIN) { gls_begin(x, st, arg_u(c, 0)); }
GLS_HANDLER(glEnd, INSIDE, END) { gls_end(x, st); }
GLS_HANDLER(glPrimitiveRestartNV, INSIDE) { gls_restart(x, st); }

GLS_HANDLER(glEdgeFlag, VERTEX, EDGE_FLAG) { st->a.current.edge_flag = arg_i(c, 0) != 0; }
GLS_HANDLER(glEdgeFlagv, VERTEX, EDGE_FLAG) { st->a.current.edge_flag = arg_i(c, 0) != 0; }

/* Rect is a polygon with four corners (sec. 2.10). Mesa draws it as a quad between Begin and End. */
GLS_FAMILY(glRect, INSIDE)
{
	float a[2] = { arg_f(c, 0), arg_f(c, 1) }, b[2] = { arg_f(c, 2), arg_f(c, 3) };

	if (gls_refuses(x, st, st->begin_mode, GL_INVALID_OPERATION))
		return;
	gls_draw_pending(x);
	if (gls_commands[x->command].suffix.array) {
		a[0] = a[1] = b[0] = b[1] = 0;
		arg_floats(c, 0, a, 2);
		arg_floats(c, 1, b, 2);
	}
	const float corners[4][4] = { { a[0], a[1], 0, 1 }, { b[0], a[1], 0, 1 }, { b[0], b[1], 0, 1 }, { a[0], b[1], 0, 1 } };
	gls_begin(x, st, GL_QUADS);
	for (unsigned i = 0; i < 4; i++)
		gls_vertex(x, st, corners[i]);
	gls_end(x, st);
}

/* Table 2.9: map an integer to [0,1] or [-1,1]. `value` is `exact` as a float. */
static float normalize(float value, double exact, enum gls_suffix_type type)
{
	switch (type) {
	case GLS_SUFFIX_B: return (float)((2 * exact + 1) / 255);
	case GLS_SUFFIX_UB: return value / 255.0f;
	case GLS_SUFFIX_S: return (float)((2 * exact + 1) / 65535);
	case GLS_SUFFIX_US: return (float)(exact / 65535);
	case GLS_SUFFIX_I: return norm_int(exact);
	case GLS_SUFFIX_UI: return (float)(exact / 4294967295.0);
	default: return value;
	}
}

/*
 * Read as many components as the command's suffix says, from argument `first` on. The others are those of (0, 0, 0, 1).
 * Inlined because it runs for every vertex, and most families need only a part of it.
 */
static inline __attribute__((always_inline)) void
read_components(const struct gls_exec *x, const struct call *c, unsigned first, int normalized, float out[4])
{
	const struct gls_suffix suffix = gls_commands[x->command].suffix;
	const struct trace_value *items = NULL;
	uint64_t n = suffix.n;

	out[0] = out[1] = out[2] = 0;
	out[3] = 1;
	if (suffix.array)
		arg_floats(c, first, out, suffix.n);
	for (unsigned i = 0; i < suffix.n && !suffix.array; i++)
		out[i] = arg_f(c, first + i);
	if (!normalized || suffix.type == GLS_SUFFIX_F || suffix.type == GLS_SUFFIX_D)
		return;
	if (suffix.array)
		items = arg_items(c, first, &n);
	for (unsigned i = 0; i < suffix.n && i < n; i++)
		out[i] = normalize(out[i], items ? gls_value_double(&items[i]) : arg_d(c, first + i), suffix.type);
}

/* 1 if a list of the program is called or assembled, as opposed to a list that the recorder made of a run of calls. */
static int is_of_list(const struct gls_exec *x)
{
	return x->drawn_list && (x->drawn_list < CALL_RUN_LAST || x->drawn_list > CALL_RUN_FIRST);
}

/*
 * Set an attribute by a command; lists store attributes in another way. Mesa (22.3.6, api_loopback.c) makes glColor4f
 * of glColor3 with other types than float.
 */
static void set_components(struct gls_exec *x, struct gls_state *st, unsigned a, float value[4])
{
	const struct gls_suffix suffix = gls_commands[x->command].suffix;
	const int is_all = a == GLS_ATTR_COLOR && suffix.type != GLS_SUFFIX_F;

	if (!is_of_list(x) && gls_is_mesa(st))
		gls_waiting_components(st, a, is_all ? 4 : suffix.n, value);
	gls_set_attribute(x, st, a, value);
}

static void attribute(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned a, int normalized)
{
	float value[4];

	read_components(x, c, 0, normalized, value);
	set_components(x, st, a, value);
}

GLS_FAMILY(glColor, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 1); }
GLS_FAMILY(glSecondaryColor, VERTEX) { attribute(x, st, c, GLS_ATTR_SECONDARY, 1); }
GLS_FAMILY(glNormal, VERTEX) { attribute(x, st, c, GLS_ATTR_NORMAL, 1); }
GLS_FAMILY(glFogCoord, VERTEX) { attribute(x, st, c, GLS_ATTR_FOG_COORD, 0); }
GLS_FAMILY(glTexCoord, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 0); }
GLS_FAMILY(glIndex, VERTEX) { st->a.current.index = arg_f(c, 0); }

GLS_FAMILY(glMultiTexCoord, VERTEX)
{
	uint32_t unit = arg_u(c, 0) - GL_TEXTURE0;
	float value[4];

	if (unit >= GLS_MAX_UNITS)
		return; /* undefined (sec. 2.7); Mesa wraps it */
	read_components(x, c, 1, 0, value);
	set_components(x, st, GLS_ATTR_TEXCOORD + unit, value);
}

GLS_FAMILY(glVertex, VERTEX)
{
	float value[4];

	if (!gls_takes_vertices(x, st))
		return;
	read_components(x, c, 0, 0, value);
	gls_vertex(x, st, value);
}

/*
 * Between Begin and End, generic attribute 0 is the vertex (sec. 2.7). Elsewhere, like the other attributes, it is for
 * vertex programs.
 */
GLS_FAMILY(glVertexAttrib, VERTEX, VERTEX_ATTRIB)
{
	float value[4];

	if (arg_u(c, 0) == 0 && st->begin_mode && !x->want)
		return;
	read_components(x, c, 1, gls_commands[x->command].suffix.normalized, value);
	gls_set_generic(x, st, arg_u(c, 0), value);
}
