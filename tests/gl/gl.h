/*
 * Calls into the state machine, without a trace, for the tests of tests/gl: calls in, facts about state or scene out.
 *
 *     struct gl gl = gl_open();                    a context, made current, drawable 64x64
 *     gl_call(&gl, "glRotatef", "ffff", 90.0, 0.0, 0.0, 1.0);
 *     struct scene *s = gl_swap(&gl);              the frame's scene; scene_release
 *     gl_close(&gl);
 *
 * Letters of a call's arguments: f float, d double, i signed, u unsigned, e enum, m bitmask, p address (uint64_t; 0 is
 * NULL), s string, S an array of one string, F n floats (int, const float *), D n doubles, U n unsigned (int, const
 * uint32_t *), b bytes (size_t, const void *).
 */
#pragma once

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "replay/gl/dispatch.h"
#include "replay/machine/commands.h"
#include "replay/machine/machine.h"
#include "replay/replay.h"
#include "scene/release.h"
#include "tests/case.h"
#include "replay/gl/surface/frames.h"

#define GL_MAX_ARGS 16

struct gl {
	struct gls_exec *x;
	uint64_t number;
};

static inline void gl_value(struct trace_value *v, char letter, va_list *args)
{
	static struct trace_value items[GL_MAX_ARGS][1024];
	static unsigned next;
	int n;

	memset(v, 0, sizeof(*v));
	switch (letter) {
	case 'f':
		*v = (struct trace_value){ .type = TRACE_FLOAT, .f = (float)va_arg(*args, double) };
		break;
	case 'd':
		*v = (struct trace_value){ .type = TRACE_DOUBLE, .d = va_arg(*args, double) };
		break;
	case 'i':
		n = va_arg(*args, int);
		*v = (struct trace_value){ .type = n < 0 ? TRACE_SINT : TRACE_UINT, .i = n };
		break;
	case 'u':
		*v = (struct trace_value){ .type = TRACE_UINT, .u = va_arg(*args, unsigned) };
		break;
	case 'e':
		*v = (struct trace_value){ .type = TRACE_ENUM, .i = va_arg(*args, unsigned) };
		break;
	case 'm':
		*v = (struct trace_value){ .type = TRACE_BITMASK, .u = va_arg(*args, unsigned) };
		break;
	case 'p':
		v->u = va_arg(*args, uint64_t);
		v->type = v->u ? TRACE_OPAQUE : TRACE_NULL;
		break;
	case 's':
		v->type = TRACE_STRING;
		v->str = va_arg(*args, const char *);
		v->count = strlen(v->str);
		break;
	case 'S':
		*v = (struct trace_value){ .type = TRACE_ARRAY, .count = 1, .items = items[next % GL_MAX_ARGS] };
		gl_value(items[next++ % GL_MAX_ARGS], 's', args);
		break;
	case 'b':
		v->type = TRACE_BLOB;
		v->count = va_arg(*args, size_t);
		v->blob = va_arg(*args, const void *);
		break;
	case 'F':
	case 'D':
	case 'U':
		n = va_arg(*args, int);
		const void *numbers = va_arg(*args, const void *);
		struct trace_value *to = items[next++ % GL_MAX_ARGS];
		ck_assert_int_le(n, 1024);
		for (int i = 0; i < n; i++)
			to[i] = letter == 'F'   ? (struct trace_value){ .type = TRACE_FLOAT, .f = ((const float *)numbers)[i] }
			        : letter == 'D' ? (struct trace_value){ .type = TRACE_DOUBLE, .d = ((const double *)numbers)[i] }
			                        : (struct trace_value){ .type = TRACE_UINT, .u = ((const uint32_t *)numbers)[i] };
		*v = (struct trace_value){ .type = TRACE_ARRAY, .count = (uint64_t)n, .items = to };
		break;
	default:
		ck_abort_msg("no argument letter %c", letter);
	}
}

/** Make a call that returns `ret`. */
static inline void gl_call_ret(struct gl *gl, struct trace_value ret, const char *name, const char *letters,
                               va_list *args)
{
	struct trace_value values[GL_MAX_ARGS];
	struct call_sig sig = { .name = name, .command = gls_command_find(name) };
	struct call call = { .number = gl->number++, .sig = &sig, .args = values, .ret = ret };

	ck_assert_msg(sig.command >= 0, "no command %s", name);
	for (const char *l = letters; *l; l++)
		gl_value(&values[call.n_args++], *l, args);
	sig.n_args = call.n_args;
	ck_assert_int_eq(gls_exec_call(gl->x, &call), 0);
}

static inline void gl_call(struct gl *gl, const char *name, const char *letters, ...)
{
	va_list args;

	va_start(args, letters);
	gl_call_ret(gl, (struct trace_value){ .type = TRACE_NONE }, name, letters, &args);
	va_end(args);
}

/** As gl_call, for calls that return an address. */
static inline void gl_call_address(struct gl *gl, uint64_t ret, const char *name, const char *letters, ...)
{
	va_list args;

	va_start(args, letters);
	gl_call_ret(gl, (struct trace_value){ .type = TRACE_OPAQUE, .u = ret }, name, letters, &args);
	va_end(args);
}

/** As gl_call, for calls that return a number. */
static inline void gl_answered(struct gl *gl, uint32_t ret, const char *name, const char *letters, ...)
{
	va_list args;

	va_start(args, letters);
	gl_call_ret(gl, (struct trace_value){ .type = TRACE_UINT, .u = ret }, name, letters, &args);
	va_end(args);
}

static inline struct gls_state *gl_state(struct gl *gl)
{
	return gl->x->st;
}

/** The first error since the last query, as GetError returns it. */
static inline uint32_t gl_error(struct gl *gl)
{
	uint32_t error = gl_state(gl)->error;

	gl_call(gl, "glGetError", "");
	return error;
}

static inline struct gl gl_open(void)
{
	struct gl gl = { 0 };

	ck_assert_int_eq(gls_exec_create(&gl.x, "test"), 0);
	gl.x->want = 1;
	gl_call_address(&gl, 0x10, "glXCreateContext", "pppi", (uint64_t)1, (uint64_t)0, (uint64_t)0, 1);
	gl_call(&gl, "glXMakeCurrent", "pup", (uint64_t)1, 7u, (uint64_t)0x10);
	gl_call(&gl, "glViewport", "iiii", 0, 0, 64, 64);
	gl_call(&gl, "glScissor", "iiii", 0, 0, 64, 64);
	return gl;
}

static inline struct scene *gl_swap(struct gl *gl)
{
	struct scene *scene;

	gl_call(gl, "glXSwapBuffers", "pu", (uint64_t)1, 7u);
	ck_assert_int_eq(gl->x->frame_ended, 1);
	gl->x->frame_ended = 0;
	scene = gls_frame_finish(gl->x);
	gl->x->frame++;
	return scene;
}

static inline void gl_close(struct gl *gl)
{
	gls_exec_destroy(&gl->x);
}

/** Number of calls counted as unsupported. */
static inline uint64_t gl_unsupported(const struct gl *gl)
{
	uint64_t n = 0;

	for (unsigned i = 0; i < n_gls_commands; i++)
		n += gl->x->counts.unsupported[i];
	return n;
}

#define ck_assert_floats(n, have, ...) \
	do { \
		const float wanted_[] = { __VA_ARGS__ }; \
		for (unsigned i_ = 0; i_ < (n); i_++) \
			ck_assert_msg(fabsf((have)[i_] - wanted_[i_]) <= 1e-5f, "%s[%u] is %g, not %g", #have, i_, \
			              (double)(have)[i_], (double)wanted_[i_]); \
	} while (0)

/** main of a test file. */
#define GL_TESTS(name, ...) \
	int main(void) \
	{ \
		const TTest *const tests[] = { __VA_ARGS__ }; \
		TCase *tcase = tcase_create(name); \
		for (size_t i = 0; i < sizeof(tests) / sizeof(tests[0]); i++) \
			tcase_add_test(tcase, tests[i]); \
		return run_case(tcase, name); \
	}
