/* Coordinate transformations (GL 2.1 sec. 2.11, 2.12). */
#include <string.h>

#include "gl_tokens.h"
#include "base/mat4.h"
#include "replay/gl/surface/drawable.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/state.h"

/* The current matrix, for modification. */
static float *change_matrix(struct gls_state *st)
{
	struct gls_matrix_stack *stack = gls_current_stack(st);

	if (st->a.transform.matrix_mode == GL_PROJECTION)
		st->dirty |= GLS_DIRTY_VIEW;
	else if (st->a.transform.matrix_mode == GL_TEXTURE)
		st->dirty |= GLS_DIRTY_MATERIAL;
	return stack->matrices[stack->depth];
}

static void multiply(struct gls_state *st, const float m[16])
{
	float *top = change_matrix(st);

	gls_sums(st)->mul(top, top, m);
}

/* Read 16 numbers; missing ones are those of the identity. */
static void read_matrix(const struct call *c, unsigned i, float m[16])
{
	memcpy(m, mat4_identity, 16 * sizeof(float));
	arg_floats(c, i, m, 16);
}

GLS_HANDLER(glMatrixMode, MATRIX, SELECT)
{
	uint32_t mode = arg_u(c, 0);

	if (gls_refuses(x, st, mode != GL_MODELVIEW && mode != GL_PROJECTION && mode != GL_TEXTURE && mode != GL_COLOR &&
	                mode - GL_MATRIX0_ARB >= GLS_MAX_PROGRAM_MATRICES, GL_INVALID_ENUM))
		return;
	st->a.transform.matrix_mode = mode;
}

GLS_HANDLER(glPushMatrix, MATRIX, PUSH_MATRIX)
{
	struct gls_matrix_stack *stack = gls_current_stack(st);

	if (gls_refuses(x, st, stack->depth + 1 >= stack->max, GL_STACK_OVERFLOW))
		return;
	memcpy(stack->matrices[stack->depth + 1], stack->matrices[stack->depth], 64);
	stack->depth++;
}

GLS_HANDLER(glPopMatrix, MATRIX, POP_MATRIX)
{
	struct gls_matrix_stack *stack = gls_current_stack(st);

	if (gls_refuses(x, st, stack->depth == 0, GL_STACK_UNDERFLOW))
		return;
	change_matrix(st);
	stack->depth--;
}

GLS_HANDLER(glLoadIdentity, MATRIX, TRANSFORM) { memcpy(change_matrix(st), mat4_identity, 64); }

GLS_FAMILY(glLoadMatrix, MATRIX, TRANSFORM) { read_matrix(c, 0, change_matrix(st)); }

GLS_FAMILY(glMultMatrix, MATRIX, TRANSFORM)
{
	float m[16];

	read_matrix(c, 0, m);
	multiply(st, m);
}

GLS_FAMILY(glLoadTransposeMatrix, MATRIX)
{
	float m[16];

	read_matrix(c, 0, m);
	mat4_transpose(change_matrix(st), m);
}

GLS_FAMILY(glMultTransposeMatrix, MATRIX)
{
	float m[16];

	read_matrix(c, 0, m);
	mat4_transpose(m, m);
	multiply(st, m);
}

GLS_FAMILY(glTranslate, MATRIX, TRANSFORM)
{
	gls_sums(st)->translate(change_matrix(st), arg_f(c, 0), arg_f(c, 1), arg_f(c, 2));
}

GLS_FAMILY(glScale, MATRIX, TRANSFORM)
{
	const float s[3] = { arg_f(c, 0), arg_f(c, 1), arg_f(c, 2) };
	float *m = change_matrix(st);

	for (unsigned column = 0; column < 3; column++)
		for (unsigned r = 0; r < 4; r++)
			m[4 * column + r] *= s[column];
}

GLS_FAMILY(glRotate, MATRIX, TRANSFORM)
{
	float m[16];

	if (arg_f(c, 0) == 0)
		return;
	gls_sums(st)->rotation(m, arg_f(c, 0), arg_f(c, 1), arg_f(c, 2), arg_f(c, 3));
	multiply(st, m);
}

/* Frustum and Ortho: left, right, bottom, top, near, far. */
static void project(struct gls_exec *x, struct gls_state *st, const struct call *c, int perspective)
{
	double v[6];
	float m[16];

	for (unsigned i = 0; i < 6; i++)
		v[i] = arg_d(c, i);
	if (gls_refuses(x, st,
	                (perspective && (v[4] <= 0 || v[5] <= 0)) || v[4] == v[5] || v[0] == v[1] || v[2] == v[3],
	                GL_INVALID_VALUE))
		return;
	(perspective ? gls_sums(st)->frustum : gls_sums(st)->ortho)(m, (float)v[0], (float)v[1], (float)v[2],
	                                                            (float)v[3], (float)v[4], (float)v[5]);
	multiply(st, m);
}

GLS_HANDLER(glFrustum, MATRIX) { project(x, st, c, 1); }
GLS_HANDLER(glOrtho, MATRIX) { project(x, st, c, 0); }

/* ---- viewport and clip planes ---- */

GLS_HANDLER(glViewport, STATE)
{
	float *rect = st->a.viewport.rect;
	struct gls_drawable *drawable = gls_drawable_of(x, st->drawable);

	if (gls_refuses(x, st, arg_i(c, 2) < 0 || arg_i(c, 3) < 0, GL_INVALID_VALUE))
		return;
	for (unsigned i = 0; i < 4; i++)
		rect[i] = (float)arg_i(c, i);
	/* In traces of other recorders this is the only information on the window's size; see trace.md. */
	if (drawable && !drawable->fixed && !st->draw_framebuffer && rect[0] >= 0 && rect[1] >= 0) {
		if (rect[0] + rect[2] > (float)drawable->width && rect[0] + rect[2] <= 16384)
			drawable->width = (uint32_t)(rect[0] + rect[2]);
		if (rect[1] + rect[3] > (float)drawable->height && rect[1] + rect[3] <= 16384)
			drawable->height = (uint32_t)(rect[1] + rect[3]);
	}
}

GLS_HANDLER(glDepthRange, STATE)
{
	st->a.viewport.depth_range[0] = arg_clamped(c, 0);
	st->a.viewport.depth_range[1] = arg_clamped(c, 1);
}

GLS_HANDLER(glClipPlane, STATE)
{
	uint32_t plane = arg_u(c, 0) - GL_CLIP_PLANE0;
	float equation[4] = { 0 }, inverse[16];

	if (gls_refuses(x, st, plane >= GLS_MAX_CLIP_PLANES, GL_INVALID_ENUM))
		return;
	arg_floats(c, 1, equation, 4);
	mat4_invert(inverse, st->modelview.matrices[st->modelview.depth]);
	gls_sums(st)->transform_plane(st->a.transform.clip_plane_eye[plane], equation, inverse);
}
