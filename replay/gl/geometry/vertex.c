/* Begin/End and vertex attributes (GL 2.1 sec. 2.6, 2.7). */
#include <string.h>

#include "gl_tokens.h"
#include "base/norm.h"
#include "capture/format/call.h"
#include "replay/gl/geometry/pending.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/state.h"

GLS_HANDLER(glBegin, INSIDE, BEGIN) { gls_begin(x, st, arg_u(c, 0)); }
GLS_HANDLER(glEnd, INSIDE, END) { gls_end(x, st); }
GLS_HANDLER(glPrimitiveRestartNV, INSIDE) { gls_restart(x, st); }

GLS_HANDLER(glEdgeFlag, VERTEX, EDGE_FLAG)
{
	st->a.current.edge_flag = arg_i(c, 0) != 0;
}
GLS_HANDLER(glEdgeFlagv, VERTEX, EDGE_FLAG)
{
	st->a.current.edge_flag = gls_value_int(arg(c, 0)) != 0;
}

/* ---- Rect: a polygon of four corners (sec. 2.10), which Mesa draws as a quad ---- */

static void rect(struct gls_exec *x, struct gls_state *st, float x1, float y1, float x2, float y2)
{
	const float corners[4][4] = { { x1, y1, 0, 1 }, { x2, y1, 0, 1 }, { x2, y2, 0, 1 }, { x1, y2, 0, 1 } };

	gls_begin(x, st, GL_QUADS);
	for (unsigned i = 0; i < 4; i++)
		gls_vertex(x, st, corners[i]);
	gls_end(x, st);
}

static void rect_v(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	float a[2] = { 0 }, b[2] = { 0 };

	arg_floats(c, 0, a, 2);
	arg_floats(c, 1, b, 2);
	rect(x, st, a[0], a[1], b[0], b[1]);
}

GLS_HANDLER(glRectf, STATE) { rect(x, st, arg_f(c, 0), arg_f(c, 1), arg_f(c, 2), arg_f(c, 3)); }
GLS_HANDLER(glRectd, STATE) { rect(x, st, arg_f(c, 0), arg_f(c, 1), arg_f(c, 2), arg_f(c, 3)); }
GLS_HANDLER(glRecti, STATE) { rect(x, st, arg_f(c, 0), arg_f(c, 1), arg_f(c, 2), arg_f(c, 3)); }
GLS_HANDLER(glRects, STATE) { rect(x, st, arg_f(c, 0), arg_f(c, 1), arg_f(c, 2), arg_f(c, 3)); }
GLS_HANDLER(glRectfv, STATE) { rect_v(x, st, c); }
GLS_HANDLER(glRectdv, STATE) { rect_v(x, st, c); }
GLS_HANDLER(glRectiv, STATE) { rect_v(x, st, c); }
GLS_HANDLER(glRectsv, STATE) { rect_v(x, st, c); }

/*
 * ---- one line per command ----
 *
 * What differs is the number of components, whether they come one by one or as an array, and how integers become floats
 * (table 2.9): colours and normals are normalized, everything else is converted as it is.
 */
enum conversion { AS_IS, BYTE, UBYTE, SHORT, USHORT, INT, UINT };

static float convert(float value, double exact, enum conversion how)
{
	switch (how) {
	case BYTE:
		return (float)((2 * exact + 1) / 255);
	case UBYTE:
		return value / 255.0f;
	case SHORT:
		return (float)((2 * exact + 1) / 65535);
	case USHORT:
		return (float)(exact / 65535);
	case INT:
		return norm_int(exact);
	case UINT:
		return (float)(exact / 4294967295.0);
	default:
		return value;
	}
}

static void read_plain(const struct call *c, unsigned first, unsigned n, enum conversion how, float out[4])
{
	for (unsigned i = 0; i < n; i++)
		out[i] = how == AS_IS ? arg_f(c, first + i) : convert(arg_f(c, first + i), arg_d(c, first + i), how);
}

static void read_array(const struct call *c, unsigned index, unsigned n, enum conversion how, float out[4])
{
	arg_floats(c, index, out, n);
	if (how == AS_IS)
		return;
	uint64_t count;
	const struct trace_value *items = arg_items(c, index, &count);
	for (unsigned i = 0; i < n && i < count; i++)
		out[i] = convert(out[i], gls_value_double(&items[i]), how);
}

static void attribute(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned a, unsigned n,
                      enum conversion how)
{
	float value[4] = { 0, 0, 0, 1 };

	read_plain(c, 0, n, how, value);
	gls_set_attribute(x, st, a, value);
}

static void attribute_v(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned a, unsigned n,
                        enum conversion how)
{
	float value[4] = { 0, 0, 0, 1 };

	read_array(c, 0, n, how, value);
	gls_set_attribute(x, st, a, value);
}

static void vertex(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n)
{
	float value[4] = { 0, 0, 0, 1 };

	read_plain(c, 0, n, AS_IS, value);
	gls_vertex(x, st, value);
}

static void vertex_v(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n)
{
	float value[4] = { 0, 0, 0, 1 };

	read_array(c, 0, n, AS_IS, value);
	gls_vertex(x, st, value);
}

static void multi(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n, int array)
{
	float value[4] = { 0, 0, 0, 1 };
	uint32_t unit = arg_u(c, 0) - GL_TEXTURE0;

	if (unit >= GLS_MAX_UNITS)
		return; /* undefined (sec. 2.7); Mesa wraps it round */
	if (array)
		read_array(c, 1, n, AS_IS, value);
	else
		read_plain(c, 1, n, AS_IS, value);
	gls_set_attribute(x, st, GLS_ATTR_TEXCOORD + unit, value);
}

/* Generic attributes of shaders: 0 is the vertex (sec. 2.7); the others feed programs only. */
static void generic(struct gls_exec *x, struct gls_state *st, const struct call *c, unsigned n, int array,
                    enum conversion how)
{
	float value[4] = { 0, 0, 0, 1 };

	if (arg_u(c, 0) != 0)
		return;
	if (array)
		read_array(c, 1, n, how, value);
	else
		read_plain(c, 1, n, how, value);
	gls_vertex(x, st, value);
}

GLS_HANDLER(glVertex2d, VERTEX) { vertex(x, st, c, 2); }
GLS_HANDLER(glVertex2dv, VERTEX) { vertex_v(x, st, c, 2); }
GLS_HANDLER(glVertex2f, VERTEX) { vertex(x, st, c, 2); }
GLS_HANDLER(glVertex2fv, VERTEX) { vertex_v(x, st, c, 2); }
GLS_HANDLER(glVertex2i, VERTEX) { vertex(x, st, c, 2); }
GLS_HANDLER(glVertex2iv, VERTEX) { vertex_v(x, st, c, 2); }
GLS_HANDLER(glVertex2s, VERTEX) { vertex(x, st, c, 2); }
GLS_HANDLER(glVertex2sv, VERTEX) { vertex_v(x, st, c, 2); }
GLS_HANDLER(glVertex3d, VERTEX) { vertex(x, st, c, 3); }
GLS_HANDLER(glVertex3dv, VERTEX) { vertex_v(x, st, c, 3); }
GLS_HANDLER(glVertex3f, VERTEX) { vertex(x, st, c, 3); }
GLS_HANDLER(glVertex3fv, VERTEX) { vertex_v(x, st, c, 3); }
GLS_HANDLER(glVertex3i, VERTEX) { vertex(x, st, c, 3); }
GLS_HANDLER(glVertex3iv, VERTEX) { vertex_v(x, st, c, 3); }
GLS_HANDLER(glVertex3s, VERTEX) { vertex(x, st, c, 3); }
GLS_HANDLER(glVertex3sv, VERTEX) { vertex_v(x, st, c, 3); }
GLS_HANDLER(glVertex4d, VERTEX) { vertex(x, st, c, 4); }
GLS_HANDLER(glVertex4dv, VERTEX) { vertex_v(x, st, c, 4); }
GLS_HANDLER(glVertex4f, VERTEX) { vertex(x, st, c, 4); }
GLS_HANDLER(glVertex4fv, VERTEX) { vertex_v(x, st, c, 4); }
GLS_HANDLER(glVertex4i, VERTEX) { vertex(x, st, c, 4); }
GLS_HANDLER(glVertex4iv, VERTEX) { vertex_v(x, st, c, 4); }
GLS_HANDLER(glVertex4s, VERTEX) { vertex(x, st, c, 4); }
GLS_HANDLER(glVertex4sv, VERTEX) { vertex_v(x, st, c, 4); }
GLS_HANDLER(glColor3b, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 3, BYTE); }
GLS_HANDLER(glColor3bv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 3, BYTE); }
GLS_HANDLER(glColor3ub, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 3, UBYTE); }
GLS_HANDLER(glColor3ubv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 3, UBYTE); }
GLS_HANDLER(glColor3s, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 3, SHORT); }
GLS_HANDLER(glColor3sv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 3, SHORT); }
GLS_HANDLER(glColor3us, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 3, USHORT); }
GLS_HANDLER(glColor3usv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 3, USHORT); }
GLS_HANDLER(glColor3i, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 3, INT); }
GLS_HANDLER(glColor3iv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 3, INT); }
GLS_HANDLER(glColor3ui, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 3, UINT); }
GLS_HANDLER(glColor3uiv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 3, UINT); }
GLS_HANDLER(glColor3f, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 3, AS_IS); }
GLS_HANDLER(glColor3fv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 3, AS_IS); }
GLS_HANDLER(glColor3d, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 3, AS_IS); }
GLS_HANDLER(glColor3dv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 3, AS_IS); }
GLS_HANDLER(glColor4b, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 4, BYTE); }
GLS_HANDLER(glColor4bv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 4, BYTE); }
GLS_HANDLER(glColor4ub, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 4, UBYTE); }
GLS_HANDLER(glColor4ubv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 4, UBYTE); }
GLS_HANDLER(glColor4s, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 4, SHORT); }
GLS_HANDLER(glColor4sv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 4, SHORT); }
GLS_HANDLER(glColor4us, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 4, USHORT); }
GLS_HANDLER(glColor4usv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 4, USHORT); }
GLS_HANDLER(glColor4i, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 4, INT); }
GLS_HANDLER(glColor4iv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 4, INT); }
GLS_HANDLER(glColor4ui, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 4, UINT); }
GLS_HANDLER(glColor4uiv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 4, UINT); }
GLS_HANDLER(glColor4f, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 4, AS_IS); }
GLS_HANDLER(glColor4fv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 4, AS_IS); }
GLS_HANDLER(glColor4d, VERTEX) { attribute(x, st, c, GLS_ATTR_COLOR, 4, AS_IS); }
GLS_HANDLER(glColor4dv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_COLOR, 4, AS_IS); }
GLS_HANDLER(glSecondaryColor3b, VERTEX) { attribute(x, st, c, GLS_ATTR_SECONDARY, 3, BYTE); }
GLS_HANDLER(glSecondaryColor3bv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_SECONDARY, 3, BYTE); }
GLS_HANDLER(glSecondaryColor3ub, VERTEX) { attribute(x, st, c, GLS_ATTR_SECONDARY, 3, UBYTE); }
GLS_HANDLER(glSecondaryColor3ubv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_SECONDARY, 3, UBYTE); }
GLS_HANDLER(glSecondaryColor3s, VERTEX) { attribute(x, st, c, GLS_ATTR_SECONDARY, 3, SHORT); }
GLS_HANDLER(glSecondaryColor3sv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_SECONDARY, 3, SHORT); }
GLS_HANDLER(glSecondaryColor3us, VERTEX) { attribute(x, st, c, GLS_ATTR_SECONDARY, 3, USHORT); }
GLS_HANDLER(glSecondaryColor3usv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_SECONDARY, 3, USHORT); }
GLS_HANDLER(glSecondaryColor3i, VERTEX) { attribute(x, st, c, GLS_ATTR_SECONDARY, 3, INT); }
GLS_HANDLER(glSecondaryColor3iv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_SECONDARY, 3, INT); }
GLS_HANDLER(glSecondaryColor3ui, VERTEX) { attribute(x, st, c, GLS_ATTR_SECONDARY, 3, UINT); }
GLS_HANDLER(glSecondaryColor3uiv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_SECONDARY, 3, UINT); }
GLS_HANDLER(glSecondaryColor3f, VERTEX) { attribute(x, st, c, GLS_ATTR_SECONDARY, 3, AS_IS); }
GLS_HANDLER(glSecondaryColor3fv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_SECONDARY, 3, AS_IS); }
GLS_HANDLER(glSecondaryColor3d, VERTEX) { attribute(x, st, c, GLS_ATTR_SECONDARY, 3, AS_IS); }
GLS_HANDLER(glSecondaryColor3dv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_SECONDARY, 3, AS_IS); }
GLS_HANDLER(glNormal3b, VERTEX) { attribute(x, st, c, GLS_ATTR_NORMAL, 3, BYTE); }
GLS_HANDLER(glNormal3bv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_NORMAL, 3, BYTE); }
GLS_HANDLER(glNormal3s, VERTEX) { attribute(x, st, c, GLS_ATTR_NORMAL, 3, SHORT); }
GLS_HANDLER(glNormal3sv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_NORMAL, 3, SHORT); }
GLS_HANDLER(glNormal3i, VERTEX) { attribute(x, st, c, GLS_ATTR_NORMAL, 3, INT); }
GLS_HANDLER(glNormal3iv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_NORMAL, 3, INT); }
GLS_HANDLER(glNormal3f, VERTEX) { attribute(x, st, c, GLS_ATTR_NORMAL, 3, AS_IS); }
GLS_HANDLER(glNormal3fv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_NORMAL, 3, AS_IS); }
GLS_HANDLER(glNormal3d, VERTEX) { attribute(x, st, c, GLS_ATTR_NORMAL, 3, AS_IS); }
GLS_HANDLER(glNormal3dv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_NORMAL, 3, AS_IS); }
GLS_HANDLER(glFogCoordf, VERTEX) { attribute(x, st, c, GLS_ATTR_FOG_COORD, 1, AS_IS); }
GLS_HANDLER(glFogCoordfv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_FOG_COORD, 1, AS_IS); }
GLS_HANDLER(glFogCoordd, VERTEX) { attribute(x, st, c, GLS_ATTR_FOG_COORD, 1, AS_IS); }
GLS_HANDLER(glFogCoorddv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_FOG_COORD, 1, AS_IS); }
GLS_HANDLER(glTexCoord1d, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 1, AS_IS); }
GLS_HANDLER(glTexCoord1dv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 1, AS_IS); }
GLS_HANDLER(glMultiTexCoord1d, VERTEX) { multi(x, st, c, 1, 0); }
GLS_HANDLER(glMultiTexCoord1dv, VERTEX) { multi(x, st, c, 1, 1); }
GLS_HANDLER(glTexCoord1f, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 1, AS_IS); }
GLS_HANDLER(glTexCoord1fv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 1, AS_IS); }
GLS_HANDLER(glMultiTexCoord1f, VERTEX) { multi(x, st, c, 1, 0); }
GLS_HANDLER(glMultiTexCoord1fv, VERTEX) { multi(x, st, c, 1, 1); }
GLS_HANDLER(glTexCoord1i, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 1, AS_IS); }
GLS_HANDLER(glTexCoord1iv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 1, AS_IS); }
GLS_HANDLER(glMultiTexCoord1i, VERTEX) { multi(x, st, c, 1, 0); }
GLS_HANDLER(glMultiTexCoord1iv, VERTEX) { multi(x, st, c, 1, 1); }
GLS_HANDLER(glTexCoord1s, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 1, AS_IS); }
GLS_HANDLER(glTexCoord1sv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 1, AS_IS); }
GLS_HANDLER(glMultiTexCoord1s, VERTEX) { multi(x, st, c, 1, 0); }
GLS_HANDLER(glMultiTexCoord1sv, VERTEX) { multi(x, st, c, 1, 1); }
GLS_HANDLER(glTexCoord2d, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 2, AS_IS); }
GLS_HANDLER(glTexCoord2dv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 2, AS_IS); }
GLS_HANDLER(glMultiTexCoord2d, VERTEX) { multi(x, st, c, 2, 0); }
GLS_HANDLER(glMultiTexCoord2dv, VERTEX) { multi(x, st, c, 2, 1); }
GLS_HANDLER(glTexCoord2f, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 2, AS_IS); }
GLS_HANDLER(glTexCoord2fv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 2, AS_IS); }
GLS_HANDLER(glMultiTexCoord2f, VERTEX) { multi(x, st, c, 2, 0); }
GLS_HANDLER(glMultiTexCoord2fv, VERTEX) { multi(x, st, c, 2, 1); }
GLS_HANDLER(glTexCoord2i, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 2, AS_IS); }
GLS_HANDLER(glTexCoord2iv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 2, AS_IS); }
GLS_HANDLER(glMultiTexCoord2i, VERTEX) { multi(x, st, c, 2, 0); }
GLS_HANDLER(glMultiTexCoord2iv, VERTEX) { multi(x, st, c, 2, 1); }
GLS_HANDLER(glTexCoord2s, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 2, AS_IS); }
GLS_HANDLER(glTexCoord2sv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 2, AS_IS); }
GLS_HANDLER(glMultiTexCoord2s, VERTEX) { multi(x, st, c, 2, 0); }
GLS_HANDLER(glMultiTexCoord2sv, VERTEX) { multi(x, st, c, 2, 1); }
GLS_HANDLER(glTexCoord3d, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 3, AS_IS); }
GLS_HANDLER(glTexCoord3dv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 3, AS_IS); }
GLS_HANDLER(glMultiTexCoord3d, VERTEX) { multi(x, st, c, 3, 0); }
GLS_HANDLER(glMultiTexCoord3dv, VERTEX) { multi(x, st, c, 3, 1); }
GLS_HANDLER(glTexCoord3f, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 3, AS_IS); }
GLS_HANDLER(glTexCoord3fv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 3, AS_IS); }
GLS_HANDLER(glMultiTexCoord3f, VERTEX) { multi(x, st, c, 3, 0); }
GLS_HANDLER(glMultiTexCoord3fv, VERTEX) { multi(x, st, c, 3, 1); }
GLS_HANDLER(glTexCoord3i, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 3, AS_IS); }
GLS_HANDLER(glTexCoord3iv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 3, AS_IS); }
GLS_HANDLER(glMultiTexCoord3i, VERTEX) { multi(x, st, c, 3, 0); }
GLS_HANDLER(glMultiTexCoord3iv, VERTEX) { multi(x, st, c, 3, 1); }
GLS_HANDLER(glTexCoord3s, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 3, AS_IS); }
GLS_HANDLER(glTexCoord3sv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 3, AS_IS); }
GLS_HANDLER(glMultiTexCoord3s, VERTEX) { multi(x, st, c, 3, 0); }
GLS_HANDLER(glMultiTexCoord3sv, VERTEX) { multi(x, st, c, 3, 1); }
GLS_HANDLER(glTexCoord4d, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 4, AS_IS); }
GLS_HANDLER(glTexCoord4dv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 4, AS_IS); }
GLS_HANDLER(glMultiTexCoord4d, VERTEX) { multi(x, st, c, 4, 0); }
GLS_HANDLER(glMultiTexCoord4dv, VERTEX) { multi(x, st, c, 4, 1); }
GLS_HANDLER(glTexCoord4f, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 4, AS_IS); }
GLS_HANDLER(glTexCoord4fv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 4, AS_IS); }
GLS_HANDLER(glMultiTexCoord4f, VERTEX) { multi(x, st, c, 4, 0); }
GLS_HANDLER(glMultiTexCoord4fv, VERTEX) { multi(x, st, c, 4, 1); }
GLS_HANDLER(glTexCoord4i, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 4, AS_IS); }
GLS_HANDLER(glTexCoord4iv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 4, AS_IS); }
GLS_HANDLER(glMultiTexCoord4i, VERTEX) { multi(x, st, c, 4, 0); }
GLS_HANDLER(glMultiTexCoord4iv, VERTEX) { multi(x, st, c, 4, 1); }
GLS_HANDLER(glTexCoord4s, VERTEX) { attribute(x, st, c, GLS_ATTR_TEXCOORD, 4, AS_IS); }
GLS_HANDLER(glTexCoord4sv, VERTEX) { attribute_v(x, st, c, GLS_ATTR_TEXCOORD, 4, AS_IS); }
GLS_HANDLER(glMultiTexCoord4s, VERTEX) { multi(x, st, c, 4, 0); }
GLS_HANDLER(glMultiTexCoord4sv, VERTEX) { multi(x, st, c, 4, 1); }
GLS_HANDLER(glVertexAttrib1d, VERTEX) { generic(x, st, c, 1, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib1dv, VERTEX) { generic(x, st, c, 1, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib1f, VERTEX) { generic(x, st, c, 1, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib1fv, VERTEX) { generic(x, st, c, 1, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib1s, VERTEX) { generic(x, st, c, 1, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib1sv, VERTEX) { generic(x, st, c, 1, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib2d, VERTEX) { generic(x, st, c, 2, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib2dv, VERTEX) { generic(x, st, c, 2, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib2f, VERTEX) { generic(x, st, c, 2, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib2fv, VERTEX) { generic(x, st, c, 2, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib2s, VERTEX) { generic(x, st, c, 2, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib2sv, VERTEX) { generic(x, st, c, 2, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib3d, VERTEX) { generic(x, st, c, 3, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib3dv, VERTEX) { generic(x, st, c, 3, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib3f, VERTEX) { generic(x, st, c, 3, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib3fv, VERTEX) { generic(x, st, c, 3, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib3s, VERTEX) { generic(x, st, c, 3, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib3sv, VERTEX) { generic(x, st, c, 3, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib4d, VERTEX) { generic(x, st, c, 4, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib4dv, VERTEX) { generic(x, st, c, 4, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib4f, VERTEX) { generic(x, st, c, 4, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib4fv, VERTEX) { generic(x, st, c, 4, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib4s, VERTEX) { generic(x, st, c, 4, 0, AS_IS); }
GLS_HANDLER(glVertexAttrib4sv, VERTEX) { generic(x, st, c, 4, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib4bv, VERTEX) { generic(x, st, c, 4, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib4ubv, VERTEX) { generic(x, st, c, 4, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib4usv, VERTEX) { generic(x, st, c, 4, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib4iv, VERTEX) { generic(x, st, c, 4, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib4uiv, VERTEX) { generic(x, st, c, 4, 1, AS_IS); }
GLS_HANDLER(glVertexAttrib4Nbv, VERTEX) { generic(x, st, c, 4, 1, BYTE); }
GLS_HANDLER(glVertexAttrib4Nubv, VERTEX) { generic(x, st, c, 4, 1, UBYTE); }
GLS_HANDLER(glVertexAttrib4Nsv, VERTEX) { generic(x, st, c, 4, 1, SHORT); }
GLS_HANDLER(glVertexAttrib4Nusv, VERTEX) { generic(x, st, c, 4, 1, USHORT); }
GLS_HANDLER(glVertexAttrib4Niv, VERTEX) { generic(x, st, c, 4, 1, INT); }
GLS_HANDLER(glVertexAttrib4Nuiv, VERTEX) { generic(x, st, c, 4, 1, UINT); }
GLS_HANDLER(glVertexAttrib4Nub, VERTEX) { generic(x, st, c, 4, 0, UBYTE); }
GLS_HANDLER(glIndexd, VERTEX) { st->a.current.index = arg_f(c, 0); }
GLS_HANDLER(glIndexdv, VERTEX) { st->a.current.index = arg_f(c, 0); }
GLS_HANDLER(glIndexf, VERTEX) { st->a.current.index = arg_f(c, 0); }
GLS_HANDLER(glIndexfv, VERTEX) { st->a.current.index = arg_f(c, 0); }
GLS_HANDLER(glIndexi, VERTEX) { st->a.current.index = arg_f(c, 0); }
GLS_HANDLER(glIndexiv, VERTEX) { st->a.current.index = arg_f(c, 0); }
GLS_HANDLER(glIndexs, VERTEX) { st->a.current.index = arg_f(c, 0); }
GLS_HANDLER(glIndexsv, VERTEX) { st->a.current.index = arg_f(c, 0); }
GLS_HANDLER(glIndexub, VERTEX) { st->a.current.index = arg_f(c, 0); }
GLS_HANDLER(glIndexubv, VERTEX) { st->a.current.index = arg_f(c, 0); }
